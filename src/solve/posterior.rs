//! The maximum of a Gaussian prior times a Gaussian likelihood of a nonlinear model, by Newton's method.
//!
//! Minimises `½|ρ(w)|² + ½|w|²`, the unknowns w being standard normal under the prior. Data a million times
//! as large as their noise are constraints, and their residuals far from the minimum say nothing of the
//! curvature along them. So the second derivatives are weighted as in sequential quadratic programming, with
//! multipliers: the residuals that the linearised model leaves, `I + JᵀJ − Σ (ρ − Jδ)ᵢ∇²mᵢ`. A step that the
//! constraints' curvature spoils is corrected to second order. The step is solved for itself, in the space of
//! the unknowns: the system in the space of the data (Tarantola, *Inverse Problem Theory*, 2005, section
//! 3.2.3) gives the next iterate whole, and the step as a small difference of large vectors loses its digits.
//!
//! ## Reference
//! J. Nocedal, S. J. Wright, *Numerical Optimization*, 2nd ed. (2006), sections 10.3, 18.1 and 18.3.

use std::cmp::Ordering;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::Termination;

/// The noise is first taken for this share of the residual at the start.
const FIRST_SHARE: f64 = 0.3;
/// Factor by which the noise falls from stage to stage, the root of ten: a tenth releases so many coordinates
/// at once that the next stage may set out far off the valley that precise data cut.
const STAGE: f64 = 3.162_277_660_168_379_5;
/// Most steps at each tempering of the noise, and the gradient in the metric of the Hessian that ends a stage
/// earlier.
const STEPS_A_STAGE: u32 = 60;
const END_OF_STAGE: f64 = 1.0;
/// Longest step, in standard deviations of the prior: further out the model is not the one that was
/// linearised.
const LONGEST: f64 = 10.0;
/// Most trials of a step; first damping, and its factors after a failure and after a success.
const TRIALS: usize = 14;
const DAMPING: f64 = 0.1;
const DAMPING_UP: f64 = 5.0;
const DAMPING_DOWN: f64 = 0.1;
const DAMPING_LEAST: f64 = 1e-3;
/// Where curvature is left out, the share of what a step promised from which damping falls after it, and the
/// one below which it rises (Nocedal and Wright, section 4.1, of the radius of a trust region).
const KEPT_WELL: f64 = 0.75;
const KEPT_BADLY: f64 = 0.25;
/// The least that a damped step must promise, relative to what the last step may: where the model has a kink,
/// or its derivatives are differences, no step lowers the cost.
const LEAST_PROMISE: f64 = 0.01;
/// Most corrections of a step, and the share of what it promised that is enough. One takes a third more
/// steps; with more than two some searches end in another maximum.
const CORRECTIONS: usize = 2;
const KEPT: f64 = 0.1;
/// A step that lowers the cost by less than this share of what it is too high leads nowhere.
const TOO_LITTLE: f64 = 0.005;
/// Columns of a symmetric product that are computed at once.
const COLUMNS: usize = 32;

/// A model seen through data of known noise.
pub trait Model {
    /// What second derivatives at a point are made of.
    type Second;
    /// Number of unknowns.
    fn unknowns(&self) -> usize;
    /// Data minus model at `w`, in units of the noise.
    fn residuals(&self, w: &DVector<f64>) -> DVector<f64>;
    /// Residuals with derivatives.
    fn linearise(&self, w: &DVector<f64>) -> Linearised<Self::Second>;
    /// `Σ λᵢ∇²mᵢ` at a point, one multiplier λ per residual; none if it is left out.
    fn curvature(&self, at: &Self::Second, multipliers: &DVector<f64>) -> Option<DMatrix<f64>>;
}

/// A model about a point.
pub struct Linearised<S> {
    /// Residuals.
    pub residuals: DVector<f64>,
    /// Derivatives of the model: residual by unknown.
    pub jacobian: DMatrix<f64>,
    /// For [`Model::curvature`].
    pub second: S,
}

