//! Functions of albedo, represented by their values at Chebyshev nodes.

use nalgebra::DMatrix;

/// Number of albedo nodes, sufficient for all bounces.
pub const NODES: usize = 10;

/// Chebyshev nodes of the first kind on [0, 1].
#[must_use]
pub fn nodes(count: usize) -> Vec<f64> {
    let angle = |n: usize| std::f64::consts::PI * (n as f64 + 0.5) / count as f64;
    (0..count).map(|n| 0.5 * (1.0 - angle(n).cos())).collect()
}

/// Chebyshev polynomials on [0, 1] at `points`, and their derivatives: polynomial by point.
pub(super) fn chebyshev(points: &[f64], count: usize) -> (DMatrix<f64>, DMatrix<f64>) {
    let (mut values, mut slopes) = (DMatrix::zeros(count, points.len()), DMatrix::zeros(count, points.len()));
    for (column, point) in points.iter().enumerate() {
        let x = 2.0 * point - 1.0;
        for n in 0..count {
            let (value, slope) = match n {
                0 => (1.0, 0.0),
                1 => (x, 2.0),
                _ => (
                    2.0 * x * values[(n - 1, column)] - values[(n - 2, column)],
                    4.0 * values[(n - 1, column)] + 2.0 * x * slopes[(n - 1, column)]
                        - slopes[(n - 2, column)],
                ),
            };
            values[(n, column)] = value;
            slopes[(n, column)] = slope;
        }
    }
    (values, slopes)
}
