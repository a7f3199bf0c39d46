//! What the surface of the sheet reflects before light enters it.

use super::{AUTO, Effect, Expectation, Known, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::Told;

/// Strength of the surface's reflection, that of a bare surface of refractive index 1.5 being 1.
pub static GLOSS: Unknown = Unknown {
    name: "gloss",
    about: "Strength of the surface's reflection, that of a bare surface of refractive index 1.5 being 1",
    unit: None,
    flag: &AUTO,
    range: 0.0..=f64::INFINITY,
    scale: Scale::Positive,
    role: Role::Photograph,
    photograph: Some(Effect {
        whose: Whose::Sheet,
        known: |_| Known::Imperfection,
        prior,
        set: |conditions, value| conditions.gloss = value,
        symptom: Some(Symptom {
            ideal: |_| 0.0,
            least: 0.15,
            words: |_, _| "the sheet is glossy".to_owned(),
            remedy: "turn fold and camera so that no light is mirrored into the picture",
        }),
    }),
};

fn prior(told: &Told) -> Option<Expectation> {
    Some(told.beliefs.amount(told.beliefs.gloss))
}
