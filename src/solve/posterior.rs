//! The maximum of a Gaussian prior times a Gaussian likelihood of a nonlinear model, by Newton's method.
//!
//! Minimises `½|ρ(w)|² + ½|w|²`, the unknowns w being standard normal under the prior. The Hessian
//! `I + JᵀJ − Σ ρᵢ∇²mᵢ` is exact near the minimum; further off, and where it is not positive, the last term is left out
//! (Gauss–Newton). The step is solved for itself, in the space of the unknowns: the system in the space of the data
//! (Tarantola, *Inverse Problem Theory*, 2005, section 3.2.3) gives the next iterate whole, and the step as a small
//! difference of large vectors loses its digits once the data are a million times as large as their noise.
//!
//! ## Reference
//! J. Nocedal, S. J. Wright, *Numerical Optimization*, 2nd ed. (2006), sections 3.1 and 10.3.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::Termination;

/// Share of the misfit at the start that the noise is first taken for.
const MISFIT: f64 = 0.3;
/// Most steps at each inflation of the noise.
const STEPS_A_STAGE: u32 = 2;
/// Gradient, in the metric of the Hessian, below which second derivatives are trusted.
const NEAR: f64 = 1.0;
/// Longest step, in standard deviations of the prior: further out the model is not the one that was linearised.
const LONGEST: f64 = 10.0;
/// Most halvings of a step.
const HALVINGS: usize = 20;

/// A model seen through data of known noise.
pub trait Model {
    /// Number of unknowns.
    fn unknowns(&self) -> usize;
    /// Data minus model at `w`, in units of the noise.
    fn residuals(&self, w: &DVector<f64>) -> DVector<f64>;
    /// Residuals with first derivatives.
    fn linearise(&self, w: &DVector<f64>) -> Linearised;
    /// `Σ ρᵢ∇²mᵢ` at `w`.
    fn curvature(&self, w: &DVector<f64>) -> DMatrix<f64>;
}

/// A model about a point.
pub struct Linearised {
    /// Residuals.
    pub residuals: DVector<f64>,
    /// Derivatives of the model: residual by unknown.
    pub jacobian: DMatrix<f64>,
}

/// Where the iteration ended.
pub struct Solution {
    /// The unknowns.
    pub w: DVector<f64>,
    /// Factor of `I + JᵀJ` there: the inverse of Laplace's covariance. None if the model was not finite.
    pub information: Option<Cholesky<f64, Dyn>>,
    /// Iterations over all stages.
    pub iterations: u32,
    /// Why it stopped.
    pub termination: Termination,
}

/// Minimises from the prior's mean, the noise first inflated to a third of the misfit there and then, by tens, down to its
/// true size, until a step promises to lower the cost by no more than half of `tolerance` squared: the iterate is then
/// within `tolerance` standard deviations of the minimum.
///
/// Started at the true noise the iteration stalls in the narrow valley that precise data cut.
pub fn maximise(model: &impl Model, tolerance: f64, limit: u32) -> Solution {
    let mut search = Search { model, w: DVector::zeros(model.unknowns()), iterations: 0 };
    let misfit = model.residuals(&search.w);
    let mut inflation = MISFIT * misfit.norm() / (misfit.len().max(1) as f64).sqrt();
    while inflation > 1.0 {
        for _ in 0..STEPS_A_STAGE {
            let (decrement, moved) = search.step(inflation.powi(-2));
            if decrement < 1.0 || !moved {
                break;
            }
        }
        inflation /= 10.0;
    }
    let termination = loop {
        let (decrement, moved) = search.step(1.0);
        if decrement <= tolerance {
            break Termination::Converged { gradient_norm: decrement };
        }
        if !moved {
            break Termination::NoProgress { gradient_norm: decrement };
        }
        if search.iterations >= limit {
            break Termination::IterationLimit;
        }
    };
    let information = Cholesky::new(gauss_newton(&model.linearise(&search.w).jacobian, 1.0));
    Solution { w: search.w, information, iterations: search.iterations, termination }
}

