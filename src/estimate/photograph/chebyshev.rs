//! Functions of albedo, represented by their values at Chebyshev nodes.

use std::sync::LazyLock;

use nalgebra::DMatrix;

use crate::solve::dense::product;

/// Number of albedo nodes, sufficient for all bounces.
pub const NODES: usize = 10;

/// Chebyshev nodes of the first kind on [0, 1].
#[must_use]
pub fn nodes() -> Vec<f64> {
    let angle = |n: usize| std::f64::consts::PI * (n as f64 + 0.5) / NODES as f64;
    (0..NODES).map(|n| 0.5 * (1.0 - angle(n).cos())).collect()
}

/// Weights of the values at the nodes in the value at each of `points`, and in its derivative: node by point.
pub(super) fn weights(points: &[f64]) -> (DMatrix<f64>, DMatrix<f64>) {
    /// Maps values at the nodes to Chebyshev coefficients.
    static COEFFICIENTS: LazyLock<DMatrix<f64>> = LazyLock::new(|| {
        let (at_nodes, _) = polynomials(&nodes());
        at_nodes.try_inverse().unwrap_or_else(|| DMatrix::identity(NODES, NODES))
    });
    let (values, slopes) = polynomials(points);
    (product(&COEFFICIENTS, &values), product(&COEFFICIENTS, &slopes))
}

/// Chebyshev polynomials on [0, 1] at `points`, and their derivatives: polynomial by point.
fn polynomials(points: &[f64]) -> (DMatrix<f64>, DMatrix<f64>) {
    let (mut values, mut slopes) = (DMatrix::zeros(NODES, points.len()), DMatrix::zeros(NODES, points.len()));
    let [of_values, of_slopes] =
        [&mut values, &mut slopes].map(|all| all.as_mut_slice().as_chunks_mut::<NODES>().0);
    for ((values, slopes), point) in of_values.iter_mut().zip(of_slopes).zip(points) {
        let x = 2.0 * point - 1.0;
        [values[0], values[1], slopes[1]] = [1.0, x, 2.0];
        for n in 2..NODES {
            values[n] = 2.0 * x * values[n - 1] - values[n - 2];
            slopes[n] = 4.0 * values[n - 1] + 2.0 * x * slopes[n - 1] - slopes[n - 2];
        }
    }
    (values, slopes)
}
