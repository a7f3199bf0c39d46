//! Light that falls off over the fold, away from the crease and along it.

use super::{AUTO, Fitted, Known, Role, Scale, Symptom, Unknown, Whose};

pub static NEARNESS: Unknown = Unknown {
    name: "nearness",
    description: "Depth of a panel divided by the distance of the lamp that lights it; 0 for the sun",
    unit: None,
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Fold,
    known: |_| Known::Imperfection,
    prior: |stated| Some(stated.priors.unevenness().into()),
    set: |conditions, value| conditions.nearness = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.02,
        words: |Fitted { value, .. }, _| {
            let depths = value.abs().recip();
            let away = match depths.round() > 1.0 {
                true => format!("{depths:.0} panel depths away"),
                false => "no further than a panel's depth away".to_owned(),
            };
            format!("light falls off over the panels, like that of a lamp {away}")
        },
        remedy: "photograph the sheet in the sun, or move the lamp further away",
    }),
};

/// Negative if end 1 gets more light than end 0.
pub static FALL_OFF: Unknown = Unknown {
    name: "fall_off",
    description: "Loss of light along the crease, from end 0 to end 1, relative to the middle",
    unit: None,
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Lens,
    known: |_| Known::Imperfection,
    prior: |stated| Some(stated.priors.unevenness().into()),
    set: |conditions, value| conditions.fall_off = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 0.03,
        words: |Fitted { value, .. }, _| {
            let (percent, end) = (100.0 * value.abs(), usize::from(*value > 0.0));
            format!(
                "light falls off along the crease, by {percent:.0} % towards end {end}: \
                 a lamp nearby, or the edge of a shadow"
            )
        },
        remedy: "photograph the sheet in the sun, away from walls, \
                 or move the lamp further away",
    }),
};
