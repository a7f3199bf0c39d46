//! Requirements of the bounces on any surface for a discretisation.

/// The exchange of light between the patches of a surface.
///
/// Vectors hold one number per patch, in coordinates in which the exchange is symmetric: the square root of
/// the patch's area times its irradiance. The bounces are solved on patches; each lies in one facet, where
/// colour is measured.
pub trait Exchange: Sync {
    /// Square root of the area of every patch, in any unit, positive.
    fn root_areas(&self) -> &[f64];

    /// The facet of every patch, counted from 0; each facet has at least one patch.
    fn facet_of(&self) -> &[usize];

    /// `out = S·x`, `S = √A·K·√A⁻¹`: the light that patches receive from the exitance `x`, with K of
    /// eq. (10).
    fn apply(&self, x: &[f64], out: &mut [f64]);

    /// Number of patches.
    fn unknowns(&self) -> usize {
        self.root_areas().len()
    }

    /// Number of facets.
    fn facets(&self) -> usize {
        self.facet_of().iter().max().map_or(0, |last| last + 1)
    }

    /// The coordinates of an `irradiance`, one number per patch.
    fn start(&self, irradiance: &[f64]) -> Vec<f64> {
        self.root_areas().iter().zip(irradiance).map(|(root, value)| root * value).collect()
    }

    /// Mean irradiance over every facet, from coordinates `x`.
    fn facet_means(&self, x: &[f64]) -> Vec<f64> {
        let (mut light, mut area) = (vec![0.0; self.facets()], vec![0.0; self.facets()]);
        for ((facet, root), x) in self.facet_of().iter().zip(self.root_areas()).zip(x) {
            light[*facet] += root * x;
            area[*facet] += root * root;
        }
        light.iter().zip(&area).map(|(light, area)| light / area).collect()
    }
}
