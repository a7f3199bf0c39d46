//! Which light a photograph was taken in.

use std::path::Path;

use vfold::cli::OpticsArgs;
use vfold::image::Photograph;
use vfold::measure::sun_of;

/// What was given, with the sun of the `first` photograph's place and time if no illuminant was; and what is to be said of that.
pub fn optics(given: &OpticsArgs, path: &Path, first: Option<&Photograph>) -> (OpticsArgs, Option<String>) {
    let mut optics = given.clone();
    let (true, Some(photograph)) = (optics.illuminant.is_empty(), first) else { return (optics, None) };
    let said = match sun_of(&photograph.info().camera.taken) {
        Ok((spec, sun)) => {
            let said = format!(
                "{spec} by place and time of {}: a cloudless sky, the sun {:.1}° from the zenith; \
                 --illuminant says otherwise",
                path.display(),
                sun.zenith_deg()
            );
            optics.illuminant = vec![spec];
            said
        }
        Err(why) => format!("daylight assumed, D65: {why}; --illuminant says which light it was"),
    };
    (optics, Some(said))
}
