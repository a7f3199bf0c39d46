//! A lens that darkens the corners of the picture.

use super::{AUTO, Expectation, Known, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Share of the light lost by the lens in the picture's corners.
pub static VIGNETTING: Unknown = Unknown {
    name: "vignetting",
    description: "Share of the light that the lens loses in the picture's corners",
    unit: None,
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Lens,
    known: |_| Known::Imperfection,
    prior,
    set: |conditions, value| conditions.vignetting = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.1,
        words: |_, _| "the lens darkens the corners of the picture".to_owned(),
        remedy: "give vextract --white with a picture of a white sheet, or use a smaller aperture",
    }),
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    Some(stated.priors.amount(stated.priors.vignetting))
}
