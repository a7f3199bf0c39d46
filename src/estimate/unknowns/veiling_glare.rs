//! A lens that spreads light over the picture.

use super::{AUTO, Expectation, Known, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Veiling glare: share of the picture's light that the lens spreads evenly over it.
pub static VEILING_GLARE: Unknown = Unknown {
    name: "veiling_glare",
    description: "Veiling glare: share of the picture's light that the lens spreads over all of it",
    unit: None,
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Lens,
    known: |_| Known::Imperfection,
    prior,
    set: |conditions, value| conditions.veiling_glare = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.01,
        words: |_, _| "stray light lies over the picture".to_owned(),
        remedy: "shade the lens",
    }),
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    Some(stated.priors.amount(stated.priors.veiling_glare))
}
