//! Which light a photograph was taken in.

use crate::image::Taken;
use crate::spectrum::Sun;

/// The sun as SPEC, by what the camera wrote. A hundredth of a degree is near enough, and tells nobody's address.
///
/// # Errors
/// Why it does not tell, in words.
pub fn sun_of(taken: &Taken) -> Result<(String, Sun), String> {
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
