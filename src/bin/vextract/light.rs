//! Determines the light of a photograph.

use std::path::Path;

use vfold::cli::OpticsArgs;
use vfold::image::Photograph;
use vfold::measure::{LightTaken, light_of};
use vfold::spectrum::UNKNOWN_LIGHT;

/// The stated flags or, without an illuminant, the light of the `first` photograph according to its camera;
/// and a note on that.
pub fn optics(stated: &OpticsArgs, path: &Path, first: Option<&Photograph>) -> (OpticsArgs, Option<String>) {
    let mut optics = stated.clone();
    let (true, Some(photograph)) = (optics.illuminant.is_empty(), first) else { return (optics, None) };
    let note = match light_of(&photograph.info().camera.taken) {
        LightTaken::Sun(spec, sun) => {
            let note = format!(
                "{spec} by place and time of {}: a cloudless sky, the sun {:.1}° from the zenith; \
                 if that is wrong, give --illuminant",
                path.display(),
                sun.zenith_deg()
            );
            optics.illuminant = vec![spec];
            note
        }
        LightTaken::Daylight(why) => {
            format!("daylight assumed: {why}; if it was another light, give --illuminant")
        }
        LightTaken::OtherThanDaylight(why) => {
            optics.illuminant = vec![UNKNOWN_LIGHT.to_owned()];
            format!("vestimate will look for the light: {why}; if you know which it was, give --illuminant")
        }
    };
    (optics, Some(note))
}
