//! Panels that do not bow alike.

use super::bow::BOWED;
use super::{AUTO, Effect, Known, Normal, Role, Scale, Told, Unknown, Whose};

/// By how much panel 0 turns more than both do in the mean, degrees.
pub static BOW_DIFFERENCE: Unknown = Unknown {
    name: "bow_difference_deg",
    about: "By how much panel 0 turns more than both do in the mean",
    unit: Some("degrees"),
    flag: &AUTO,
    range: f64::NEG_INFINITY..=f64::INFINITY,
    scale: Scale::Linear,
    role: Role::Photograph,
    photograph: Some(Effect {
        whose: Whose::Fold,
        known: |_| Known::Imperfection,
        prior,
        set: |conditions, value| conditions.bow_difference_deg = value,
        symptom: Some(BOWED),
    }),
};

/// The panels of one sheet bow much alike.
const PRIOR: Normal = Normal { mean: 0.0, sd: 0.7 };

fn prior(_: &Told) -> Option<Normal> {
    Some(PRIOR)
}
