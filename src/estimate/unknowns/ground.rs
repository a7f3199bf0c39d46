//! Light from the ground below the sheet.

use super::{AUTO, Expectation, Known, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Reflectance of the ground at 550 nm.
pub static GROUND: Unknown = Unknown {
    name: "ground",
    description: "Reflectance of the ground at 550 nm",
    unit: None,
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Light,
    known: |_| Known::Imperfection,
    prior,
    set: |conditions, value| conditions.ground = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.2,
        words: |_, _| "the ground reflects light into the fold".to_owned(),
        remedy: "lay a black cloth around it",
    }),
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    stated.daylight.map(|_| stated.priors.amount(stated.priors.ground))
}
