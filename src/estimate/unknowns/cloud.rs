//! Cloudiness of the sky.

use super::{AUTO, Expectation, Known, Normal, Role, Scale, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Share of the sky's light with the distribution of an overcast sky; the rest has that of a clear one.
pub static CLOUD: Unknown = Unknown {
    name: "cloud",
    description: "Share of the sky's light that is distributed as that of an overcast sky",
    unit: None,
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Light,
    known: |_| Known::OfImperfection,
    prior,
    set: |conditions, value| conditions.cloud = value.clamp(0.0, 1.0),
    symptom: None,
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    stated.daylight.and_then(|_| stated.day.cloud(stated.priors)).map(Normal::into)
}
