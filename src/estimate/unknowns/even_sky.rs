//! A uniform sky, as in computed scenes.

use super::{AUTO, Fitted, Known, Role, Scale, Symptom, Unknown, Whose};

/// Irradiance on an open plane from uniform light, relative to the sun's on a plane facing it.
pub static EVEN_SKY: Unknown = Unknown {
    name: "even_sky",
    description: "Irradiance that light equal from all directions gives an unobstructed plane, \
                  relative to that which the sun gives a plane facing it",
    unit: None,
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Light,
    known: |_| Known::Imperfection,
    prior: |stated| Some(stated.priors.amount(stated.priors.even_sky)),
    set: |conditions, value| conditions.even_sky = value,
    symptom: Some(Symptom {
        ideal: |stated| Some(stated.even_sky()),
        least: 0.02,
        words: |Fitted { value, .. }, stated| {
            format!(
                "light from all directions is {value:.2} of the sun's, not {} as stated",
                stated.even_sky()
            )
        },
        remedy: "state vkernel --sky, or photograph the sheet where little but the sun lights it",
    }),
};
