//! Errors of the camera: its lens, and the gains of its channels.

use super::{AUTO, Expectation, Known, Normal, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

pub static VIGNETTING: Unknown = Unknown {
    name: "vignetting",
    description: "Share of the light that the lens loses in the picture's corners",
    unit: None,
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Lens,
    known: |_| Known::Imperfection,
    prior: |stated| Some(stated.priors.amount(stated.priors.vignetting)),
    set: |conditions, value| conditions.vignetting = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.1,
        words: |_, _| "the lens darkens the corners of the picture".to_owned(),
        remedy: "give vextract --white with a picture of a white sheet, or use a smaller aperture",
    }),
};

pub static VEILING_GLARE: Unknown = Unknown {
    name: "veiling_glare",
    description: "Veiling glare: share of the picture's light that the lens spreads over all of it",
    unit: None,
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Lens,
    known: |_| Known::Imperfection,
    prior: |stated| Some(stated.priors.amount(stated.priors.veiling_glare)),
    set: |conditions, value| conditions.veiling_glare = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.01,
        words: |_, _| "stray light lies over the picture".to_owned(),
        remedy: "shade the lens",
    }),
};

pub static FIRST_GAIN: Unknown = Unknown {
    name: "first_gain",
    description: "Ratio of the first channel's gain to the second's, relative to the stated ratio",
    unit: None,
    flag: &AUTO,
    scale: Scale::Logarithm,
    role: Role::Photograph,
    whose: Whose::Lens,
    known: |_| Known::Nominal,
    prior: of_gain,
    set: |conditions, value| conditions.gains[0] = value,
    symptom: Some(UNBALANCED),
};

pub static LAST_GAIN: Unknown = Unknown {
    name: "last_gain",
    description: "Ratio of the last channel's gain to the second's, relative to the stated ratio",
    unit: None,
    flag: &AUTO,
    scale: Scale::Logarithm,
    role: Role::Photograph,
    whose: Whose::Lens,
    known: |_| Known::Nominal,
    prior: of_gain,
    set: |conditions, value| conditions.gains[1] = value,
    symptom: Some(UNBALANCED),
};

fn of_gain(stated: &StatedScene) -> Option<Expectation> {
    (stated.channels == 3).then_some(Normal { mean: 0.0, sd: stated.priors.gain_sd }.into())
}

const UNBALANCED: Symptom = Symptom {
    ideal: |_| Some(1.0),
    least: 0.02,
    words: |_, _| "the channels are not balanced as stated".to_owned(),
    remedy: "photograph a grey card with the sheet",
};
