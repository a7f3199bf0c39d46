//! The colour of the sun: daylight of unknown temperature.

use super::{AUTO, Effect, Normal, Role, Scale, Symptom, Told, Unknown, Whose};
use crate::estimate::photograph::conditions::Daylight;

/// Correlated colour temperature of the sun, K.
pub static SUN_COLOUR: Unknown = Unknown {
    name: "sun_cct_k",
    about: "Correlated colour temperature of the sun",
    unit: Some("K"),
    flag: &AUTO,
    range: 0.0..=f64::INFINITY,
    scale: Scale::Reciprocal,
    role: Role::Photograph,
    photograph: Some(Effect {
        whose: Whose::Photograph,
        prior,
        set: |conditions, value| conditions.sun_mired = Some(1e6 / value),
        symptom: Some(Symptom {
            ideal: |told| 1e6 / told.daylight.map_or(ANY_MIRED, Daylight::mired),
            least: 400.0,
            words: "the sun has another colour than was to be expected",
            remedy: "tell --illuminant sun:LAT,LON,TIME, or measure it",
        }),
    }),
};

/// Direct sunlight has 5000 K to 5800 K, whatever kind of daylight was said.
const ANY_MIRED: f64 = 187.0;
/// As much as a tenth more or less aerosol (optical depth at 500 nm) makes of it.
const SD_MIRED: f64 = 7.0;

fn prior(told: &Told) -> Option<Normal> {
    let mean = match told.daylight? {
        Daylight::Cie { .. } => ANY_MIRED,
        Daylight::OfSun { mired } => mired,
    };
    Some(Normal { mean, sd: SD_MIRED })
}