/// Where the iteration ended.
pub struct Solution<S> {
    /// The unknowns.
    pub w: DVector<f64>,
    /// The model there.
    pub at: Linearised<S>,
    /// Iterations over all stages, each as it began.
    pub trace: Vec<Iteration>,
    /// Why it stopped.
    pub termination: Termination,
}

/// Where an iteration began.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    /// `|ρ(w)|² + |w|²`, the noise tempered.
    pub cost: f64,
    /// Norm of the gradient in the metric of the Hessian.
    pub gradient_norm: f64,
    /// Damping of the first trial.
    pub damping: f64,
    /// Factor by which the noise is tempered.
    pub tempering: f64,
}

impl<S> Solution<S> {
    /// Logarithm of the probability of the data under prior and model, the noise `tempering` times its size,
    /// but for a term that depends on the data alone.
    ///
    /// # Source
    /// Laplace's approximation: Bishop, *Pattern Recognition and Machine Learning* (2006), section 4.4.
    #[must_use]
    pub fn ln_evidence(&self, tempering: f64) -> Option<f64> {
        let weight = tempering.powi(-2);
        let information = Cholesky::new(gauss_newton(&self.at.jacobian, weight))?;
        Some(-0.5 * (cost(weight, &self.w, &self.at.residuals) + information.ln_determinant()))
    }

    /// Twice what was minimised, the noise `tempering` times its size.
    #[must_use]
    pub fn cost(&self, tempering: f64) -> f64 {
        cost(tempering.powi(-2), &self.w, &self.at.residuals)
    }

    /// How far the data, the noise being `tempering` times its size, are from what the prior predicts, in
    /// standard deviations: of a linear model the cost at the maximum is chi-squared, with as many degrees of
    /// freedom as there are data. At a false maximum it is far out.
    #[must_use]
    pub fn surprise(&self, tempering: f64) -> f64 {
        let data = self.at.residuals.len() as f64;
        (self.cost(tempering) - data) / (2.0 * data).sqrt()
    }
}

/// Where a search ends before its minimum.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// After so many iterations.
    pub iterations: usize,
    /// Where the cost cannot fall below that: none of a smaller noise is below that of a larger one.
    pub cost: f64,
}

impl From<usize> for Limits {
    /// After so many iterations.
    fn from(iterations: usize) -> Self {
        Self { iterations, cost: f64::INFINITY }
    }
}

/// Factor of `I + JᵀJ`, J being the derivatives of the model: the inverse of Laplace's covariance. None if
/// the model was not finite.
#[must_use]
pub fn information(jacobian: &DMatrix<f64>) -> Option<Cholesky<f64, Dyn>> {
    Cholesky::new(gauss_newton(jacobian, 1.0))
}

/// The noise at the start: a third of the residual there, but no less than `least`, all in units of the true
/// noise.
pub fn first_tempering(model: &impl Model, w: &DVector<f64>, least: f64) -> f64 {
    let residuals = model.residuals(w);
    (FIRST_SHARE * residuals.norm() / (residuals.len().max(1) as f64).sqrt()).max(least)
}

/// Minimises from `start`, the noise first tempered to `tempering.0` times its true size and then, by roots
/// of ten, down to `tempering.1`, until a step promises to lower the cost by no more than half of `tolerance`
/// squared: the iterate is then within `tolerance` standard deviations of the minimum.
///
/// Started at the true noise the iteration stalls in the narrow valley that precise data cut.
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
        // Noise `now` times its size weighs squared residuals by 1/now².
        let Some(newton) = search.gauss_newton(now.powi(-2)) else {
            break Termination::NoProgress { gradient_norm: f64::INFINITY };
        };
        let gradient_norm = newton.decrement;
        if now > last {
            // A stage only has to lead to where the next one can start: it is left before its own minimum,
            // but not without a step.
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
        // the linear model says how low the cost may fall, but at the start
        let is_near = now < tempering.0 || gradient_norm < END_OF_STAGE;
        let cost = search.cost(&newton);
        let last_gain = search.trace.last().filter(|_| steps > 0).map(|before| before.cost - cost);
        let is_stuck = last_gain.is_some_and(|gain| gain < TOO_LITTLE * (cost - limits.cost));
        if is_stuck || (is_near && cost - gradient_norm.powi(2) > limits.cost) {
            break Termination::NoProgress { gradient_norm };
        }
        steps += 1;
        search.note(&newton);
        if !search.step(&newton) {
            if now <= last {
                break Termination::NoProgress { gradient_norm };
            }
            // Less noise changes the cost, so that steps may lower it again: end the stage and forget the
            // damping.
            (steps, search.damping) = (STEPS_A_STAGE, 0.0);
        }
    };
    let Search { w, at, trace, .. } = search;
    Solution { w, at, trace, termination }
}

