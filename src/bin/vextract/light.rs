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
                 --illuminant says otherwise",
                path.display(),
                sun.zenith_deg()
            );
            optics.illuminant = vec![spec];
            note
        }
        LightTaken::Daylight(why) => {
            format!("daylight assumed, D65: {why}; --illuminant says which light it was")
        }
        LightTaken::OtherThanDaylight(why) => {
            optics.illuminant = vec![UNKNOWN_LIGHT.to_owned()];
            format!("which light it was is to be found in the picture: {why}; --illuminant says which it was")
        }
    };
    (optics, Some(note))
}
