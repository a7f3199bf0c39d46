//! Sunlight that passes clouds or an object casting a shadow.

use super::{AUTO, Expectation, Known, Role, Scale, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Irradiance from the hidden sun on a plane facing it, relative to the sky's on an open horizontal plane.
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
    prior,
    set: |conditions, value| conditions.sun = value,
    symptom: None,
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    stated.daylight.filter(|_| !stated.day.has_sun()).map(|_| stated.priors.amount(stated.priors.hidden_sun))
}
