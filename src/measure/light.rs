//! Determines the light of a photograph.

use crate::image::Taken;
use crate::spectrum::Sun;

/// The light of a photograph according to its camera's notes, with the reason if it is not the sun.
#[derive(Clone, Debug, PartialEq)]
pub enum LightTaken {
    /// The sun, as SPEC. Coordinates rounded to a hundredth of a degree are accurate enough, and reveal no
    /// address.
    Sun(String, Sun),
    /// Daylight, as far as is known.
    Daylight(String),
    /// Not daylight: a flash, lamps, or any light at night.
    OtherThanDaylight(String),
}

/// The light according to the camera's notes.
#[must_use]
pub fn light_of(taken: &Taken) -> LightTaken {
    let Taken { place_deg, time, other_light, clock: _ } = taken;
    if let Some(light) = other_light {
        let note = format!("the photograph says {}", light.name());
        let is_daylight = light.is_daylight();
        return if is_daylight { LightTaken::Daylight(note) } else { LightTaken::OtherThanDaylight(note) };
    }
    let missing = match (place_deg, time) {
        (Some([latitude, longitude]), Some(time)) => {
            let place = format!("{latitude:.2},{longitude:.2},{time}");
            return Sun::parse(&place).map_or_else(
                |_| {
                    LightTaken::OtherThanDaylight(
                        "by the photograph's place and time it was night".to_owned(),
                    )
                },
                |sun| LightTaken::Sun(format!("sun:{place}"), sun),
            );
        }
        (None, None) => "where and when it was taken",
        (None, _) => "where it was taken",
        (_, None) => "when it was taken, with its difference from UTC",
    };
    LightTaken::Daylight(format!("the photograph does not say {missing}"))
}
