//! Dot products.

/// Independent sums, so that an addition need not wait for the one before.
const SUMS: usize = 8;

/// Dot product of two vectors of one length.
///
/// # Example
/// ```
/// use vfold::solve::dot;
/// let ones = [1.0; 10];
/// assert!((dot(&ones, &ones) - 10.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<SUMS>(), b.as_chunks::<SUMS>());
    let mut sums = [0.0; SUMS];
    for (a, b) in a.iter().zip(b) {
        for k in 0..SUMS {
            sums[k] += a[k] * b[k];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}
