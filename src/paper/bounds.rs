//! Bounds of an interior point method on its variables, or on linear combinations of them.

use nalgebra::{DMatrix, DVector};

/// One interval for all bounded quantities.
#[derive(Clone, Debug)]
pub struct Bounds {
    low: f64,
    high: f64,
    /// If present, the product of this matrix with the variables x is bounded in place of x.
    combinations: Option<DMatrix<f64>>,
}

impl Bounds {
    /// Bounds on the variables themselves.
    pub fn on_variables(low: f64, high: f64) -> Self {
        Self { low, high, combinations: None }
    }

    /// The same bounds on the entries of `combinations · x`.
    pub fn on_combinations(self, combinations: DMatrix<f64>) -> Self {
        Self { combinations: Some(combinations), ..self }
    }

    /// Width of the interval.
    pub fn width(&self) -> f64 {
        self.high - self.low
    }

    /// The bounded quantities at x, or their change along a step.
    pub fn of(&self, x: &DVector<f64>) -> DVector<f64> {
        self.combinations.as_ref().map_or_else(|| x.clone(), |combinations| combinations * x)
    }

    /// Distances of the bounded quantities to the lower and upper bound.
    pub fn gaps(&self, x: &DVector<f64>) -> [DVector<f64>; 2] {
        let bounded = self.of(x);
        [bounded.map(|value| value - self.low), bounded.map(|value| self.high - value)]
    }

    /// Derivatives with respect to x of a function with `slopes` with respect to the bounded quantities.
    pub fn by_variable(&self, slopes: DVector<f64>) -> DVector<f64> {
        match &self.combinations {
            Some(combinations) => combinations.tr_mul(&slopes),
            None => slopes,
        }
    }

    /// Adds `curvature` with respect to the bounded quantities to a Hessian with respect to x.
    pub fn add_curvature(&self, hessian: &mut DMatrix<f64>, curvature: &DVector<f64>) {
        match &self.combinations {
            Some(combinations) => {
                *hessian += combinations.tr_mul(&(DMatrix::from_diagonal(curvature) * combinations));
            }
            None => (0..curvature.len()).for_each(|i| hessian[(i, i)] += curvature[i]),
        }
    }

    /// A point well within the bounds, if easy to find: one near x, if x itself is bounded.
    pub fn within(&self, x: DVector<f64>) -> DVector<f64> {
        let inside = 1e-3 * self.width();
        match self.combinations {
            Some(_) => x,
            None => x.map(|x| x.clamp(self.low + inside, self.high - inside)),
        }
    }
}