/// `I + weight·JᵀJ`.
fn gauss_newton(jacobian: &DMatrix<f64>, weight: f64) -> DMatrix<f64> {
    let mut hessian = weight * jacobian.tr_mul(jacobian);
    for i in 0..hessian.nrows() {
        hessian[(i, i)] += 1.0;
    }
    hessian
}

struct Search<'a, M> {
    model: &'a M,
    w: DVector<f64>,
    iterations: u32,
}

impl<M: Model> Search<'_, M> {
    /// One step with the data weighted by `weight`: the gradient's norm in the metric of the Hessian before it, and
    /// whether the cost fell.
    fn step(&mut self, weight: f64) -> (f64, bool) {
        self.iterations += 1;
        let at = self.model.linearise(&self.w);
        let Some((direction, decrement)) = self.direction(&at, weight) else { return (f64::INFINITY, false) };
        let cost =
            |w: &DVector<f64>, residuals: &DVector<f64>| weight * residuals.norm_squared() + w.norm_squared();
        let before = cost(&self.w, &at.residuals);
        let next = std::iter::successors(Some(1.0), |length| Some(0.5 * length))
            .take(HALVINGS)
            .map(|length| &self.w + length * &direction)
            .find(|next| cost(next, &self.model.residuals(next)) < before);
        let moved = next.is_some();
        self.w = next.unwrap_or_else(|| self.w.clone());
        (decrement, moved)
    }

    /// Gauss and Newton's direction, damped until it is no longer than [`LONGEST`], or near the minimum Newton's where the
    /// Hessian is positive; and the gradient's norm in the metric of the undamped Hessian.
    fn direction(&self, at: &Linearised, weight: f64) -> Option<(DVector<f64>, f64)> {
        let descent = weight * at.jacobian.tr_mul(&at.residuals) - &self.w;
        let solve = |hessian: &DMatrix<f64>| {
            let direction = Cholesky::new(hessian.clone())?.solve(&descent);
            let decrement = descent.dot(&direction).max(0.0).sqrt();
            Some((direction, decrement))
        };
        let mut hessian = gauss_newton(&at.jacobian, weight);
        let (mut direction, decrement) = solve(&hessian)?;
        if decrement <= NEAR {
            let newton = solve(&(hessian - weight * self.model.curvature(&self.w)));
            return Some(newton.unwrap_or((direction, decrement)));
        }
        let mut damping = 1.0;
        while direction.norm() > LONGEST {
            for i in 0..direction.len() {
                hessian[(i, i)] += damping;
            }
            (direction, _) = solve(&hessian)?;
            damping *= 10.0;
        }
        Some((direction, decrement))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One unknown w seen as `scale·exp(w)`, in units of the noise.
    struct Exponential {
        data: f64,
        scale: f64,
    }

    impl Model for Exponential {
        fn unknowns(&self) -> usize {
            1
        }

        fn residuals(&self, w: &DVector<f64>) -> DVector<f64> {
            DVector::from_element(1, self.data - self.scale * w[0].exp())
        }

        fn linearise(&self, w: &DVector<f64>) -> Linearised {
            let jacobian = DMatrix::from_element(1, 1, self.scale * w[0].exp());
            Linearised { residuals: self.residuals(w), jacobian }
        }

        fn curvature(&self, w: &DVector<f64>) -> DMatrix<f64> {
            self.residuals(w)[0] * DMatrix::from_element(1, 1, self.scale * w[0].exp())
        }
    }

    #[test]
    fn the_gradient_vanishes_where_it_says_so() {
        for (data, scale) in [(3.0, 1.0), (0.1, 1.0), (-2.0, 0.5), (5e6, 1e6)] {
            let model = Exponential { data, scale };
            let found = maximise(&model, 1e-6, 100);
            let w = found.w[0];
            let slope = w - (data - scale * w.exp()) * scale * w.exp();
            let information = 1.0 + (scale * w.exp()).powi(2);
            assert!(matches!(found.termination, Termination::Converged { .. }), "{:?}", found.termination);
            assert!(slope.abs() < 2e-6 * information.sqrt(), "{data} {scale}: {slope}");
            let factor = found.information.unwrap().l()[(0, 0)];
            assert!((factor * factor / information - 1.0).abs() < 1e-12);
        }
    }
}
