//! Gain error of the last channel.

use super::first_gain::UNBALANCED;
use super::{AUTO, Expectation, Known, Normal, Role, Scale, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Gain of the last channel relative to the second, compared with the stated one.
pub static LAST_GAIN: Unknown = Unknown {
    name: "last_gain",
    description: "Ratio of the last channel's gain to the second's, relative to the stated ratio",
    unit: None,
    flag: &AUTO,
    scale: Scale::Logarithm,
    role: Role::Photograph,
    whose: Whose::Lens,
    known: |_| Known::Nominal,
    prior,
    set: |conditions, value| conditions.gains[1] = value,
    symptom: Some(UNBALANCED),
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    (stated.channels == 3).then_some(Normal { mean: 0.0, sd: stated.priors.gain_sd }.into())
}
