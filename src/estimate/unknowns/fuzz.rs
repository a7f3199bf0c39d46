//! Fibres that stand up from the sheet.

use super::{AUTO, Effect, Expectation, Known, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::Told;

/// By how much the body is brighter where light grazes it, or the eye: fibres that stand up, as those of felt.
pub static FUZZ: Unknown = Unknown {
    name: "fuzz",
    about: "By how much the body is brighter where light grazes it, or the eye: fibres that stand up, as those of felt",
    unit: None,
    flag: &AUTO,
    range: 0.0..=f64::INFINITY,
    scale: Scale::Positive,
    role: Role::Photograph,
    photograph: Some(Effect {
        whose: Whose::Sheet,
        known: |_| Known::Imperfection,
        prior,
        set: |conditions, value| conditions.fuzz = value,
        symptom: Some(Symptom {
            ideal: |_| 0.0,
            least: 0.15,
            words: |_, _| "fibres stand up from the sheet".to_owned(),
            remedy: "if there is no chart or card in the picture, put one in",
        }),
    }),
};

fn prior(told: &Told) -> Option<Expectation> {
    Some(told.beliefs.amount(told.beliefs.fuzz))
}
