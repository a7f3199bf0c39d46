//! Which light a photograph was taken in.

use std::path::Path;

use vfold::cli::OpticsArgs;
use vfold::image::{Photograph, Taken};
use vfold::spectrum::Sun;

/// What was given, with the sun of the `first` photograph's place and time if no illuminant was; and what is to be said of that.
pub fn optics(given: &OpticsArgs, path: &Path, first: Option<&Photograph>) -> (OpticsArgs, Option<String>) {
    let mut optics = given.clone();
    let (true, Some(photograph)) = (optics.illuminant.is_empty(), first) else { return (optics, None) };
    let said = match sun(&photograph.info().camera.taken) {
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

/// The sun as SPEC, by what the camera wrote; else why not. A hundredth of a degree is near enough, and tells nobody's address.
fn sun(taken: &Taken) -> Result<(String, Sun), String> {
    let Taken { place_deg, time, other_light } = taken;
    if let Some(light) = other_light {
        return Err(format!("the photograph says {light}"));
    }
    match (place_deg, time) {
        (Some([latitude, longitude]), Some(time)) => {
            let place = format!("{latitude:.2},{longitude:.2},{time}");
            let sun = Sun::parse(&place)
                .map_err(|_| "by the photograph's place and time it was night".to_owned())?;
            Ok((format!("sun:{place}"), sun))
        }
        (None, None) => Err("the photograph does not say where and when it was taken".to_owned()),
        (None, _) => Err("the photograph does not say where it was taken".to_owned()),
        (_, None) => {
            Err("the photograph does not say when it was taken, with its difference from UTC".to_owned())
        }
    }
}
