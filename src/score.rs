//! Distances between a true and an estimated reflectance spectrum.
//!
//! Paper section 5B: eq. (37) is [`rmse`], eq. (38) is [`pearson_distance`]. CIEDE2000, which needs an
//! observer, is in [`crate::colorimetry`]. [`METRICS`] has a row per metric; [`Summary`] gives mean, median
//! and worst over many samples, [`Worst`] keeps the worst samples.

mod metric;
mod summary;
mod worst;

pub use metric::{METRICS, Measure, Metric, Worse};
pub use summary::{Group, Score, Statistics, Summary};
pub use worst::Worst;

/// Root mean square error over the wavebands, eq. (37); 0..1 for reflectances.
///
/// # Panics
/// If the slices differ in length.
///
/// # Example
/// ```
/// use vfold::score::rmse;
/// assert!((rmse(&[0.5, 0.5], &[0.6, 0.4]) - 0.1).abs() < 1e-15);
/// ```
#[must_use]
pub fn rmse(truth: &[f64], estimate: &[f64]) -> f64 {
    assert_eq!(truth.len(), estimate.len(), "spectra on different grids");
    let squares: f64 = truth.iter().zip(estimate).map(|(r, s)| (r - s).powi(2)).sum();
    (squares / truth.len() as f64).sqrt()
}

/// The paper's "Pearson distance", eq. (38): one minus the cosine between the spectra, 0..1 for reflectances.
///
/// Pearson's correlation subtracts the means first; this does not, so two flat greys have distance 0. Scale
/// does not matter, so exposure drops out. A spectrum of zeros has no direction: its distance is 0 to another
/// one of zeros, 1 to anything else.
///
/// # Panics
/// If the slices differ in length.
///
/// # Example
/// ```
/// use vfold::score::pearson_distance;
/// assert!(pearson_distance(&[0.1, 0.2], &[0.2, 0.4]) < 1e-15);
/// assert_eq!(pearson_distance(&[1.0, 0.0], &[0.0, 1.0]), 1.0);
/// ```
#[must_use]
pub fn pearson_distance(truth: &[f64], estimate: &[f64]) -> f64 {
    assert_eq!(truth.len(), estimate.len(), "spectra on different grids");
    let (truth_norm, estimate_norm) = (norm(truth), norm(estimate));
    let (dark_truth, dark_estimate) = (truth_norm <= 0.0, estimate_norm <= 0.0);
    if dark_truth || dark_estimate {
        return if dark_truth && dark_estimate { 0.0 } else { 1.0 };
    }
    // dividing first keeps tiny spectra from underflowing; rounding must not make the distance negative
    let cosine: f64 = truth.iter().zip(estimate).map(|(r, s)| (r / truth_norm) * (s / estimate_norm)).sum();
    (1.0 - cosine).max(0.0)
}

fn norm(spectrum: &[f64]) -> f64 {
    spectrum.iter().map(|r| r * r).sum::<f64>().sqrt()
}

/// Goodness of fit coefficient: the cosine between the spectra, 1 for the same shape.
///
/// 0.999 is called good, 0.9999 very good. One minus it is [`pearson_distance`], which also defines its value
/// for black.
///
/// # Source
/// J. Romero, A. García-Beltrán, J. Hernández-Andrés, "Linear bases for representation of natural and
/// artificial illuminants", *JOSA A* 14 (1997), p. 1007.
///
/// # Panics
/// If the slices differ in length.
///
/// # Example
/// ```
/// use vfold::score::goodness_of_fit;
/// assert!((goodness_of_fit(&[0.4, 0.6], &[0.6, 0.4]) - 12.0 / 13.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn goodness_of_fit(truth: &[f64], estimate: &[f64]) -> f64 {
    1.0 - pearson_distance(truth, estimate)
}

/// Angle between the spectra as vectors, degrees, 0..90 for reflectances.
///
/// Computed from half angles, which keep the digits that the arc cosine of nearly 1 loses; black is at 0°
/// from black, at 90° from anything else.
///
/// # Source
/// F. A. Kruse et al., "The spectral image processing system (SIPS)", *Remote Sensing of Environment* 44
/// (1993), p. 145.
///
/// # Panics
/// If the slices differ in length.
///
/// # Example
/// ```
/// use vfold::score::spectral_angle_deg;
/// assert!((spectral_angle_deg(&[0.5, 0.0], &[0.2, 0.2]) - 45.0).abs() < 1e-12);
/// ```
#[must_use]
pub fn spectral_angle_deg(truth: &[f64], estimate: &[f64]) -> f64 {
    let (truth_norm, estimate_norm) = (norm(truth), norm(estimate));
    if truth_norm <= 0.0 || estimate_norm <= 0.0 {
        return 90.0 * pearson_distance(truth, estimate);
    }
    let directions = || truth.iter().zip(estimate).map(|(r, s)| (r / truth_norm, s / estimate_norm));
    let difference: f64 = directions().map(|(r, s)| (r - s).powi(2)).sum();
    let sum: f64 = directions().map(|(r, s)| (r + s).powi(2)).sum();
    2.0 * difference.sqrt().atan2(sum.sqrt()).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// NumPy: `np.sqrt(np.mean((a - b) ** 2))`, `1 - a @ b / np.linalg.norm(a) / np.linalg.norm(b)`.
    #[test]
    fn agrees_with_numpy() {
        let (a, b) = ([0.1, 0.4, 0.8, 0.3], [0.2, 0.3, 0.7, 0.6]);
        assert!((rmse(&a, &b) - 0.17320508075688776).abs() < 1e-15);
        assert!((pearson_distance(&a, &b) - 0.06298103800008825).abs() < 1e-15);
    }

    /// The mean is not subtracted: Pearson's correlation of these is -1, its distance would be 2.
    #[test]
    fn distance_is_uncentred() {
        assert!((pearson_distance(&[0.4, 0.6], &[0.6, 0.4]) - 1.0 / 13.0).abs() < 1e-15);
    }

    /// colour-science has no spectral angle; NumPy:
    /// `np.degrees(np.arccos(a @ b / np.linalg.norm(a) / np.linalg.norm(b)))`.
    #[test]
    fn angles_are_numpys() {
        let (a, b) = ([0.1, 0.4, 0.8, 0.3], [0.2, 0.3, 0.7, 0.6]);
        assert!((spectral_angle_deg(&a, &b) - 20.44319080842469).abs() < 1e-12);
        assert!((goodness_of_fit(&a, &b) - 0.9370189619999117).abs() < 1e-15);
        assert!((spectral_angle_deg(&[1.0, 0.0], &[1.0, 1e-9]) / 1e-9_f64.to_degrees() - 1.0).abs() < 1e-12);
        assert!((spectral_angle_deg(&[0.0; 4], &b) - 90.0).abs() < 1e-12);
    }

    #[test]
    fn black_has_no_direction() {
        let (black, grey) = ([0.0; 3], [0.1; 3]);
        assert!(pearson_distance(&black, &black) < 1e-15);
        assert!((pearson_distance(&black, &grey) - 1.0).abs() < 1e-15);
        assert!((pearson_distance(&grey, &black) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn scale_and_rounding_do_not_matter() {
        for scale in [1e-150, 1e-3, 7.0, 1e150] {
            let r = [0.123, 0.456, 0.789].map(|r| r * scale);
            let distance = pearson_distance(&[0.123, 0.456, 0.789], &r);
            assert!((0.0..1e-15).contains(&distance), "{scale}: {distance}");
        }
    }
}
