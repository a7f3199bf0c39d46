//! Bounded minimisation by a primal-dual interior point method, as an argmin solver.
//!
//! Newton's method on the optimality conditions of the logarithmic barrier, whose weight decreases with the
//! gap between the variables and their multipliers; steps stop short of the bounds.
//!
//! ## Reference
//! J. Nocedal, S. J. Wright, *Numerical Optimization*, 2nd ed. (2006), sections 19.2 and 19.3.

use argmin::core::{
    CostFunction, Error, Gradient, Hessian, IterState, KV, Problem, Solver, TerminationReason,
    TerminationStatus,
};
use nalgebra::{Cholesky, DMatrix, DVector};

use super::bounds::Bounds;

/// Largest fraction of the distance to the bounds that a step may take.
const TO_BOUNDARY: f64 = 0.995;
/// Target of the barrier relative to the mean gap.
const CENTERING: f64 = 0.1;
/// Least decrease of a step, relative to that predicted by the slope.
const SUFFICIENT: f64 = 1e-4;

/// State of an argmin run of this solver.
pub type State = IterState<DVector<f64>, DVector<f64>, (), DMatrix<f64>, (), f64>;

/// Primal-dual interior point solver for `min f(x)`, `low ≤ x ≤ high`, with one interval for all variables or
/// for linear combinations of them.
///
/// # Example
/// ```
/// use argmin::core::{CostFunction, Error, Executor, Gradient, Hessian, State};
/// use nalgebra::{DMatrix, DVector};
/// use vfold::paper::interior_point::InteriorPoint;
///
/// /// (x − 2)² on [0, 1]: the minimum lies on the upper bound.
/// struct Parabola;
/// impl CostFunction for Parabola {
///     type Param = DVector<f64>;
///     type Output = f64;
///     fn cost(&self, x: &DVector<f64>) -> Result<f64, Error> { Ok((x[0] - 2.0).powi(2)) }
/// }
/// impl Gradient for Parabola {
///     type Param = DVector<f64>;
///     type Gradient = DVector<f64>;
///     fn gradient(&self, x: &DVector<f64>) -> Result<DVector<f64>, Error> {
///         Ok(DVector::from_element(1, 2.0 * (x[0] - 2.0)))
///     }
/// }
/// impl Hessian for Parabola {
///     type Param = DVector<f64>;
///     type Hessian = DMatrix<f64>;
///     fn hessian(&self, _: &DVector<f64>) -> Result<DMatrix<f64>, Error> {
///         Ok(DMatrix::from_element(1, 1, 2.0))
///     }
/// }
/// let solver = InteriorPoint::new(0.0, 1.0, 1e-10);
/// let result = Executor::new(Parabola, solver)
///     .configure(|state| state.param(DVector::from_element(1, 0.5)).max_iters(50))
///     .run()?;
/// assert!((result.state().get_best_param().unwrap()[0] - 1.0).abs() < 1e-9);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct InteriorPoint {
    bounds: Bounds,
    tolerance: f64,
    /// Multipliers of the lower and upper bounds, positive.
    multipliers: [DVector<f64>; 2],
    violation: f64,
    stalled: bool,
}

impl InteriorPoint {
    /// A solver between `low` and `high` that stops when no optimality condition is violated by more than
    /// `tolerance`.
    #[must_use]
    pub fn new(low: f64, high: f64, tolerance: f64) -> Self {
        let none = DVector::zeros(0);
        Self {
            bounds: Bounds::on_variables(low, high),
            tolerance,
            multipliers: [none.clone(), none],
            violation: f64::INFINITY,
            stalled: false,
        }
    }

    /// The same solver with bounds on the entries of `combinations · x`; the start must be within them.
    #[must_use]
    pub fn on_combinations(mut self, combinations: DMatrix<f64>) -> Self {
        self.bounds = self.bounds.on_combinations(combinations);
        self
    }

    /// Largest violation of the optimality conditions at the last iterate.
    #[must_use]
    pub fn violation(&self) -> f64 {
        self.violation
    }

    /// The barrier function: `f(x) − μ Σ ln gaps`.
    fn barrier(&self, x: &DVector<f64>, cost: f64, mu: f64) -> f64 {
        cost - mu * self.bounds.gaps(x).iter().map(|gap| gap.iter().map(|g| g.ln()).sum::<f64>()).sum::<f64>()
    }

    /// Weight of the barrier: a tenth of the mean complementarity gap.
    fn barrier_weight(&self, gaps: &[DVector<f64>; 2]) -> f64 {
        let gap: f64 = gaps.iter().zip(&self.multipliers).map(|(gap, multiplier)| gap.dot(multiplier)).sum();
        CENTERING * gap / (2 * gaps[0].len()) as f64
    }

