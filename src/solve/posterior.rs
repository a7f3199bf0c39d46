//! The posterior mode of a nonlinear model with Gaussian prior and Gaussian noise, by Newton's method.
//!
//! Minimises `½|ρ(w)|² + ½|w|²`, where the unknowns w are standard normal under the prior. Data a million
//! times as large as their noise act as constraints, and their residuals far from the minimum say nothing
//! about the curvature along them. Second derivatives are therefore weighted by multipliers as in sequential
//! quadratic programming, namely the residuals of the linearised model: `I + JᵀJ − Σ (ρ − Jδ)ᵢ∇²mᵢ`. A step
//! spoilt by the curvature of constraints gets a second-order correction. The system is solved for the step,
//! in the space of the unknowns: the one in the space of the data (Tarantola, *Inverse Problem Theory*, 2005,
//! section 3.2.3) yields the whole next iterate, and the step, as a small difference of large vectors, loses
//! its digits.
//!
//! ## Reference
//! J. Nocedal, S. J. Wright, *Numerical Optimization*, 2nd ed. (2006), sections 10.3, 18.1 and 18.3.

use std::cmp::Ordering;
use std::sync::OnceLock;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::Termination;
use super::dense::{cholesky, dot_products, squares};

/// Initial noise as a share of the residual at the start.
const FIRST_SHARE: f64 = 0.3;
/// Factor by which the noise falls from stage to stage, the root of ten. A tenth would release so many
/// coordinates at once that the next stage may start far from the valley cut by precise data.
const STAGE: f64 = 3.162_277_660_168_379_5;
/// Maximum number of steps at each tempering of the noise, and the norm of the gradient, in the metric of the
/// Hessian, that ends a stage earlier.
const STEPS_A_STAGE: u32 = 60;
const END_OF_STAGE: f64 = 1.0;
/// Longest step, in standard deviations of the prior: the linearisation does not hold beyond.
const LONGEST: f64 = 10.0;
/// Maximum number of trials of a step; initial damping, and its factors after a failure and after a success.
const TRIALS: usize = 14;
const DAMPING: f64 = 0.1;
const DAMPING_UP: f64 = 5.0;
const DAMPING_DOWN: f64 = 0.1;
const DAMPING_LEAST: f64 = 1e-3;
/// Where curvature is left out, damping falls after a step that achieves more than the first of these shares
/// of the predicted decrease, and rises after one that achieves less than the second (Nocedal and Wright,
/// section 4.1, for the radius of a trust region).
const KEPT_WELL: f64 = 0.75;
const KEPT_BADLY: f64 = 0.25;
/// Minimum predicted decrease of a damped step, relative to that at convergence: at a kink of the model, or
/// with finite-difference derivatives, no step lowers the cost.
const LEAST_PROMISE: f64 = 0.01;
/// Maximum number of corrections of a step, and the share of the predicted decrease that suffices. With one
/// correction a third more steps are needed; with more than two some searches end in another mode.
const CORRECTIONS: usize = 2;
const KEPT: f64 = 0.1;
/// At the noise of a stage the linear model foresees the evidence of a mode so well that it hardly ever gains
/// more than this share of the predicted decrease beyond it, and this logarithm (searches of photographs in
/// `../shared/train`). At less noise, or before the first step, it may foresee far too little.
const BEYOND_FORESEEN: f64 = 0.1;
const LN_BEYOND_FORESEEN: f64 = 1.0;

