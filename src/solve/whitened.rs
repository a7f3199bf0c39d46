//! Least squares with a standard normal prior on the unknowns.
//!
//! Minimises `½|ρ(w)|² + ½|w|²` by Gauss–Newton steps `(I + JᵀJ) d = Jᵀρ − w` with a line search. The step is solved for
//! itself, in the space of the unknowns: the smaller system `w + d = Jᵀ(I + JJᵀ)⁻¹(ρ + Jw)` in the space of the data
//! (Tarantola, *Inverse Problem Theory*, 2005, section 3.2.3) gives the step as a difference of two large vectors and, with
//! data a million times as large as their noise, loses all its digits.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::Termination;

/// Residuals, data minus model, of unit variance, and the Jacobian of the model.
pub struct Linearised {
    /// Residuals.
    pub residuals: DVector<f64>,
    /// Derivatives of the model: residual by unknown.
    pub jacobian: DMatrix<f64>,
}

/// A model that can be linearised at whitened unknowns.
pub trait WhitenedModel {
    /// Residuals at `w`, divided by `inflation`.
    fn residuals(&self, w: &DVector<f64>, inflation: f64) -> DVector<f64>;
    /// Residuals and Jacobian at `w`, both divided by `inflation`.
    fn linearise(&self, w: &DVector<f64>, inflation: f64) -> Linearised;
}

/// Where the iteration ended.
pub struct Solution {
    /// The unknowns.
    pub w: DVector<f64>,
    /// Factor of `I + JᵀJ` there: the inverse of the covariance. None if the model was not finite.
    pub curvature: Option<Cholesky<f64, Dyn>>,
    /// Iterations over all stages.
    pub iterations: u32,
    /// Why it stopped.
    pub termination: Termination,
}

/// Minimises from `start`, first with the noise inflated by each of `inflations` for two steps, then at its true size until
/// a step would lower the cost by no more than `tolerance` squared: the iterate is then within `tolerance` standard
/// deviations of the minimum.
///
/// Started at the true noise the iteration stalls in the narrow valley that precise data cut.
pub fn minimise(
    model: &impl WhitenedModel,
    start: DVector<f64>,
    inflations: &[f64],
    tolerance: f64,
    limit: u32,
) -> Solution {
    let mut w = start;
    let mut iterations = 0;
    for inflation in inflations {
        for _ in 0..2 {
            let at = model.linearise(&w, *inflation);
            if let Some(step) = Step::new(&at, &w) {
                w = line_search(model, *inflation, &w, &at, &step.direction).unwrap_or(w);
            }
            iterations += 1;
        }
    }
    loop {
        let at = model.linearise(&w, 1.0);
        let step = Step::new(&at, &w);
        let decrement = step.as_ref().map_or(f64::INFINITY, |step| step.decrement);
        let next = step.as_ref().and_then(|step| line_search(model, 1.0, &w, &at, &step.direction));
        let termination = if decrement <= tolerance {
            Termination::Converged { gradient_norm: decrement }
        } else if iterations >= limit {
            Termination::IterationLimit
        } else if next.is_none() {
            Termination::NoProgress { gradient_norm: decrement }
        } else {
            w = next.unwrap_or(w);
            iterations += 1;
            continue;
        };
        return Solution { w, curvature: step.map(|step| step.curvature), iterations, termination };
    }
}

/// The Gauss–Newton step at a point.
struct Step {
    direction: DVector<f64>,
    /// Root of twice the decrease that the step promises: the gradient's norm in the metric of the curvature.
    decrement: f64,
    /// Factor of `I + JᵀJ`.
    curvature: Cholesky<f64, Dyn>,
}

impl Step {
    /// None only if the model is not finite.
    fn new(at: &Linearised, w: &DVector<f64>) -> Option<Self> {
        let mut curvature = at.jacobian.tr_mul(&at.jacobian);
        for i in 0..w.len() {
            curvature[(i, i)] += 1.0;
        }
        let curvature = Cholesky::new(curvature)?;
        let descent = at.jacobian.tr_mul(&at.residuals) - w;
        let direction = curvature.solve(&descent);
        let decrement = descent.dot(&direction).max(0.0).sqrt();
        Some(Self { direction, decrement, curvature })
    }
}

/// Halves the step until the cost falls; the point it ends at, if there is one.
fn line_search(
    model: &impl WhitenedModel,
    inflation: f64,
    w: &DVector<f64>,
    at: &Linearised,
    step: &DVector<f64>,
) -> Option<DVector<f64>> {
    let before = at.residuals.norm_squared() + w.norm_squared();
    let halvings = std::iter::successors(Some(1.0), |length| Some(0.5 * length)).take(20);
    halvings
        .map(|length| w + length * step)
        .find(|next| model.residuals(next, inflation).norm_squared() + next.norm_squared() < before)
}
