//! Parametric reflection of sheets: a rough or fibrous body under a rough surface.

use std::f64::consts::{FRAC_1_PI, PI};

use super::angles::Angles;
use super::fresnel::FRESNEL_MEAN;

/// Exponent of the increase of sheen towards grazing angles.
const SHEEN_POWER: i32 = 3;

/// A coloured body under a colourless surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Family {
    /// Standard deviation of the body's slopes, degrees (Oren and Nayar); 0: Lambertian.
    pub body_roughness_deg: f64,
    /// Strength of the surface reflection, 1 for a closed surface of index 1.5: [0, 1] or slightly more.
    pub specular_weight: f64,
    /// Roughness of that surface, (0, 1]: α of the GGX distribution.
    pub roughness: f64,
    /// Sheen: brightening of the body at grazing incidence or viewing, caused by upright fibres, as in felt.
    pub sheen: f64,
}

/// Precomputed values for evaluating a [`Family`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Terms {
    family: Family,
    /// The two coefficients of Oren and Nayar's qualitative model.
    even: f64,
    towards_light: f64,
}

impl Terms {
    pub(super) fn new(family: Family) -> Self {
        let variance = family.body_roughness_deg.to_radians().powi(2);
        Self {
            family,
            even: 1.0 - 0.5 * variance / (variance + 0.33),
            towards_light: 0.45 * variance / (variance + 0.09),
        }
    }

    /// Body and surface, 1/sr, not normalised.
    ///
    /// # Source
    /// M. Oren, S. Nayar, SIGGRAPH 1994, eq. (30); B. Walter et al., EGSR 2007, for GGX and its shadowing.
    pub(super) fn at(&self, angles: &Angles) -> [f64; 2] {
        let Angles { cos_in, cos_out, cos_between, fresnel: [of_in, of_out, of_facets], .. } = *angles;
        let Family { specular_weight, sheen, .. } = self.family;
        let towards = angles.along_sheet().max(0.0) / cos_in.max(cos_out);
        let mut body = FRAC_1_PI * (self.even + self.towards_light * towards);
        if sheen != 0.0 {
            body *= 1.0 + sheen * ((1.0 - cos_in).powi(SHEEN_POWER) + (1.0 - cos_out).powi(SHEEN_POWER));
        }
        if specular_weight == 0.0 {
            return [body, 0.0];
        }
        body *= (1.0 - specular_weight * of_in) * (1.0 - specular_weight * of_out)
            / (1.0 - specular_weight * FRESNEL_MEAN);
        let square = self.family.roughness * self.family.roughness;
        // between half vector and normal
        let cos_half = 0.5_f64.sqrt() * (cos_in + cos_out) / (1.0 + cos_between).max(1e-12).sqrt();
        let slopes = square / (PI * (cos_half * cos_half * (square - 1.0) + 1.0).powi(2));
        // 2 cos / (1 + Λ) of Smith's shadowing; the cosines cancel the 4 cos cos in the denominator of the
        // reflection
        let shadow = |cos: f64| 1.0 / (cos + (square + (1.0 - square) * cos * cos).sqrt());
        [body, specular_weight * slopes * of_facets * shadow(cos_in) * shadow(cos_out)]
    }
}