/// A model observed through data of known noise.
pub trait Model {
    /// What second derivatives at a point are computed from.
    type Second;
    /// What is computed for the residuals at a point and serves for derivatives, too.
    type Ingredients;
    /// Number of unknowns.
    fn unknowns(&self) -> usize;
    /// The model at `w`.
    fn evaluate(&self, w: &DVector<f64>) -> Evaluated<Self::Ingredients>;
    /// The model there with its derivatives.
    fn derivatives(&self, w: &DVector<f64>, at: Evaluated<Self::Ingredients>) -> Linearised<Self::Second>;
    /// Data minus model at `w`, in units of the noise.
    fn residuals(&self, w: &DVector<f64>) -> DVector<f64> {
        self.evaluate(w).residuals
    }
    /// Residuals with their derivatives.
    fn linearise(&self, w: &DVector<f64>) -> Linearised<Self::Second> {
        self.derivatives(w, self.evaluate(w))
    }
    /// `Σ λᵢ∇²mᵢ` at a point, with one multiplier λ per residual; `None` if it is omitted, as where priors
    /// bound the unknowns and noise does not act as a constraint.
    fn curvature(&self, _at: &Self::Second, _multipliers: &DVector<f64>) -> Option<DMatrix<f64>> {
        None
    }
}

/// A model at a point.
pub struct Evaluated<I> {
    /// Data minus model, in units of the noise.
    pub residuals: DVector<f64>,
    /// What else derivatives there are computed from.
    pub ingredients: I,
}

/// A model linearised about a point.
pub struct Linearised<S> {
    /// Residuals.
    pub residuals: DVector<f64>,
    /// Derivatives of the model: residual by unknown.
    pub jacobian: DMatrix<f64>,
    /// For [`Model::curvature`].
    pub second: S,
    /// The lower triangle of `JᵀJ`, computed once it is asked for.
    squares: OnceLock<DMatrix<f64>>,
}

impl<S> Linearised<S> {
    /// A model with these residuals and derivatives.
    #[must_use]
    pub fn new(residuals: DVector<f64>, jacobian: DMatrix<f64>, second: S) -> Self {
        Self { residuals, jacobian, second, squares: OnceLock::new() }
    }

    /// The lower triangle of `I + weight·JᵀJ`; nothing else of it is used.
    pub(super) fn gauss_newton(&self, weight: f64) -> DMatrix<f64> {
        let mut hessian = weight * self.squares.get_or_init(|| squares(&self.jacobian));
        add_to_diagonal(&mut hessian, 1.0);
        hessian
    }

    /// Factor of `I + JᵀJ`, the inverse of Laplace's covariance; `None` if the model was not finite.
    #[must_use]
    pub fn information(&self) -> Option<Cholesky<f64, Dyn>> {
        cholesky(self.gauss_newton(1.0))
    }
}

/// Result of the iteration.
pub struct Solution<S> {
    /// The unknowns.
    pub w: DVector<f64>,
    /// The model there.
    pub at: Linearised<S>,
    /// Iterations of all stages, each at its beginning.
    pub trace: Vec<Iteration>,
    /// Why it stopped.
    pub termination: Termination,
}

/// State at the beginning of an iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    /// `|ρ(w)|² + |w|²` with tempered noise.
    pub cost: f64,
    /// Norm of the gradient in the metric of the Hessian.
    pub gradient_norm: f64,
    /// Damping of the first trial step.
    pub damping: f64,
    /// Factor by which the noise is tempered.
    pub tempering: f64,
}

impl<S> Solution<S> {
    /// Log evidence of the data under prior and model, with the noise scaled by `tempering`, up to a term
    /// that depends on the data alone.
    ///
    /// # Source
    /// Laplace approximation: Bishop, *Pattern Recognition and Machine Learning* (2006), section 4.4.
    #[must_use]
    pub fn ln_evidence(&self, tempering: f64) -> Option<f64> {
        let weight = tempering.powi(-2);
        let information = cholesky(self.at.gauss_newton(weight))?;
        Some(-0.5 * (cost(weight, &self.w, &self.at.residuals) + information.ln_determinant()))
    }

    /// The minimum of the model linearised here, with the noise scaled by `tempering`, and that model there:
    /// close enough to a minimum it is as good as another step. `None` if the model is not finite.
    #[must_use]
    pub fn foreseen(mut self, tempering: f64) -> Option<Self> {
        let step = GaussNewton::at(&self.w, &self.at, tempering.powi(-2))?.direction;
        self.at.residuals -= &self.at.jacobian * &step;
        self.w += step;
        Some(self)
    }

