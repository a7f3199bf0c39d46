//! The colour of the sun: daylight of unknown temperature.

use super::{AUTO, Effect, Normal, Role, Scale, Told, Unknown};

/// Correlated colour temperature of the sun, K.
pub static SUN_COLOUR: Unknown = Unknown {
    name: "sun_cct_k",
    about: "Correlated colour temperature of the sun",
    unit: Some("K"),
    flag: &AUTO,
    range: 0.0..=f64::INFINITY,
    scale: Scale::Reciprocal,
    role: Role::Photograph,
    photograph: Some(Effect { prior, set: |conditions, value| conditions.sun_mired = Some(1e6 / value) }),
};

/// Direct sunlight has 5000 K to 5800 K, whatever kind of daylight was said.
const PRIOR: Normal = Normal { mean: 187.0, sd: 7.0 };

fn prior(told: &Told) -> Option<Normal> {
    told.daylight_mired.map(|_| PRIOR)
}