    /// Largest of the stationarity and complementarity violations.
    fn violation_at(&self, gradient: &DVector<f64>, gaps: &[DVector<f64>; 2]) -> f64 {
        let [z_low, z_high] = &self.multipliers;
        let stationarity = (gradient + self.bounds.by_variable(z_high - z_low)).amax();
        let complementarity = gaps.iter().zip(&self.multipliers).map(|(gap, z)| gap.component_mul(z).amax());
        complementarity.fold(stationarity, f64::max)
    }

    /// The Newton step of x, and the corresponding steps of the bounded quantities and the multipliers.
    fn step(
        &self,
        gradient: &DVector<f64>,
        mut hessian: DMatrix<f64>,
        gaps: &[DVector<f64>; 2],
        mu: f64,
    ) -> [DVector<f64>; 4] {
        let [low, high] = gaps;
        let [z_low, z_high] = &self.multipliers;
        let right = self.bounds.by_variable(low.map(|g| mu / g) - high.map(|g| mu / g)) - gradient;
        self.bounds.add_curvature(&mut hessian, &(z_low.component_div(low) + z_high.component_div(high)));
        let dx = positive_solve(hessian, &right);
        let moved = self.bounds.of(&dx);
        let dz_low = low.map(|g| mu / g) - z_low - z_low.component_mul(&moved).component_div(low);
        let dz_high = high.map(|g| mu / g) - z_high + z_high.component_mul(&moved).component_div(high);
        [dx, moved, dz_low, dz_high]
    }
}

/// Solves a symmetric system, made positive definite by an increasing diagonal if necessary.
fn positive_solve(matrix: DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    let scale = matrix.diagonal().amax().max(f64::MIN_POSITIVE);
    let mut shift = 0.0;
    loop {
        let shifted = &matrix + DMatrix::from_diagonal_element(right.len(), right.len(), shift);
        if let Some(factor) = Cholesky::new(shifted) {
            return factor.solve(right);
        }
        shift = (10.0 * shift).max(1e-12 * scale);
    }
}

/// Largest step along `direction` that keeps `value` positive, with a margin.
fn to_boundary(value: &DVector<f64>, direction: &DVector<f64>) -> f64 {
    let steps =
        value.iter().zip(direction.iter()).filter(|(_, d)| **d < 0.0).map(|(v, d)| -TO_BOUNDARY * v / d);
    steps.fold(1.0, f64::min)
}

impl<O> Solver<O, State> for InteriorPoint
where
    O: CostFunction<Param = DVector<f64>, Output = f64>
        + Gradient<Param = DVector<f64>, Gradient = DVector<f64>>
        + Hessian<Param = DVector<f64>, Hessian = DMatrix<f64>>,
{
    fn name(&self) -> &'static str {
        "primal-dual interior point"
    }

    fn init(&mut self, problem: &mut Problem<O>, mut state: State) -> Result<(State, Option<KV>), Error> {
        let x = state.take_param().ok_or_else(|| Error::msg("interior point: no start given"))?;
        let x = self.bounds.within(x);
        if self.bounds.gaps(&x).iter().any(|gap| gap.min() <= 0.0) {
            return Err(Error::msg("interior point: the start is not within the bounds"));
        }
        let gradient = problem.problem("gradient_count", |p| p.gradient(&x))?;
        let cost = problem.problem("cost_count", |p| p.cost(&x))?;
        // multipliers of a central path that starts where gradient and barrier are of equal size
        let mu = gradient.amax().max(self.tolerance) * 0.1 * self.bounds.width();
        self.multipliers = self.bounds.gaps(&x).map(|gap| gap.map(|g| mu / g));
        Ok((state.param(x).gradient(gradient).cost(cost), None))
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<O>,
        mut state: State,
    ) -> Result<(State, Option<KV>), Error> {
        let (Some(x), Some(gradient)) = (state.take_param(), state.take_gradient()) else {
            return Err(Error::msg("interior point: the state lost its iterate"));
        };
        let cost = state.get_cost();
        let gaps = self.bounds.gaps(&x);
        let mu = self.barrier_weight(&gaps);
        let hessian = problem.problem("hessian_count", |p| p.hessian(&x))?;
        let [dx, moved, dz_low, dz_high] = self.step(&gradient, hessian, &gaps, mu);
        let mut length = to_boundary(&gaps[0], &moved).min(to_boundary(&gaps[1], &-&moved));
        let slope = gradient.dot(&dx) + (gaps[1].map(|g| mu / g) - gaps[0].map(|g| mu / g)).dot(&moved);
        let before = self.barrier(&x, cost, mu);
        let (next, next_cost) = loop {
            let next = &x + length * &dx;
            let next_cost = problem.problem("cost_count", |p| p.cost(&next))?;
            if self.barrier(&next, next_cost, mu) <= before + SUFFICIENT * length * slope {
                break (next, next_cost);
            }
            length *= 0.5;
            if length < 1e-12 {
                self.stalled = true;
                break (x.clone(), cost);
            }
        };
        for (z, dz) in self.multipliers.iter_mut().zip([dz_low, dz_high]) {
            let length = to_boundary(z, &dz);
            *z += length * dz;
        }
        let gradient = problem.problem("gradient_count", |p| p.gradient(&next))?;
        self.violation = self.violation_at(&gradient, &self.bounds.gaps(&next));
        Ok((state.param(next).gradient(gradient).cost(next_cost), None))
    }

    fn terminate(&mut self, _: &State) -> TerminationStatus {
        if self.violation <= self.tolerance {
            TerminationStatus::Terminated(TerminationReason::SolverConverged)
        } else if self.stalled {
            TerminationStatus::Terminated(TerminationReason::SolverExit("no progress".to_owned()))
        } else {
            TerminationStatus::NotTerminated
        }
    }
}