    /// Twice the objective, with the noise scaled by `tempering`.
    #[must_use]
    pub fn cost(&self, tempering: f64) -> f64 {
        cost(tempering.powi(-2), &self.w, &self.at.residuals)
    }

    /// Distance of the data from the prior prediction in standard deviations, with the noise scaled by
    /// `tempering`. For a linear model the cost at the mode is chi-squared, with as many degrees of freedom
    /// as there are data; at a false mode the distance is large.
    #[must_use]
    pub fn surprise(&self, tempering: f64) -> f64 {
        let data = self.at.residuals.len() as f64;
        (self.cost(tempering) - data) / (2.0 * data).sqrt()
    }
}

/// Conditions that end a search before its minimum.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Number of iterations.
    pub iterations: usize,
    /// A log evidence, as [`Solution::ln_evidence`]: the search ends when it foresees less. It never rises
    /// when the noise falls.
    pub ln_evidence: f64,
}

impl From<usize> for Limits {
    /// With this number of iterations.
    fn from(iterations: usize) -> Self {
        Self { iterations, ln_evidence: f64::NEG_INFINITY }
    }
}

/// The initial tempering of the noise: 0.3 times the root mean square residual at `w`, but at least `least`.
pub fn first_tempering(model: &impl Model, w: &DVector<f64>, least: f64) -> f64 {
    let residuals = model.residuals(w);
    (FIRST_SHARE * residuals.norm() / (residuals.len().max(1) as f64).sqrt()).max(least)
}

/// Minimises from `start`. The noise is first scaled by `tempering.0` and then reduced by roots of ten down
/// to `tempering.1` times its true size, until a step is predicted to lower the cost by no more than half of
/// `tolerance` squared: the iterate is then within `tolerance` standard deviations of the minimum.
///
/// Started at the true noise, the iteration stalls in the narrow valley cut by precise data.
pub fn find_mode<M: Model>(
    model: &M,
    start: DVector<f64>,
    tempering: (f64, f64),
    tolerance: f64,
    limits: impl Into<Limits>,
) -> Solution<M::Second> {
    let (mut now, last) = tempering;
    let limits = limits.into();
    let mut search = Search {
        model,
        at: model.linearise(&start),
        w: start,
        damping: 0.0,
        least_promise: LEAST_PROMISE * tolerance * tolerance,
        trace: Vec::new(),
    };
    let mut steps = 0;
    let termination = loop {
        // With the noise scaled by `now`, squared residuals have weight 1/now².
        let Some(newton) = GaussNewton::at(&search.w, &search.at, now.powi(-2)) else {
            break Termination::NoProgress { gradient_norm: f64::INFINITY };
        };
        let gradient_norm = newton.decrement;
        if now > last {
            // A stage only needs to end where the next one can start: it stops short of its own minimum, but
            // not without a step.
            if steps > 0 && (gradient_norm < END_OF_STAGE || steps == STEPS_A_STAGE) {
                (now, steps) = ((now / STAGE).max(last), 0);
                continue;
            }
        } else if gradient_norm <= tolerance {
            break Termination::Converged { gradient_norm };
        }
        if search.trace.len() >= limits.iterations {
            break Termination::IterationLimit;
        }
        // the start may be the mode of another model, where this one is far from linear
        let is_started = !search.trace.is_empty();
        if is_started && search.ln_evidence_most(&newton) < limits.ln_evidence {
            break Termination::NoProgress { gradient_norm };
        }
        steps += 1;
        search.note(&newton);
        if !search.step(&newton) {
            if now <= last {
                break Termination::NoProgress { gradient_norm };
            }
            // Less noise changes the cost, so steps may lower it again: end the stage and reset the damping.
            (steps, search.damping) = (STEPS_A_STAGE, 0.0);
        }
    };
    let Search { w, at, trace, .. } = search;
    Solution { w, at, trace, termination }
}

