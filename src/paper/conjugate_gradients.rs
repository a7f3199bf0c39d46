//! Conjugate gradients, for systems defined by their products alone.

use nalgebra::DVector;

/// More iterations than any well-posed system of these tools needs.
const ITERATION_LIMIT: usize = 10_000;

/// Solves `A·x = b`, with A symmetric and positive definite and `product(v)` returning `A·v`, until the
/// residual norm is at most `tolerance` times that of `b`; none after 10000 iterations.
///
/// # Source
/// Golub and Van Loan, *Matrix Computations*, algorithm 11.3.3.
///
/// # Example
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use vfold::paper::conjugate_gradients;
/// let a = dmatrix![2.0, -1.0; -1.0, 3.0];
/// let x = conjugate_gradients(|v| &a * v, dvector![1.0, 2.0], 1e-14).unwrap();
/// assert!((x - dvector![1.0, 1.0]).norm() < 1e-14);
/// ```
#[must_use]
pub fn conjugate_gradients(
    product: impl Fn(&DVector<f64>) -> DVector<f64>,
    b: DVector<f64>,
    tolerance: f64,
) -> Option<DVector<f64>> {
    let mut x = DVector::zeros(b.len());
    let mut direction = b.clone();
    let mut residual = b;
    let mut square = residual.norm_squared();
    let goal = tolerance * tolerance * square;
    for _ in 0..ITERATION_LIMIT {
        if square <= goal {
            return Some(x);
        }
        let along = product(&direction);
        let step = square / direction.dot(&along);
        x.axpy(step, &direction, 1.0);
        residual.axpy(-step, &along, 1.0);
        let last = std::mem::replace(&mut square, residual.norm_squared());
        direction.axpy(1.0, &residual, square / last);
    }
    None
}
