//! A nearby lamp in place of the sun.

use super::{AUTO, Expectation, Fitted, Known, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Panel depth divided by the distance of the lamp that lights the sheet; 0 for the sun.
pub static NEARNESS: Unknown = Unknown {
    name: "nearness",
    description: "Depth of a panel divided by the distance of the lamp that lights it; 0 for the sun",
    unit: None,
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Fold,
    known: |_| Known::Imperfection,
    prior,
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

fn prior(stated: &StatedScene) -> Option<Expectation> {
    Some(stated.priors.unevenness().into())
}
