//! How far above the horizon the fold opens.

use super::{AUTO, Effect, Expectation, Known, Normal, Role, Scale, Unknown, Whose};
use crate::estimate::photograph::Told;

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
        known: |told| if told.elevation_deg().is_some() { Known::Stated } else { Known::OfImperfection },
        prior,
        set: |conditions, value| conditions.elevation_deg = value,
        symptom: None,
    }),
};

/// People know the zenith as well as where the sun stands across the crease.
fn prior(told: &Told) -> Option<Expectation> {
    let beliefs = told.beliefs;
    let usual = Normal { mean: beliefs.elevation_deg, sd: beliefs.elevation_sd_deg };
    let known = told.elevation_deg().map_or(usual, |mean| Normal { mean, sd: beliefs.tilt_sd_deg });
    told.daylight.map(|_| known.into())
}