/// Twice what is minimised.
pub(super) fn cost(weight: f64, w: &DVector<f64>, residuals: &DVector<f64>) -> f64 {
    weight * residuals.norm_squared() + w.norm_squared()
}

/// The lower triangle of `I + weight·JᵀJ`: no more of it is made use of.
pub(super) fn gauss_newton(jacobian: &DMatrix<f64>, weight: f64) -> DMatrix<f64> {
    let (count, transposed) = (jacobian.ncols(), jacobian.transpose());
    let mut hessian = DMatrix::identity(count, count);
    for first in (0..count).step_by(COLUMNS) {
        let (rows, columns) = (count - first, COLUMNS.min(count - first));
        let mut below = hessian.view_mut((first, first), (rows, columns));
        below.gemm(weight, &transposed.rows(first, rows), &jacobian.columns(first, columns), 1.0);
    }
    hessian
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
    /// A damped step that promises less is not tried.
    least_promise: f64,
    trace: Vec<Iteration>,
}

/// Gauss and Newton's step, the data weighted by `weight`, and what it was made of.
struct GaussNewton {
    weight: f64,
    hessian: DMatrix<f64>,
    factor: Cholesky<f64, Dyn>,
    descent: DVector<f64>,
    direction: DVector<f64>,
    /// Norm of the gradient in the metric of the Hessian.
    decrement: f64,
}

