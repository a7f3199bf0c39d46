//! The default: the most probable spectrum, given the facets and what is known of reflectances.
//!
//! `z = logit r` is Gaussian before the picture is taken; the facets are Gaussian about the model. The maximum of the
//! product is found by Gauss–Newton in whitened z, in the space of the compressed data, and the curvature there gives error bars
//! (Laplace's approximation).

use nalgebra::{Cholesky, DVector, Dyn};

use super::Estimate;
use super::data::FacetData;
use super::prior::{Prior, logistic};
use crate::solve::whitened::{Linearised, WhitenedModel, minimise};

/// The maximum counts as found within this many standard deviations of it.
const TOLERANCE: f64 = 1e-3;
const ITERATION_LIMIT: u32 = 300;

/// The most probable reflectance.
///
/// # Source
/// Objective: Deeb et al., eq. (36), with the prior in place of its smoothness term.
#[must_use]
pub fn estimate(data: &FacetData, prior: &Prior) -> Estimate {
    let posterior = Posterior { data, prior };
    let solution = minimise(
        &posterior,
        DVector::zeros(prior.bands()),
        &inflations(data.signal_to_noise()),
        TOLERANCE,
        ITERATION_LIMIT,
    );
    let reflectance = posterior.reflectance(&solution.w);
    let at = data.residuals(&reflectance);
    Estimate {
        reflectance_sd: posterior.standard_deviation(&reflectance, solution.curvature.as_ref()),
        exposure: at.exposure,
        residual_rms: data.rms(&at.residuals),
        iterations: solution.iterations,
        termination: solution.termination,
        reflectance,
    }
}

/// Factors by which the noise starts larger: from a tenth of the signal down by tens to its true size.
fn inflations(signal_to_noise: f64) -> Vec<f64> {
    let first = 0.1 * signal_to_noise;
    std::iter::successors(Some(first), |inflation| Some(inflation / 10.0))
        .take_while(|inflation| *inflation > 1.0)
        .collect()
}

struct Posterior<'a> {
    data: &'a FacetData<'a>,
    prior: &'a Prior,
}

impl Posterior<'_> {
    fn reflectance(&self, w: &DVector<f64>) -> Vec<f64> {
        self.prior.logit_at(w).iter().map(|z| logistic(*z)).collect()
    }

    /// Square roots of the diagonal of the covariance, carried from logit to reflectance.
    fn standard_deviation(&self, reflectance: &[f64], curvature: Option<&Cholesky<f64, Dyn>>) -> Option<Vec<f64>> {
        // The covariance of the logits is F(I + JᵀJ)⁻¹Fᵀ, F the prior's factor.
        let spread = curvature?.l().solve_lower_triangular(&self.prior.factor().transpose())?;
        let sd = |(band, r): (usize, &f64)| r * (1.0 - r) * spread.column(band).norm();
        Some(reflectance.iter().enumerate().map(sd).collect())
    }
}

impl WhitenedModel for Posterior<'_> {
    fn residuals(&self, w: &DVector<f64>, inflation: f64) -> DVector<f64> {
        self.data.residuals(&self.reflectance(w)).residuals / inflation
    }

    fn linearise(&self, w: &DVector<f64>, inflation: f64) -> Linearised {
        let reflectance = self.reflectance(w);
        let mut at = self.data.residuals(&reflectance);
        for (mut column, r) in at.jacobian.column_iter_mut().zip(&reflectance) {
            column *= r * (1.0 - r) / inflation;
        }
        Linearised { residuals: at.residuals / inflation, jacobian: at.jacobian * self.prior.factor() }
    }
}
