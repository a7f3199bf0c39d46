//! Distances between a true and an estimated reflectance spectrum.
//!
//! Paper section 5B: eq. (37) is [`rmse`], eq. (38) is [`pearson_distance`]. CIEDE2000, which needs an observer, is in
//! [`crate::colorimetry`].

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
/// Pearson's correlation subtracts the means first; this does not, so that two flat greys are at distance 0. Scale does
/// not matter: exposure drops out. A spectrum of zeros has no direction: its distance is 0 to another one of zeros,
/// 1 to anything else.
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

/// The scores of one sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Metrics {
    /// Root mean square error, eq. (37).
    pub rmse: f64,
    /// CIEDE2000 colour difference.
    pub ciede2000: f64,
    /// The paper's "Pearson distance", eq. (38).
    pub pd: f64,
}

/// The scores of a batch: 24 bytes a sample, so that the median is exact.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    samples: usize,
    scores: [Vec<f64>; 3],
}

impl Summary {
    /// Counts a sample, and its scores if it has any.
    pub fn add(&mut self, metrics: Option<Metrics>) {
        self.samples += 1;
        if let Some(Metrics { rmse, ciede2000, pd }) = metrics {
            self.scores.iter_mut().zip([rmse, ciede2000, pd]).for_each(|(scores, score)| scores.push(score));
        }
    }

    /// Samples counted.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Samples with scores.
    #[must_use]
    pub fn scored(&self) -> usize {
        self.scores[0].len()
    }

    /// Mean, median and worst of each score; none without a score.
    #[must_use]
    pub fn statistics(&self) -> Option<[Metrics; 3]> {
        let count = self.scored();
        if count == 0 {
            return None;
        }
        let metrics = |[rmse, ciede2000, pd]: [f64; 3]| Metrics { rmse, ciede2000, pd };
        let sorted = self.scores.each_ref().map(|scores| {
            let mut scores = scores.clone();
            scores.sort_by(f64::total_cmp);
            scores
        });
        let mean = sorted.each_ref().map(|scores| scores.iter().sum::<f64>() / count as f64);
        let median = sorted.each_ref().map(|scores| 0.5 * (scores[(count - 1) / 2] + scores[count / 2]));
        let worst = sorted.each_ref().map(|scores| scores[count - 1]);
        Some([mean, median, worst].map(metrics))
    }
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