impl<M: Model> Search<'_, M> {
    /// None if the model is not finite.
    fn gauss_newton(&self, weight: f64) -> Option<GaussNewton> {
        let descent = weight * self.at.jacobian.tr_mul(&self.at.residuals) - &self.w;
        let hessian = gauss_newton(&self.at.jacobian, weight);
        let factor = Cholesky::new(hessian.clone())?;
        let direction = factor.solve(&descent);
        let decrement = descent.dot(&direction).max(0.0).sqrt();
        Some(GaussNewton { weight, hessian, factor, descent, direction, decrement })
    }

    fn cost(&self, newton: &GaussNewton) -> f64 {
        cost(newton.weight, &self.w, &self.at.residuals)
    }

    fn note(&mut self, newton: &GaussNewton) {
        self.trace.push(Iteration {
            cost: self.cost(newton),
            gradient_norm: newton.decrement,
            damping: self.damping,
            tempering: newton.weight.sqrt().recip(),
        });
    }

    /// One step, damped until it lowers the cost; whether any did.
    fn step(&mut self, newton: &GaussNewton) -> bool {
        // What the linear model leaves of the residuals, not the residuals themselves: far from the minimum
        // these are large and would make a curvature of what the step is about to remove.
        let multipliers = &self.at.residuals - &self.at.jacobian * &newton.direction;
        let curvature =
            self.model.curvature(&self.at.second, &multipliers).map(|of_data| newton.weight * of_data);
        for _ in 0..TRIALS {
            let direction = self.direction(newton, curvature.as_ref());
            if direction.as_ref().is_some_and(|step| newton.descent.dot(step) < self.least_promise) {
                return false;
            }
            if let Some((next, kept)) = direction.and_then(|direction| self.trial(newton, direction)) {
                self.at = self.model.linearise(&next);
                self.w = next;
                // Damping stands in for a curvature that is left out: it rises where that shows.
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

    /// The damped step; none if the Hessian is not positive or the step too long.
    fn direction(&self, newton: &GaussNewton, curvature: Option<&DMatrix<f64>>) -> Option<DVector<f64>> {
        let direction = if curvature.is_none() && self.damping <= 0.0 {
            newton.direction.clone()
        } else {
            let mut hessian = newton.hessian.clone();
            curvature.into_iter().for_each(|curvature| hessian -= curvature);
            add_to_diagonal(&mut hessian, self.damping);
            Cholesky::new(hessian)?.solve(&newton.descent)
        };
        (direction.norm() <= LONGEST).then_some(direction)
    }

    /// Where a step leads, corrected for what bends if it does not keep half of its promise, and the share
    /// that it keeps; none if the cost is higher.
    fn trial(&self, newton: &GaussNewton, direction: DVector<f64>) -> Option<(DVector<f64>, f64)> {
        let cost = |w: &DVector<f64>, residuals: &DVector<f64>| cost(newton.weight, w, residuals);
        let before = cost(&self.w, &self.at.residuals);
        let mut next = &self.w + &direction;
        let mut residuals = self.model.residuals(&next);
        let mut after = cost(&next, &residuals);
        let promise = newton.descent.dot(&direction);
        if after < before - 0.5 * promise {
            return Some((next, (before - after) / promise));
        }
        // The curvature of precise data has thrown the step off their valley: solutions with the old factor,
        // for what the linear model did not foresee, lead back to it.
        let foreseen = &self.at.residuals - &self.at.jacobian * direction;
        let enough = before - KEPT * (before - cost(&next, &foreseen));
        for _ in 0..CORRECTIONS {
            let unforeseen = residuals - &foreseen;
            let corrected =
                &next + newton.factor.solve(&(newton.weight * self.at.jacobian.tr_mul(&unforeseen)));
            residuals = self.model.residuals(&corrected);
            let after_correction = cost(&corrected, &residuals);
            if after_correction.partial_cmp(&after) != Some(Ordering::Less) {
                break;
            }
            (next, after) = (corrected, after_correction);
            if after < enough {
                break;
            }
        }
        (after < before).then_some((next, (before - after) / promise))
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
        type Second = f64;

        fn unknowns(&self) -> usize {
            1
        }

        fn residuals(&self, w: &DVector<f64>) -> DVector<f64> {
            DVector::from_element(1, self.data - self.scale * w[0].exp())
        }

        fn linearise(&self, w: &DVector<f64>) -> Linearised<f64> {
            let second = self.scale * w[0].exp();
            Linearised { residuals: self.residuals(w), jacobian: DMatrix::from_element(1, 1, second), second }
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

        fn unknowns(&self) -> usize {
            2
        }

        fn residuals(&self, w: &DVector<f64>) -> DVector<f64> {
            DVector::from_element(1, -PRECISION * (w[1] - BEND * w[0] * w[0]))
        }

        fn linearise(&self, w: &DVector<f64>) -> Linearised<()> {
            let jacobian = PRECISION * DMatrix::from_row_slice(1, 2, &[-2.0 * BEND * w[0], 1.0]);
            Linearised { residuals: self.residuals(w), jacobian, second: () }
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
        // With one correction a step, more than 1000.
        assert!(steps < 400, "{steps} steps");
    }

    /// A model that is least, and still far from the data, at its kink where the first unknown is 1.
    struct Kink;

    impl Model for Kink {
        type Second = ();

        fn unknowns(&self) -> usize {
            2
        }

        fn residuals(&self, w: &DVector<f64>) -> DVector<f64> {
            DVector::from_vec(vec![-5.0 - 10.0 * (w[0] - 1.0).abs(), 3.0 * (w[1] - w[0])])
        }

        fn linearise(&self, w: &DVector<f64>) -> Linearised<()> {
            let slope = 10.0 * (w[0] - 1.0).signum();
            let jacobian = DMatrix::from_row_slice(2, 2, &[slope, 0.0, 3.0, -3.0]);
            Linearised { residuals: self.residuals(w), jacobian, second: () }
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
        // If steps that promise nothing were tried, 33.
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
            let factor = information(&found.at.jacobian).unwrap().l()[(0, 0)];
            assert!((factor * factor / expected - 1.0).abs() < 1e-12);
        }
    }
}
