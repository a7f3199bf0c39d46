//! How sharply the surface of the sheet reflects.

use super::{AUTO, Effect, Expectation, Known, Normal, Role, Scale, Unknown, Whose};
use crate::estimate::photograph::Told;

/// Roughness of the surface: the width of the slopes of its microfacets (GGX's alpha).
pub static GLOSS_ROUGHNESS: Unknown = Unknown {
    name: "gloss_roughness",
    about: "Roughness of the surface: the width of the slopes of its microfacets (GGX's alpha)",
    unit: None,
    flag: &AUTO,
    range: 0.05..=1.0,
    scale: Scale::Logarithm,
    role: Role::Photograph,
    photograph: Some(Effect {
        whose: Whose::Sheet,
        known: |_| Known::OfImperfection,
        prior,
        set: |conditions, value| conditions.gloss_roughness = value,
        symptom: None,
    }),
};

fn prior(told: &Told) -> Option<Expectation> {
    Some(Normal { mean: told.beliefs.ln_gloss_roughness, sd: told.beliefs.ln_gloss_roughness_sd }.into())
}
