//! Gain error of the first channel.

use super::{AUTO, Expectation, Known, Normal, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Gain of the first channel relative to the second, compared with the stated one.
pub static FIRST_GAIN: Unknown = Unknown {
    name: "first_gain",
    description: "Ratio of the first channel's gain to the second's, relative to the stated ratio",
    unit: None,
    flag: &AUTO,
    scale: Scale::Logarithm,
    role: Role::Photograph,
    whose: Whose::Lens,
    known: |_| Known::Nominal,
    prior,
    set: |conditions, value| conditions.gains[0] = value,
    symptom: Some(UNBALANCED),
};

/// For both gains.
pub(super) const UNBALANCED: Symptom = Symptom {
    ideal: |_| Some(1.0),
    least: 0.02,
    words: |_, _| "the channels are not balanced as stated".to_owned(),
    remedy: "photograph a grey card with the sheet",
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    (stated.channels == 3).then_some(Normal { mean: 0.0, sd: stated.priors.gain_sd }.into())
}
