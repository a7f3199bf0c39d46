//! The paper's estimator: least squares with smoothness, within bounds.
//!
//! Deeb et al., eq. (36), minimised by an interior point method as in the paper's section 4B.

use argmin::core::{
    CostFunction, Error as SolverError, Executor, Gradient, Hessian, State, TerminationReason,
    TerminationStatus,
};
use nalgebra::{DMatrix, DVector};

use super::interior_point;
use super::interior_point::InteriorPoint;
use crate::error::{Error, Result};
use crate::estimate::Estimate;
use crate::estimate::data::FacetData;
use crate::solve::Termination;

/// Default weight of smoothness.
pub const SMOOTHNESS: f64 = 1e-5;
/// Least significant change of facets, white being 1.
pub const CUTOFF: f64 = 1e-8;
const TOLERANCE: f64 = 1e-9;
pub(super) const ITERATION_LIMIT: u64 = 300;
/// Range of the weight of smoothness under the discrepancy principle, and number of bisections of its
/// logarithm.
const SMOOTHNESS_RANGE: [f64; 2] = [1e-9, 1.0];
const BISECTIONS: usize = 10;

/// Minimises the residual of the facets, white being 1, plus `smoothness` times the squared second
/// differences of the spectrum (step: one waveband), with every reflectance in (0, 1].
///
/// `start` is the initial reflectance.
///
/// # Errors
/// [`Error::Numeric`] if the solver fails.
pub fn estimate(data: &FacetData, smoothness: f64, start: &[f64]) -> Result<Estimate> {
    let objective = Objective { data, penalty: smoothness * second_difference_gram(start.len()) };
    let solver = InteriorPoint::new(0.0, 1.0, TOLERANCE);
    let run = Executor::new(objective, solver)
        .configure(|state| state.param(DVector::from_column_slice(start)).max_iters(ITERATION_LIMIT))
        .timer(false)
        .run()
        .map_err(|e| Error::Numeric(format!("interior point: {e}")))?;
    let state = run.state();
    let reflectance: Vec<f64> = state.get_best_param().map(|r| r.as_slice().to_vec()).unwrap_or_default();
    let at = data.residuals(&reflectance, &[]);
    let left = (data.rms(&at.residuals), data.unexplained(&at.residuals));
    Ok(Estimate::of(reflectance, at.ingredients.exposure, left, ended(state, run.solver())))
}

/// The estimate with the largest smoothness whose residuals do not exceed the noise, with standard deviation
/// `noise_sd`, white being 1.
///
/// # Source
/// Morozov's discrepancy principle: Hansen, *Discrete Inverse Problems* (2010), section 5.2.
///
/// # Errors
/// As [`estimate`].
pub fn estimate_by_discrepancy(data: &FacetData, noise_sd: f64, start: &[f64]) -> Result<Estimate> {
    let [mut low, mut high] = SMOOTHNESS_RANGE.map(f64::ln);
    let mut best = estimate(data, low.exp(), start)?;
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        let smoother = estimate(data, middle.exp(), &best.reflectance)?;
        if smoother.residual_rms <= noise_sd {
            (low, best) = (middle, smoother);
        } else {
            high = middle;
        }
    }
    Ok(best)
}

/// Number of iterations of a run, and why it stopped.
pub(super) fn ended(state: &interior_point::State, solver: &InteriorPoint) -> (u32, Termination) {
    let gradient_norm = solver.violation();
    let termination = match state.get_termination_status() {
        TerminationStatus::Terminated(TerminationReason::SolverConverged) => {
            Termination::Converged { gradient_norm }
        }
        TerminationStatus::Terminated(TerminationReason::MaxItersReached) => Termination::IterationLimit,
        _ => Termination::NoProgress { gradient_norm },
    };
    (u32::try_from(state.get_iter()).unwrap_or(u32::MAX), termination)
}

/// `DᵀD` of the second differences D.
pub(super) fn second_difference_gram(bands: usize) -> DMatrix<f64> {
    let differences = DMatrix::from_fn(bands.saturating_sub(2), bands, |i, j| match j.wrapping_sub(i) {
        0 | 2 => 1.0,
        1 => -2.0,
        _ => 0.0,
    });
    differences.tr_mul(&differences)
}

/// Eq. (36) with Gauss-Newton curvature.
struct Objective<'a> {
    data: &'a FacetData<'a>,
    penalty: DMatrix<f64>,
}

impl CostFunction for Objective<'_> {
    type Param = DVector<f64>;
    type Output = f64;

    fn cost(&self, r: &DVector<f64>) -> std::result::Result<f64, SolverError> {
        Ok(self.data.residuals(r.as_slice(), &[]).residuals.norm_squared() + r.dot(&(&self.penalty * r)))
    }
}

impl Gradient for Objective<'_> {
    type Param = DVector<f64>;
    type Gradient = DVector<f64>;

    fn gradient(&self, r: &DVector<f64>) -> std::result::Result<DVector<f64>, SolverError> {
        let at = self.data.linearise(r.as_slice(), &[]);
        Ok(2.0 * (&self.penalty * r - at.jacobian.tr_mul(&at.residuals)))
    }
}

impl Hessian for Objective<'_> {
    type Param = DVector<f64>;
    type Hessian = DMatrix<f64>;

    fn hessian(&self, r: &DVector<f64>) -> std::result::Result<DMatrix<f64>, SolverError> {
        let at = self.data.linearise(r.as_slice(), &[]);
        Ok(2.0 * (at.jacobian.tr_mul(&at.jacobian) + &self.penalty))
    }
}
