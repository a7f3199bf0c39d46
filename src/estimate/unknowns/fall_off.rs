//! Light that falls off along the crease.

use super::{AUTO, Expectation, Fitted, Known, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Loss of light from end 0 to end 1 of the crease, relative to its middle; negative for a gain.
pub static FALL_OFF: Unknown = Unknown {
    name: "fall_off",
    description: "Loss of light along the crease, from end 0 to end 1, relative to the middle",
    unit: None,
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Lens,
    known: |_| Known::Imperfection,
    prior,
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

fn prior(stated: &StatedScene) -> Option<Expectation> {
    Some(stated.priors.unevenness().into())
}