/// Twice the objective.
pub(super) fn cost(weight: f64, w: &DVector<f64>, residuals: &DVector<f64>) -> f64 {
    weight * residuals.norm_squared() + w.norm_squared()
}

fn add_to_diagonal(matrix: &mut DMatrix<f64>, value: f64) {
    for i in 0..matrix.nrows() {
        matrix[(i, i)] += value;
    }
}

struct Search<'a, M: Model> {
    model: &'a M,
    w: DVector<f64>,
    at: Linearised<M::Second>,
    damping: f64,
    /// A damped step with a smaller predicted decrease is not tried.
    least_promise: f64,
    trace: Vec<Iteration>,
}

/// A Gauss-Newton step, with data weighted by `weight`, and its ingredients.
pub(super) struct GaussNewton {
    weight: f64,
    factor: Cholesky<f64, Dyn>,
    descent: DVector<f64>,
    direction: DVector<f64>,
    /// Norm of the gradient in the metric of the Hessian, the square of which the cost can fall by.
    pub(super) decrement: f64,
}

impl GaussNewton {
    /// From a point; `None` if the model is not finite.
    pub(super) fn at<S>(w: &DVector<f64>, at: &Linearised<S>, weight: f64) -> Option<Self> {
        let descent = weight * dot_products(&at.jacobian, &at.residuals) - w;
        let factor = cholesky(at.gauss_newton(weight))?;
        let direction = factor.solve(&descent);
        let decrement = descent.dot(&direction).max(0.0).sqrt();
        Some(Self { weight, factor, descent, direction, decrement })
    }
}

