//! What is known of reflectances before a picture is taken.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::error::{Error, Result};

/// Reflectances are taken to lie this far inside (0, 1): the logit of a measured 0 or 1 would be infinite.
const MARGIN: f64 = 2e-3;
/// Directions of less than this share of the largest variance are left out: spectra do not move along them, and two thirds of the
/// directions of a smooth prior are such.
const VARIANCE_CUTOFF: f64 = 1e-5;
/// Correlation length and standard deviation, in logit, of what spectra do that the training set does not.
const MATERN_LENGTH_NM: f64 = 40.0;
const MATERN_SD: f64 = 0.3;

/// A Gaussian prior of the logit of reflectance, `z = ln(r/(1 − r))`.
///
/// In logit every value is a legal reflectance, and the covariance of a set of paints or dyes spreads evenly.
#[derive(Clone, Debug)]
pub struct Prior {
    mean: DVector<f64>,
    /// Waveband by direction; its product with its transpose is the covariance.
    basis: DMatrix<f64>,
}

impl Prior {
    /// Mean and covariance of a set of spectra on `wavelengths_nm`, and a short-range Matérn 5/2 term (40 nm, 0.3 in logit)
    /// for what the set does not contain.
    ///
    /// # Source
    /// Rasmussen and Williams, *Gaussian Processes for Machine Learning* (2006), eq. (4.17).
    ///
    /// # Errors
    /// [`Error::Numeric`] with fewer than two spectra, or one that is not as long as the grid.
    pub fn from_spectra(wavelengths_nm: &[f64], spectra: &[Vec<f64>]) -> Result<Self> {
        let bands = wavelengths_nm.len();
        if spectra.len() < 2 || spectra.iter().any(|spectrum| spectrum.len() != bands) {
            return Err(Error::Numeric(format!(
                "a prior needs two spectra or more of {bands} wavebands each"
            )));
        }
        let count = spectra.len() as f64;
        let mut logits = DMatrix::from_fn(bands, spectra.len(), |band, n| logit(spectra[n][band]));
        let mean = logits.column_mean();
        logits.column_iter_mut().for_each(|mut column| column -= &mean);
        let mut covariance = &logits * logits.transpose() / (count - 1.0);
        for (i, a) in wavelengths_nm.iter().enumerate() {
            for (j, b) in wavelengths_nm.iter().enumerate() {
                covariance[(i, j)] += matern_5_2(a - b);
            }
        }
        let eigen = SymmetricEigen::new(covariance);
        let negligible = VARIANCE_CUTOFF * eigen.eigenvalues.max();
        let directions = eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter());
        let columns: Vec<_> = directions
            .filter(|(variance, _)| **variance > negligible)
            .map(|(variance, direction)| direction * variance.sqrt())
            .collect();
        Ok(Self { mean, basis: DMatrix::from_columns(&columns) })
    }

    /// Logit of reflectance at whitened coordinates `w`, each standard normal under the prior.
    #[must_use]
    pub fn logit_at(&self, w: &DVector<f64>) -> DVector<f64> {
        &self.mean + &self.basis * w
    }

    /// Derivative of the logits by the whitened coordinates: waveband by coordinate.
    #[must_use]
    pub fn basis(&self) -> &DMatrix<f64> {
        &self.basis
    }
}

/// Logit of a reflectance, kept off the ends of its range.
fn logit(r: f64) -> f64 {
    let r = r.clamp(MARGIN, 1.0 - MARGIN);
    (r / (1.0 - r)).ln()
}

/// Reflectance of a logit.
#[must_use]
pub fn logistic(z: f64) -> f64 {
    1.0 / (1.0 + (-z).exp())
}

fn matern_5_2(distance_nm: f64) -> f64 {
    let x = 5.0_f64.sqrt() * distance_nm.abs() / MATERN_LENGTH_NM;
    MATERN_SD * MATERN_SD * (1.0 + x + x * x / 3.0) * (-x).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matern_as_scikit_learn_has_it() {
        // 0.09 * sklearn.gaussian_process.kernels.Matern(length_scale=40, nu=2.5)([[0.]], [[d]]) for d = 0, 20, 80.
        for (distance_nm, want) in [(0.0, 0.09), (20.0, 0.074_578_423), (80.0, 0.012_479_420)] {
            assert!(
                (matern_5_2(distance_nm) - want).abs() < 1e-8,
                "{distance_nm}: {}",
                matern_5_2(distance_nm)
            );
        }
    }

    #[test]
    fn the_basis_gives_the_covariance_of_the_set() {
        let wavelengths_nm: Vec<f64> = (0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect();
        let spectra: Vec<Vec<f64>> = [0.2, 0.4, 0.9].iter().map(|r| vec![*r; 31]).collect();
        let prior = Prior::from_spectra(&wavelengths_nm, &spectra).unwrap();
        let logits = [0.2, 0.4, 0.9_f64].map(|r| (r / (1.0 - r)).ln());
        let mean = logits.iter().sum::<f64>() / 3.0;
        let variance = logits.iter().map(|z| (z - mean).powi(2)).sum::<f64>() / 2.0;
        let covariance = prior.basis() * prior.basis().transpose();
        let at_mean = prior.logit_at(&DVector::zeros(prior.basis().ncols()));
        for i in 0..31 {
            assert!((at_mean[i] - mean).abs() < 1e-12);
            for j in 0..31 {
                let want = variance + matern_5_2(wavelengths_nm[i] - wavelengths_nm[j]);
                assert!((covariance[(i, j)] - want).abs() < 1e-3, "{i} {j}: {} {want}", covariance[(i, j)]);
            }
        }
    }

    #[test]
    fn one_spectrum_is_no_prior() {
        assert!(Prior::from_spectra(&[400.0, 500.0], &[vec![0.1, 0.2]]).is_err());
    }
}
