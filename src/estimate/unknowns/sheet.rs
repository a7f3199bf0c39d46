//! Reflection of the sheet: gloss of its surface, roughness and fibres of its body.

use super::{AUTO, Known, Normal, Role, Scale, Symptom, Unknown, Whose};

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
    prior: |stated| Some(stated.priors.amount(stated.priors.specular_weight)),
    set: |conditions, value| conditions.specular_weight = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.15,
        words: |_, _| "the sheet is glossy".to_owned(),
        remedy: "turn fold and camera so that no light is mirrored into the picture",
    }),
};

pub static SPECULAR_ROUGHNESS: Unknown = Unknown {
    name: "specular_roughness",
    description: "Roughness of the surface: GGX's alpha",
    unit: None,
    flag: &AUTO,
    scale: Scale::Logarithm,
    role: Role::Photograph,
    whose: Whose::Sheet,
    known: |_| Known::OfImperfection,
    prior: |stated| {
        let (mean, sd) = (stated.priors.ln_specular_roughness, stated.priors.ln_specular_roughness_sd);
        Some(Normal { mean, sd }.into())
    },
    set: |conditions, value| conditions.specular_roughness = value,
    symptom: None,
};

pub static BODY_ROUGHNESS: Unknown = Unknown {
    name: "body_roughness_deg",
    description: "Roughness of the body of the sheet: the spread of the slopes \
                  of its facets (Oren and Nayar's sigma)",
    unit: Some("degrees"),
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Sheet,
    known: |_| Known::Imperfection,
    prior: |stated| Some(stated.priors.amount(stated.priors.body_roughness_deg)),
    set: |conditions, value| conditions.body_roughness_deg = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 10.0,
        words: |_, _| "the sheet is rough".to_owned(),
        remedy: "include a colour chart or a white card",
    }),
};

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
    prior: |stated| Some(stated.priors.amount(stated.priors.sheen)),
    set: |conditions, value| conditions.sheen = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.15,
        words: |_, _| "fibres stand up from the sheet".to_owned(),
        remedy: "include a colour chart or a white card",
    }),
};
