//! How cloudy the sky is.

use super::{AUTO, Effect, Expectation, Known, Normal, Role, Scale, Unknown, Whose};
use crate::estimate::photograph::Told;

/// Share of the sky's light that is an overcast one's; the rest is a clear one's.
pub static CLOUD: Unknown = Unknown {
    name: "cloud",
    about: "Share of the sky's light that is an overcast sky's",
    unit: None,
    flag: &AUTO,
    range: 0.0..=1.0,
    scale: Scale::Linear,
    role: Role::Photograph,
    photograph: Some(Effect {
        whose: Whose::Light,
        known: |_| Known::OfImperfection,
        prior,
        set: |conditions, value| conditions.cloud = value.clamp(0.0, 1.0),
        symptom: None,
    }),
};

fn prior(told: &Told) -> Option<Expectation> {
    told.daylight.and_then(|_| told.day.cloud(told.beliefs)).map(Normal::into)
}