#[cfg(test)]
mod tests {
    use argmin::core::{Executor, State as _};

    use super::*;

    /// Rosenbrock's valley, whose unconstrained minimum is (1, 1).
    struct Rosenbrock;

    impl CostFunction for Rosenbrock {
        type Param = DVector<f64>;
        type Output = f64;

        fn cost(&self, x: &DVector<f64>) -> Result<f64, Error> {
            Ok((1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2))
        }
    }

    impl Gradient for Rosenbrock {
        type Param = DVector<f64>;
        type Gradient = DVector<f64>;

        fn gradient(&self, x: &DVector<f64>) -> Result<DVector<f64>, Error> {
            let off = x[1] - x[0] * x[0];
            Ok(DVector::from_vec(vec![-2.0 * (1.0 - x[0]) - 400.0 * x[0] * off, 200.0 * off]))
        }
    }

    impl Hessian for Rosenbrock {
        type Param = DVector<f64>;
        type Hessian = DMatrix<f64>;

        fn hessian(&self, x: &DVector<f64>) -> Result<DMatrix<f64>, Error> {
            let corner = 2.0 - 400.0 * (x[1] - 3.0 * x[0] * x[0]);
            Ok(DMatrix::from_row_slice(2, 2, &[corner, -400.0 * x[0], -400.0 * x[0], 200.0]))
        }
    }

    fn minimum(low: f64, high: f64, start: f64) -> Vec<f64> {
        let run = Executor::new(Rosenbrock, InteriorPoint::new(low, high, 1e-10))
            .configure(|state| state.param(DVector::from_element(2, start)).max_iters(200))
            .run()
            .unwrap();
        run.state().get_best_param().unwrap().as_slice().to_vec()
    }

    /// With bounds on x + y and x − y, the minimum is on the edge x + y = 1 of a rotated square: `x = 1 − y`,
    /// at the minimum of `scipy.optimize.minimize_scalar(lambda x: (1 - x)**2 + 100*(1 - x - x*x)**2)`.
    #[test]
    fn bounds_on_combinations() {
        let turned = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 1.0, -1.0]);
        let run = Executor::new(Rosenbrock, InteriorPoint::new(-1.0, 1.0, 1e-10).on_combinations(turned))
            .configure(|state| state.param(DVector::zeros(2)).max_iters(200))
            .run()
            .unwrap();
        let found = run.state().get_best_param().unwrap();
        assert!(
            (found[0] - 0.6187956188992921).abs() < 1e-7 && (found[0] + found[1] - 1.0).abs() < 1e-7,
            "{found}"
        );
    }

    #[test]
    fn a_start_outside_is_refused() {
        let solver = InteriorPoint::new(0.0, 1.0, 1e-10).on_combinations(DMatrix::identity(2, 2));
        let run = Executor::new(Rosenbrock, solver)
            .configure(|state| state.param(DVector::from_element(2, 1.5)).max_iters(9))
            .run();
        assert!(run.is_err());
    }

    #[test]
    fn a_minimum_on_a_bound_and_one_inside() {
        // for x ≤ 0.8 the valley ends at (0.8, 0.64), cost (1 − 0.8)²
        for (low, high, start, [x, y]) in
            [(0.0, 0.8, 0.1, [0.8, 0.64]), (-2.0, 2.0, -1.5, [1.0, 1.0]), (1.2, 2.0, 1.9, [1.2, 1.44])]
        {
            let found = minimum(low, high, start);
            assert!((found[0] - x).abs() < 1e-7 && (found[1] - y).abs() < 1e-7, "{low}..{high}: {found:?}");
        }
    }
}