impl<M: Model> Search<'_, M> {
    fn cost(&self, newton: &GaussNewton) -> f64 {
        cost(newton.weight, &self.w, &self.at.residuals)
    }

    /// The most log evidence that the mode is likely to have with data weighted as in `newton`: the volume of
    /// errors hardly depends on the point.
    fn ln_evidence_most(&self, newton: &GaussNewton) -> f64 {
        let decrease = (1.0 + BEYOND_FORESEEN) * newton.decrement.powi(2);
        -0.5 * (self.cost(newton) - decrease + newton.factor.ln_determinant()) + LN_BEYOND_FORESEEN
    }

    fn note(&mut self, newton: &GaussNewton) {
        self.trace.push(Iteration {
            cost: self.cost(newton),
            gradient_norm: newton.decrement,
            damping: self.damping,
            tempering: newton.weight.sqrt().recip(),
        });
    }

    /// One step, damped until it lowers the cost; returns false if none does.
    fn step(&mut self, newton: &GaussNewton) -> bool {
        // The residuals predicted by the linear model rather than the current ones, which far from the
        // minimum are large and would add a curvature for what the step is about to remove.
        let multipliers = &self.at.residuals - &self.at.jacobian * &newton.direction;
        let curvature =
            self.model.curvature(&self.at.second, &multipliers).map(|of_data| newton.weight * of_data);
        for _ in 0..TRIALS {
            let direction = self.direction(newton, curvature.as_ref());
            if direction.as_ref().is_some_and(|step| newton.descent.dot(step) < self.least_promise) {
                return false;
            }
            if let Some(Trial { w, at, kept }) = direction.and_then(|step| self.trial(newton, step)) {
                self.at = self.model.derivatives(&w, at);
                self.w = w;
                // Damping replaces a curvature that is left out: it rises where that matters.
                if curvature.is_some() || kept > KEPT_WELL {
                    self.damping *= DAMPING_DOWN;
                } else if kept < KEPT_BADLY {
                    self.raise_damping();
                }
                if self.damping < DAMPING_LEAST {
                    self.damping = 0.0;
                }
                return true;
            }
            self.raise_damping();
        }
        false
    }

    fn raise_damping(&mut self) {
        self.damping = (DAMPING_UP * self.damping).max(DAMPING);
    }

    /// The damped step; `None` if the Hessian is not positive definite or the step is too long.
    fn direction(&self, newton: &GaussNewton, curvature: Option<&DMatrix<f64>>) -> Option<DVector<f64>> {
        let direction = if curvature.is_none() && self.damping <= 0.0 {
            newton.direction.clone()
        } else {
            let mut hessian = self.at.gauss_newton(newton.weight);
            curvature.into_iter().for_each(|curvature| hessian -= curvature);
            add_to_diagonal(&mut hessian, self.damping);
            cholesky(hessian)?.solve(&newton.descent)
        };
        (direction.norm() <= LONGEST).then_some(direction)
    }

    /// The result of a step, corrected for curvature if it achieves less than half of the predicted decrease;
    /// `None` if the cost is higher.
    fn trial(&self, newton: &GaussNewton, direction: DVector<f64>) -> Option<Trial<M::Ingredients>> {
        let cost = |w: &DVector<f64>, residuals: &DVector<f64>| cost(newton.weight, w, residuals);
        let before = cost(&self.w, &self.at.residuals);
        let mut w = &self.w + &direction;
        let mut at = self.model.evaluate(&w);
        let mut after = cost(&w, &at.residuals);
        let promise = newton.descent.dot(&direction);
        if after < before - 0.5 * promise {
            return Some(Trial { w, at, kept: (before - after) / promise });
        }
        // The curvature of precise data has thrown the step off their valley: corrections with the old
        // factor, for the deviation from the linear prediction, lead back to it.
        let foreseen = &self.at.residuals - &self.at.jacobian * direction;
        let enough = before - KEPT * (before - cost(&w, &foreseen));
        for _ in 0..CORRECTIONS {
            let unforeseen = &at.residuals - &foreseen;
            let off = newton.weight * dot_products(&self.at.jacobian, &unforeseen);
            let corrected = &w + newton.factor.solve(&off);
            let at_corrected = self.model.evaluate(&corrected);
            let after_correction = cost(&corrected, &at_corrected.residuals);
            if after_correction.partial_cmp(&after) != Some(Ordering::Less) {
                break;
            }
            (w, at, after) = (corrected, at_corrected, after_correction);
            if after < enough {
                break;
            }
        }
        (after < before).then_some(Trial { w, at, kept: (before - after) / promise })
    }
}

/// The result of a step that lowers the cost.
struct Trial<I> {
    w: DVector<f64>,
    at: Evaluated<I>,
    /// Share achieved of the predicted decrease.
    kept: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One unknown w observed as `scale·exp(w)`, in units of the noise.
    struct Exponential {
        data: f64,
        scale: f64,
    }

    impl Model for Exponential {
        type Second = f64;
        type Ingredients = ();

        fn unknowns(&self) -> usize {
            1
        }

        fn evaluate(&self, w: &DVector<f64>) -> Evaluated<()> {
            let residuals = DVector::from_element(1, self.data - self.scale * w[0].exp());
            Evaluated { residuals, ingredients: () }
        }

        fn derivatives(&self, w: &DVector<f64>, at: Evaluated<()>) -> Linearised<f64> {
            let second = self.scale * w[0].exp();
            Linearised::new(at.residuals, DMatrix::from_element(1, 1, second), second)
        }

        fn curvature(&self, at: &f64, multipliers: &DVector<f64>) -> Option<DMatrix<f64>> {
            Some(DMatrix::from_element(1, 1, multipliers[0] * at))
        }
    }

    /// Precise data leave a curved valley, `a·w₀² + w₁ = data`, down which the prior leads.
    struct Valley;

    const BEND: f64 = 3.0;
    const PRECISION: f64 = 1e6;

    impl Model for Valley {
        type Second = ();
        type Ingredients = ();

        fn unknowns(&self) -> usize {
            2
        }

