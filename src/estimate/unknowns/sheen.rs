//! Upright fibres on the sheet.

use super::{AUTO, Expectation, Known, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Sheen: brightening of the body at grazing incidence or viewing by upright fibres, as in felt.
pub static SHEEN: Unknown = Unknown {
    name: "sheen",
    description: "Sheen: brightening of the body at grazing incidence or viewing, by upright fibres, \
                  as in felt",
    unit: None,
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Sheet,
    known: |_| Known::Imperfection,
    prior,
    set: |conditions, value| conditions.sheen = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.15,
        words: |_, _| "fibres stand up from the sheet".to_owned(),
        remedy: "include a colour chart or a white card",
    }),
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    Some(stated.priors.amount(stated.priors.sheen))
}
