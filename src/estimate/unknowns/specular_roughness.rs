//! Width of the sheet's specular reflection.

use super::{AUTO, Expectation, Known, Normal, Role, Scale, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Specular roughness: GGX's alpha.
pub static SPECULAR_ROUGHNESS: Unknown = Unknown {
    name: "specular_roughness",
    description: "Roughness of the surface: GGX's alpha",
    unit: None,
    flag: &AUTO,
    scale: Scale::Logarithm,
    role: Role::Photograph,
    whose: Whose::Sheet,
    known: |_| Known::OfImperfection,
    prior,
    set: |conditions, value| conditions.specular_roughness = value,
    symptom: None,
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    Some(
        Normal { mean: stated.priors.ln_specular_roughness, sd: stated.priors.ln_specular_roughness_sd }
            .into(),
    )
}
