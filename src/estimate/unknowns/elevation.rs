//! Elevation above the horizon of the direction in which the fold opens.

use super::{AUTO, Expectation, Known, Normal, Role, Scale, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Angle between the horizon and the direction in which the fold opens, degrees.
pub static ELEVATION: Unknown = Unknown {
    name: "elevation_deg",
    description: "Angle above the horizon of the direction into which the fold opens",
    unit: Some("degrees"),
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Light,
    known: |stated| if stated.elevation_deg().is_some() { Known::Stated } else { Known::OfImperfection },
    prior,
    set: |conditions, value| conditions.elevation_deg = value,
    symptom: None,
};

/// A stated zenith is as accurate as the position of the sun across the crease.
fn prior(stated: &StatedScene) -> Option<Expectation> {
    let priors = stated.priors;
    let usual = Normal { mean: priors.elevation_deg, sd: priors.elevation_sd_deg };
    let known = stated.elevation_deg().map_or(usual, |mean| Normal { mean, sd: priors.tilt_sd_deg });
    stated.daylight.map(|_| known.into())
}
