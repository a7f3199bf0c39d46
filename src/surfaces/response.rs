//! One light on any surface, with bounces for every reflectance at once.

use super::Exchange;
use crate::error::{Error, Result};
use crate::response::{Excited, ModeSet};

/// Response of the bounces to one light, as poles and residues for every facet: with one reflectance r, facet
/// i receives `E_i(r) = Σ_k residue_ik / (1 − r·pole_k)`.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceResponse {
    modes: ModeSet,
}

impl SurfaceResponse {
    /// Reduces `exchange` under a direct `irradiance`, one number per patch, to poles and residues whose
    /// residual in the system of eq. (15) is at most `tolerance`, relative to the light, for every
    /// reflectance in [0, 1].
    ///
    /// # Returns
    /// The response and the residual achieved.
    ///
    /// # Source
    /// Deeb et al., eqs. (16) and (26) to (28), by the Lanczos method as in
    /// [`crate::response::Response::solve`].
    ///
    /// # Errors
    /// [`Error::Numeric`] if no light falls on the surface, or none escapes it.
    ///
    /// # Example
    /// ```
    /// use nalgebra::dmatrix;
    /// use vfold::surfaces::{DenseExchange, SurfaceResponse};
    /// // Two like patches hand half of their light to each other, and one is lit: it gets
    /// // 1 + (r/2)² + (r/2)⁴ + ...
    /// let exchange = DenseExchange::new(&dmatrix![0.0, 0.5; 0.5, 0.0], &[1.0, 1.0], vec![0, 1]);
    /// let (response, _) = SurfaceResponse::solve(&exchange, &[1.0, 0.0], 1e-12)?;
    /// assert!((response.irradiance(0, 0.8) - 1.0 / (1.0 - 0.16)).abs() < 1e-14);
    /// assert!((response.irradiance(1, 0.8) - 0.4 / (1.0 - 0.16)).abs() < 1e-14);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn solve(
        exchange: &(impl Exchange + ?Sized),
        irradiance: &[f64],
        tolerance: f64,
    ) -> Result<(Self, f64)> {
        if !irradiance.iter().any(|light| *light > 0.0) {
            return Err(Error::Numeric("no light falls on the surface: turn it to the light".to_owned()));
        }
        let light = Excited {
            start: exchange.start(irradiance),
            apply: |x: &[f64], out: &mut [f64]| exchange.apply(x, out),
            means: |x: &[f64]| exchange.facet_means(x),
            direct: None,
        };
        let (modes, residual) = light.lanczos(tolerance)?;
        Ok((Self { modes }, residual))
    }

    /// A response from its modes.
    ///
    /// # Errors
    /// [`Error::Field`] if the shapes disagree or a pole is not inside (−1, 1).
    pub fn new(modes: ModeSet) -> Result<Self> {
        modes.check()?;
        Ok(Self { modes })
    }

    /// Its modes.
    #[must_use]
    pub fn modes(&self) -> &ModeSet {
        &self.modes
    }

    /// Number of facets.
    #[must_use]
    pub fn facets(&self) -> usize {
        self.modes.residues.nrows()
    }

    /// Irradiance of a facet including all bounces, for a surface of this `reflectance`, in [0, 1].
    #[must_use]
    pub fn irradiance(&self, facet: usize, reflectance: f64) -> f64 {
        self.modes.of_facet(facet).map(|(pole, residue)| residue / (1.0 - reflectance * pole)).sum()
    }
}
