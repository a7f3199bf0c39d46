//! Least squares with a standard normal prior, solved in the space of the data.
//!
//! Minimises `½|ρ(w)|² + ½|w|²`. The step of Gauss and Newton is `w ← Jᵀ(I + JJᵀ)⁻¹(ρ + Jw)`, a system as large as the
//! data; with a handful of data and many unknowns that is all the work there is.
//!
//! ## Reference
//! A. Tarantola, *Inverse Problem Theory* (2005), section 3.2.3 (the quasi-Newton method in the data space).

use nalgebra::{Cholesky, DMatrix, DVector};

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
    /// Factor of `I + JJᵀ` and J there: they carry the covariance.
    pub jacobian: DMatrix<f64>,
    /// Iterations over all stages.
    pub iterations: u32,
    /// Why it stopped.
    pub termination: Termination,
}

/// Minimises from `start`, first with the noise inflated by each of `inflations` for two steps, then at its true size until
/// the gradient's norm is below `tolerance`.
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
            let (next, _) = line_search(model, *inflation, &w, &at, &full_step(&at, &w));
            w = next;
            iterations += 1;
        }
    }
    loop {
        let at = model.linearise(&w, 1.0);
        let gradient_norm = (&w - at.jacobian.tr_mul(&at.residuals)).norm();
        let stop =
            |termination| Solution { w: w.clone(), jacobian: at.jacobian.clone(), iterations, termination };
        if gradient_norm <= tolerance {
            return stop(Termination::Converged { gradient_norm });
        }
        if iterations >= limit {
            return stop(Termination::IterationLimit);
        }
        let (next, moved) = line_search(model, 1.0, &w, &at, &full_step(&at, &w));
        if !moved {
            return stop(Termination::NoProgress { gradient_norm });
        }
        w = next;
        iterations += 1;
    }
}

/// The Gauss–Newton step from `w`.
fn full_step(at: &Linearised, w: &DVector<f64>) -> DVector<f64> {
    let right = &at.residuals + &at.jacobian * w;
    match data_factor(&at.jacobian) {
        Some(factor) => at.jacobian.tr_mul(&factor.solve(&right)) - w,
        None => DVector::zeros(w.len()),
    }
}

/// Cholesky factor of `I + JJᵀ`; none only if J is not finite.
#[must_use]
pub fn data_factor(jacobian: &DMatrix<f64>) -> Option<Cholesky<f64, nalgebra::Dyn>> {
    let mut gram = jacobian * jacobian.transpose();
    for i in 0..gram.nrows() {
        gram[(i, i)] += 1.0;
    }
    Cholesky::new(gram)
}

/// Halves the step until the cost falls; the point it ends at, and whether it moved.
fn line_search(
    model: &impl WhitenedModel,
    inflation: f64,
    w: &DVector<f64>,
    at: &Linearised,
    step: &DVector<f64>,
) -> (DVector<f64>, bool) {
    let before = at.residuals.norm_squared() + w.norm_squared();
    let mut length = 1.0;
    for _ in 0..20 {
        let next = w + length * step;
        if model.residuals(&next, inflation).norm_squared() + next.norm_squared() < before {
            return (next, true);
        }
        length *= 0.5;
    }
    (w.clone(), false)
}
