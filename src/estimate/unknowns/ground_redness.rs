//! Colour of the ground below the sheet.

use super::{AUTO, Expectation, Known, Normal, Role, Scale, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Rise of the reflectance of the ground from 550 nm to 700 nm, relative to that at 550 nm.
pub static GROUND_REDNESS: Unknown = Unknown {
    name: "ground_redness",
    description: "Rise of the reflectance of the ground from 550 nm to 700 nm, relative to that at 550 nm",
    unit: None,
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Light,
    known: |_| Known::OfImperfection,
    prior,
    set: |conditions, value| conditions.ground_redness = value,
    symptom: None,
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    stated
        .daylight
        .map(|_| Normal { mean: stated.priors.ground_redness, sd: stated.priors.ground_redness_sd }.into())
}
