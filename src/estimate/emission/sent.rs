//! What a band sends out, with derivatives.

use nalgebra::{DMatrix, DVector};

/// Number of unknowns of a band, and the indices of two of them: the fall, and the reflectance at the
/// exciting wavelengths.
pub const UNKNOWNS: usize = 5;
pub(super) const FALL: usize = 3;
pub const EXCITING_PLACE: usize = 4;

/// Skewness of bands: the half at longer wavelengths is 1.4 times as wide as the other.
const SKEW: f64 = 0.3;

/// Logarithm of the shape of a band, which is 1 at its peak, with first and second derivative; `u` is the
/// wavenumber from the peak in units of the width. `None` beyond the end of the band.
///
/// # Source
/// The log-normal function: D. B. Siano, D. E. Metzler, *Journal of Chemical Physics* 51 (1969), p. 1856, for
/// bands of emission E. A. Burstein, V. I. Emelyanenko, *Photochemistry and Photobiology* 64 (1996), p. 316.
pub(super) fn ln_log_normal(u: f64) -> Option<[f64; 3]> {
    let rest = 1.0 - SKEW * u;
    if rest <= 0.0 {
        return None;
    }
    let v = -rest.ln() / SKEW;
    let slope = rest.recip();
    Some([-0.5 * v * v, -v * slope, -slope * slope * (1.0 + SKEW * v)])
}

/// Emission, with derivatives by the unknowns.
pub struct Sent {
    /// Fraction of white per waveband, at reflectance 1 if the emission depends on it.
    pub fraction: DVector<f64>,
    /// Waveband by unknown.
    pub slopes: DMatrix<f64>,
    /// Second derivatives of the logarithm in every waveband, for [`Sent::curvature`].
    pub(super) ln_curvatures: Vec<[[f64; UNKNOWNS]; UNKNOWNS]>,
}

impl Sent {
    /// Second derivatives of `Σ weight·fraction`, one weight per waveband: unknown by unknown.
    #[must_use]
    pub fn curvature(&self, weights: &DVector<f64>) -> DMatrix<f64> {
        let count = self.slopes.ncols();
        DMatrix::from_fn(count, count, |j, k| {
            let of_band = |n: usize| {
                let product =
                    self.slopes[(n, j)] * self.slopes[(n, k)] / self.fraction[n].max(f64::MIN_POSITIVE);
                weights[n] * (product + self.fraction[n] * self.ln_curvatures[n][j][k])
            };
            (0..self.fraction.len()).map(of_band).sum()
        })
    }
}
