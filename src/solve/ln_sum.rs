//! Sums of numbers given by their logarithms.

/// Logarithm of the sum of numbers with these logarithms, computed without overflow; −∞ for none.
///
/// # Example
/// ```
/// let ln_all = vfold::solve::ln_sum(&[-1000.0, -1000.0]);
/// assert!((ln_all - (2_f64.ln() - 1000.0)).abs() < 1e-12);
/// assert_eq!(vfold::solve::ln_sum(&[]), f64::NEG_INFINITY);
/// ```
#[must_use]
pub fn ln_sum(logarithms: &[f64]) -> f64 {
    let most = logarithms.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if most == f64::NEG_INFINITY {
        return most;
    }
    most + logarithms.iter().map(|ln| (ln - most).exp()).sum::<f64>().ln()
}
