//! Light of the surroundings: the ground, the kind of sky, and a hidden sun.

use super::{AUTO, Expectation, Fitted, Known, Normal, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

pub static GROUND: Unknown = Unknown {
    name: "ground",
    description: "Reflectance of the ground at 550 nm",
    unit: None,
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Light,
    known: |_| Known::Imperfection,
    prior: |stated| stated.daylight.map(|_| stated.priors.amount(stated.priors.ground)),
    set: |conditions, value| conditions.ground = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.2,
        words: |_, _| "the ground reflects light into the fold".to_owned(),
        remedy: "lay a black cloth around it",
    }),
};

pub static GROUND_REDNESS: Unknown = Unknown {
    name: "ground_redness",
    description: "Rise of the reflectance of the ground from 550 nm to 700 nm, relative to that at 550 nm",
    unit: None,
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Light,
    known: |_| Known::OfImperfection,
    prior: |stated| {
        let (mean, sd) = (stated.priors.ground_redness, stated.priors.ground_redness_sd);
        stated.daylight.map(|_| Normal { mean, sd }.into())
    },
    set: |conditions, value| conditions.ground_redness = value,
    symptom: None,
};

/// A uniform sky, as in computed scenes.
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
            let even_sky = stated.even_sky();
            format!("light from all directions is {value:.2} of the sun's, not {even_sky} as stated")
        },
        remedy: "set vkernel --sky to that value, or photograph the sheet where little but the sun lights it",
    }),
};

/// Sunlight that passes clouds or an object casting a shadow.
pub static SUN: Unknown = Unknown {
    name: "sun",
    description: "Irradiance that the hidden sun gives a plane facing it, relative to that which the sky \
                  gives an unobstructed horizontal plane",
    unit: None,
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Scene,
    known: |_| Known::Imperfection,
    prior: |stated| {
        let is_hidden = stated.daylight.is_some() && !stated.day.has_sun();
        is_hidden.then(|| stated.priors.amount(stated.priors.hidden_sun))
    },
    set: |conditions, value| conditions.sun = value,
    symptom: None,
};

/// The rest of the sky's light is distributed as that of a clear one.
pub static CLOUD: Unknown = Unknown {
    name: "cloud",
    description: "Share of the sky's light that is distributed as that of an overcast sky",
    unit: None,
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Light,
    known: |_| Known::OfImperfection,
    prior: |stated| stated.daylight.and_then(|_| stated.day.cloud(stated.priors)).map(Normal::into),
    set: |conditions, value| conditions.cloud = value.clamp(0.0, 1.0),
    symptom: None,
};

pub static ELEVATION: Unknown = Unknown {
    name: "elevation_deg",
    description: "Angle above the horizon of the direction into which the fold opens",
    unit: Some("degrees"),
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Light,
    known: |stated| if stated.elevation_deg().is_some() { Known::Stated } else { Known::OfImperfection },
    prior: of_elevation,
    set: |conditions, value| conditions.elevation_deg = value,
    symptom: None,
};

/// A stated zenith is as accurate as the position of the sun across the crease.
fn of_elevation(stated: &StatedScene) -> Option<Expectation> {
    let priors = stated.priors;
    let usual = Normal { mean: priors.elevation_deg, sd: priors.elevation_sd_deg };
    let known = stated.elevation_deg().map_or(usual, |mean| Normal { mean, sd: priors.tilt_sd_deg });
    stated.daylight.map(|_| known.into())
}
