//! How far above the horizon the fold opens.

use super::{AUTO, Effect, Expectation, Known, Normal, Role, Scale, Told, Unknown, Whose};

/// Angle between the horizon and the direction to which the fold opens, degrees.
pub static ELEVATION: Unknown = Unknown {
    name: "elevation_deg",
    about: "How far above the horizon the fold opens",
    unit: Some("degrees"),
    flag: &AUTO,
    range: f64::NEG_INFINITY..=f64::INFINITY,
    scale: Scale::Linear,
    role: Role::Photograph,
    photograph: Some(Effect {
        whose: Whose::Light,
        known: |_| Known::OfImperfection,
        prior,
        set: |conditions, value| conditions.elevation_deg = value,
        symptom: None,
    }),
};

fn prior(told: &Told) -> Option<Expectation> {
    told.daylight
        .map(|_| Normal { mean: told.beliefs.elevation_deg, sd: told.beliefs.elevation_sd_deg }.into())
}
