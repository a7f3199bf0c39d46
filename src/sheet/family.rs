//! Parametric reflection of sheets: a rough or fibrous body under a rough surface.

use std::f64::consts::{FRAC_1_PI, PI};

use pulp::{Arch, Simd, WithSimd};

use super::angles::{AngleList, Angles};
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
    pub(super) fn at(&self, angles: &Angles) -> [f64; 2] {
        let Angles { cos_in, cos_out, cos_between, fresnel: [of_in, of_out, of_facets], .. } = *angles;
        let cosines = [cos_in, cos_out, cos_between];
        let surface = if self.has_surface() { self.surface(cosines, of_facets) } else { 0.0 };
        [self.body(cosines, [of_in, of_out]), surface]
    }

    /// The same for each of many pairs of directions.
    pub(super) fn at_each(&self, angles: &AngleList) -> [Vec<f64>; 2] {
        let mut reflections = [0, 1].map(|_| vec![0.0; angles.len()]);
        let [body, surface] = &mut reflections;
        Arch::new().dispatch(Each { terms: self, angles, body, surface });
        reflections
    }

    fn has_surface(&self) -> bool {
        self.family.specular_weight != 0.0
    }

    /// The body at these cosines of incidence, of exit and between the directions, with the Fresnel
    /// reflectances of the first two.
    ///
    /// # Source
    /// M. Oren, S. Nayar, SIGGRAPH 1994, eq. (30).
    #[inline(always)]
    fn body(&self, [cos_in, cos_out, cos_between]: [f64; 3], [of_in, of_out]: [f64; 2]) -> f64 {
        let Family { specular_weight, sheen, .. } = self.family;
        // the sines of both angles times the cosine of the azimuth between the directions
        let along_sheet = cos_between - cos_in * cos_out;
        let towards = along_sheet.max(0.0) / cos_in.max(cos_out);
        let grazing = (1.0 - cos_in).powi(SHEEN_POWER) + (1.0 - cos_out).powi(SHEEN_POWER);
        let under_surface = (1.0 - specular_weight * of_in) * (1.0 - specular_weight * of_out);
        FRAC_1_PI * (self.even + self.towards_light * towards) * (1.0 + sheen * grazing) * under_surface
            / (1.0 - specular_weight * FRESNEL_MEAN)
    }

    /// The surface, with the Fresnel reflectance of its facets.
    ///
    /// # Source
    /// B. Walter et al., EGSR 2007, for GGX and its shadowing.
    #[inline(always)]
    fn surface(&self, [cos_in, cos_out, cos_between]: [f64; 3], of_facets: f64) -> f64 {
        let square = self.family.roughness * self.family.roughness;
        // between half vector and normal, squared
        let half = 0.5 * (cos_in + cos_out) * (cos_in + cos_out) / (1.0 + cos_between).max(1e-12);
        let width = half * (square - 1.0) + 1.0;
        // 2 cos / (1 + Λ) of Smith's shadowing; the cosines cancel the 4 cos cos in the denominator of the
        // reflection
        let shadow = |cos: f64| cos + (square + (1.0 - square) * cos * cos).sqrt();
        let denominator = PI * width * width * shadow(cos_in) * shadow(cos_out);
        self.family.specular_weight * square * of_facets / denominator
    }
}

/// The computation of [`Terms::at_each`], with the widest vectors of the processor.
struct Each<'a> {
    terms: &'a Terms,
    angles: &'a AngleList,
    body: &'a mut [f64],
    surface: &'a mut [f64],
}

impl WithSimd for Each<'_> {
    type Output = ();

    // Plain loops over slices of one length are compiled to vectors; closures would not be.
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { terms, angles: AngleList { cos_in, cos_out, cos_between, fresnel, .. }, body, surface } =
            self;
        let count = body.len();
        let (cos_in, cos_out, cos_between) = (&cos_in[..count], &cos_out[..count], &cos_between[..count]);
        let [of_in, of_out, of_facets] = fresnel;
        let (of_in, of_out, of_facets) = (&of_in[..count], &of_out[..count], &of_facets[..count]);
        for n in 0..count {
            body[n] = terms.body([cos_in[n], cos_out[n], cos_between[n]], [of_in[n], of_out[n]]);
        }
        if terms.has_surface() {
            let surface = &mut surface[..count];
            for n in 0..count {
                surface[n] = terms.surface([cos_in[n], cos_out[n], cos_between[n]], of_facets[n]);
            }
        }
    }
}
