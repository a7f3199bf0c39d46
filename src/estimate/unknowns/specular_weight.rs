//! Specular reflection by the surface of the sheet.

use super::{AUTO, Expectation, Known, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Specular weight: strength of the surface's reflection, relative to a bare surface of refractive index 1.5.
pub static SPECULAR_WEIGHT: Unknown = Unknown {
    name: "specular_weight",
    description: "Specular weight: strength of the surface's reflection, that of a bare surface \
                  of refractive index 1.5 being 1",
    unit: None,
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Sheet,
    known: |_| Known::Imperfection,
    prior,
    set: |conditions, value| conditions.specular_weight = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.15,
        words: |_, _| "the sheet is glossy".to_owned(),
        remedy: "turn fold and camera so that no light is mirrored into the picture",
    }),
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    Some(stated.priors.amount(stated.priors.specular_weight))
}
