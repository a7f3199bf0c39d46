//! How sharply the surface of the sheet reflects.

use super::{AUTO, Effect, Known, Normal, Role, Scale, Told, Unknown, Whose};

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

/// Matte surfaces have 0.3 to 0.6.
const PRIOR: Normal = Normal { mean: -0.85, sd: 0.18 };

fn prior(_: &Told) -> Option<Normal> {
    Some(PRIOR)
}
