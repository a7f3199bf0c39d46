//! Shape of a fold whose crease is round and whose panels bow.

use super::{AUTO, Known, Normal, Role, Scale, Symptom, Unknown, Whose};

pub static CREASE: Unknown = Unknown {
    name: "crease_radius",
    description: "Radius of the rounded crease, in depths of the panels",
    unit: None,
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Scene,
    known: |_| Known::Imperfection,
    prior: |stated| Some(stated.priors.amount(stated.priors.crease_radius)),
    set: |conditions, value| conditions.crease_radius = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.008,
        words: |_, _| "the crease is rounded".to_owned(),
        remedy: "fold the sheet over a sharp edge",
    }),
};

pub static BOW: Unknown = Unknown {
    name: "bow_deg",
    description: "Curvature of the panels: angle by which both turn from the crease to the outer side",
    unit: Some("degrees"),
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Scene,
    known: |_| Known::Imperfection,
    prior: |stated| Some(Normal { mean: 0.0, sd: stated.priors.bow_sd_deg }.into()),
    set: |conditions, value| conditions.bow_deg = value,
    symptom: Some(BOWED),
};

pub static BOW_DIFFERENCE: Unknown = Unknown {
    name: "bow_difference_deg",
    description: "Angle by which panel 0 turns more than the mean of both",
    unit: Some("degrees"),
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Fold,
    known: |_| Known::Imperfection,
    prior: |stated| Some(Normal { mean: 0.0, sd: stated.priors.bow_difference_sd_deg }.into()),
    set: |conditions, value| conditions.bow_difference_deg = value,
    symptom: Some(BOWED),
};

const BOWED: Symptom = Symptom {
    ideal: |_| Some(0.0),
    least: 1.0,
    words: |_, _| "the panels bow".to_owned(),
    remedy: "hold them flat with stiff card behind them",
};
