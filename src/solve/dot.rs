//! Dot products.

use nalgebra::DVectorView;

/// Dot product of two vectors of equal length.
///
/// # Example
/// ```
/// use vfold::solve::dot;
/// let ones = [1.0; 10];
/// assert!((dot(&ones, &ones) - 10.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    DVectorView::from_slice(a, a.len()).dot(&DVectorView::from_slice(b, b.len()))
}