        fn evaluate(&self, w: &DVector<f64>) -> Evaluated<()> {
            let residuals = DVector::from_element(1, -PRECISION * (w[1] - BEND * w[0] * w[0]));
            Evaluated { residuals, ingredients: () }
        }

        fn derivatives(&self, w: &DVector<f64>, at: Evaluated<()>) -> Linearised<()> {
            let jacobian = PRECISION * DMatrix::from_row_slice(1, 2, &[-2.0 * BEND * w[0], 1.0]);
            Linearised::new(at.residuals, jacobian, ())
        }

        fn curvature(&self, (): &(), multipliers: &DVector<f64>) -> Option<DMatrix<f64>> {
            Some(DMatrix::from_diagonal(&DVector::from_vec(vec![
                -2.0 * BEND * PRECISION * multipliers[0],
                0.0,
            ])))
        }
    }

    #[test]
    fn a_curved_valley_is_followed_in_long_steps() {
        let start = DVector::from_vec(vec![2.0, BEND * 4.0]);
        let found = find_mode(&Valley, start, (1.0, 1.0), 1e-6, 1000);
        assert!(matches!(found.termination, Termination::Converged { .. }), "{:?}", found.termination);
        assert!(found.w.norm() < 1e-5, "{}", found.w);
        let steps = found.trace.len();
        // With one correction per step, more than 1000.
        assert!(steps < 400, "{steps} steps");
    }

    /// A model whose misfit is least, though still large, at its kink, where the first unknown is 1.
    struct Kink;

    impl Model for Kink {
        type Second = ();
        type Ingredients = ();

        fn unknowns(&self) -> usize {
            2
        }

        fn evaluate(&self, w: &DVector<f64>) -> Evaluated<()> {
            let residuals = DVector::from_vec(vec![-5.0 - 10.0 * (w[0] - 1.0).abs(), 3.0 * (w[1] - w[0])]);
            Evaluated { residuals, ingredients: () }
        }

        fn derivatives(&self, w: &DVector<f64>, at: Evaluated<()>) -> Linearised<()> {
            let slope = 10.0 * (w[0] - 1.0).signum();
            let jacobian = DMatrix::from_row_slice(2, 2, &[slope, 0.0, 3.0, -3.0]);
            Linearised::new(at.residuals, jacobian, ())
        }

        fn curvature(&self, (): &(), _: &DVector<f64>) -> Option<DMatrix<f64>> {
            None
        }
    }

    #[test]
    fn a_search_ends_at_a_kink() {
        let found = find_mode(&Kink, DVector::from_vec(vec![1.3, 0.0]), (1.0, 1.0), 0.03, 1000);
        assert!(matches!(found.termination, Termination::NoProgress { .. }), "{:?}", found.termination);
        assert!((found.w[0] - 1.0).abs() < 1e-5, "{}", found.w);
        let steps = found.trace.len();
        // If steps without a predicted decrease were tried, 33.
        assert!(steps < 20, "{steps} steps");
    }

    #[test]
    fn the_gradient_vanishes_where_it_says_so() {
        for (data, scale) in [(3.0, 1.0), (0.1, 1.0), (-2.0, 0.5), (5e6, 1e6)] {
            let model = Exponential { data, scale };
            let start = DVector::zeros(1);
            let first = first_tempering(&model, &start, 1.0);
            let found = find_mode(&model, start, (first, 1.0), 1e-6, 100);
            let w = found.w[0];
            let slope = w - (data - scale * w.exp()) * scale * w.exp();
            let expected = 1.0 + (scale * w.exp()).powi(2);
            assert!(matches!(found.termination, Termination::Converged { .. }), "{:?}", found.termination);
            assert!(slope.abs() < 2e-6 * expected.sqrt(), "{data} {scale}: {slope}");
            let factor = found.at.information().unwrap().l()[(0, 0)];
            assert!((factor * factor / expected - 1.0).abs() < 1e-12);
        }
    }
}
