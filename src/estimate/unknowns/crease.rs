//! A crease that is round.

use super::{AUTO, Expectation, Known, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Radius of the rounded crease, in panel depths.
pub static CREASE: Unknown = Unknown {
    name: "crease_radius",
    description: "Radius of the rounded crease, in depths of the panels",
    unit: None,
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Scene,
    known: |_| Known::Imperfection,
    prior,
    set: |conditions, value| conditions.crease_radius = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.008,
        words: |_, _| "the crease is rounded".to_owned(),
        remedy: "fold the sheet over a sharp edge",
    }),
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    Some(stated.priors.amount(stated.priors.crease_radius))
}
