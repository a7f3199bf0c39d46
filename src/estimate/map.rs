//! The default: the most probable spectrum, given the facets and what is known of reflectances.
//!
//! `z = logit r` is Gaussian before the picture is taken; the facets are Gaussian about the model. Newton's method finds the
//! maximum of the product in whitened z, and the curvature there gives error bars (Laplace's approximation).

use nalgebra::{DMatrix, DVector};

use super::Estimate;
use super::data::FacetData;
use super::prior::{Prior, logistic};
use crate::solve::posterior::{Linearised, Model, Solution, maximise};

/// The maximum counts as found within this many standard deviations of it.
const TOLERANCE: f64 = 1e-3;
const ITERATION_LIMIT: u32 = 500;

/// The most probable reflectance.
///
/// # Source
/// Objective: Deeb et al., eq. (36), with the prior in place of its smoothness term.
#[must_use]
pub fn estimate(data: &FacetData, prior: &Prior) -> Estimate {
    let facets = Facets { data, prior };
    let solution = maximise(&facets, TOLERANCE, ITERATION_LIMIT);
    let reflectance = facets.reflectance(&solution.w);
    let at = data.residuals(&reflectance);
    Estimate {
        reflectance_sd: facets.standard_deviation(&reflectance, &solution),
        exposure: at.exposure,
        residual_rms: data.rms(&at.residuals),
        iterations: solution.iterations,
        termination: solution.termination,
        reflectance,
    }
}

/// The facets as a model of the whitened logit of reflectance.
struct Facets<'a> {
    data: &'a FacetData<'a>,
    prior: &'a Prior,
}

impl Facets<'_> {
    fn reflectance(&self, w: &DVector<f64>) -> Vec<f64> {
        self.prior.logit_at(w).iter().map(|z| logistic(*z)).collect()
    }

    /// Square roots of the diagonal of Laplace's covariance, carried from logit to reflectance.
    fn standard_deviation(&self, reflectance: &[f64], solution: &Solution) -> Option<Vec<f64>> {
        // The covariance of the logits is B(I + JᵀJ)⁻¹Bᵀ, B the prior's basis.
        let spread =
            solution.information.as_ref()?.l().solve_lower_triangular(&self.prior.basis().transpose())?;
        let sd = |(band, r): (usize, &f64)| r * (1.0 - r) * spread.column(band).norm();
        Some(reflectance.iter().enumerate().map(sd).collect())
    }
}

impl Model for Facets<'_> {
    fn unknowns(&self) -> usize {
        self.prior.basis().ncols()
    }

    fn residuals(&self, w: &DVector<f64>) -> DVector<f64> {
        self.data.residuals(&self.reflectance(w)).residuals
    }

    fn linearise(&self, w: &DVector<f64>) -> Linearised {
        let reflectance = self.reflectance(w);
        let mut at = self.data.linearise(&reflectance);
        for (mut column, r) in at.jacobian.column_iter_mut().zip(&reflectance) {
            column *= r * (1.0 - r);
        }
        Linearised { residuals: at.residuals, jacobian: at.jacobian * self.prior.basis() }
    }

    fn curvature(&self, w: &DVector<f64>) -> DMatrix<f64> {
        let reflectance = self.reflectance(w);
        let [slopes, curvatures] = self.data.curvature(&reflectance);
        // By the chain rule, with dr/dz = r(1 − r) and d²r/dz² = r(1 − r)(1 − 2r); wavebands do not mix.
        let by_logit =
            reflectance.iter().zip(slopes.iter().zip(&curvatures)).map(|(r, (slope, curvature))| {
                let change = r * (1.0 - r);
                change * (change * curvature + (1.0 - 2.0 * r) * slope)
            });
        let mut weighted = self.prior.basis().clone();
        weighted.row_iter_mut().zip(by_logit).for_each(|(mut row, weight)| row *= weight);
        self.prior.basis().tr_mul(&weighted)
    }
}
