//! Panels that bow differently.

use super::bow::BOWED;
use super::{AUTO, Expectation, Known, Normal, Role, Scale, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Turn of panel 0 beyond the mean of both, degrees.
pub static BOW_DIFFERENCE: Unknown = Unknown {
    name: "bow_difference_deg",
    description: "Angle by which panel 0 turns more than the mean of both",
    unit: Some("degrees"),
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Fold,
    known: |_| Known::Imperfection,
    prior,
    set: |conditions, value| conditions.bow_difference_deg = value,
    symptom: Some(BOWED),
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    Some(Normal { mean: 0.0, sd: stated.priors.bow_difference_sd_deg }.into())
}
