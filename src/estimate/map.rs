//! The default: the most probable spectrum, given the facets and what is known of reflectances.
//!
//! `z = logit r` is Gaussian before the picture is taken; the facets are Gaussian about the model. Newton's method finds the
//! maximum of the product, and the curvature there gives error bars (Laplace's approximation).

use nalgebra::DVector;

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
    let inflations = inflations(data.signal_to_noise());
    let solution = maximise(&Facets { data }, prior.logit(), &inflations, TOLERANCE, ITERATION_LIMIT);
    let reflectance = reflectance(&solution.z);
    let at = data.residuals(&reflectance);
    Estimate {
        reflectance_sd: standard_deviation(&reflectance, &solution),
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

fn reflectance(logit: &DVector<f64>) -> Vec<f64> {
    logit.iter().map(|z| logistic(*z)).collect()
}

/// Square roots of the diagonal of Laplace's covariance, carried from logit to reflectance.
fn standard_deviation(reflectance: &[f64], solution: &Solution) -> Option<Vec<f64>> {
    let covariance = solution.information.as_ref()?.inverse();
    Some(
        reflectance
            .iter()
            .enumerate()
            .map(|(band, r)| r * (1.0 - r) * covariance[(band, band)].sqrt())
            .collect(),
    )
}

/// The facets as a model of the logit of reflectance.
struct Facets<'a> {
    data: &'a FacetData<'a>,
}

impl Model for Facets<'_> {
    fn residuals(&self, z: &DVector<f64>) -> DVector<f64> {
        self.data.residuals(&reflectance(z)).residuals
    }

    fn linearise(&self, z: &DVector<f64>) -> Linearised {
        let reflectance = reflectance(z);
        let mut at = self.data.linearise(&reflectance);
        // By the chain rule, with dr/dz = r(1 − r) and d²r/dz² = r(1 − r)(1 − 2r).
        let along = at.jacobian.tr_mul(&at.residuals);
        for (band, r) in reflectance.iter().enumerate() {
            let slope = r * (1.0 - r);
            at.curvature[band] = slope * (slope * at.curvature[band] + (1.0 - 2.0 * r) * along[band]);
            at.jacobian.column_mut(band).scale_mut(slope);
        }
        Linearised { residuals: at.residuals, jacobian: at.jacobian, curvature: at.curvature }
    }
}
