//! What is known of reflectances before a picture is taken.

use nalgebra::{DMatrix, RowDVector};

use super::classes::{divide, moments, shrunk};
use super::gaussian::{Gaussian, logit};
use crate::error::{Error, Result};

/// Correlation length and standard deviation, in logit, of what spectra do that the training set does not.
const MATERN_LENGTH_NM: f64 = 60.0;
const MATERN_SD: f64 = 0.25;

/// A mixture of Gaussians of the logit of reflectance, one a class of spectra, and the Gaussian of all classes together.
#[derive(Clone, Debug)]
pub struct Prior {
    broad: Gaussian,
    classes: Vec<Class>,
}

/// One class of spectra.
#[derive(Clone, Debug)]
pub struct Class {
    /// Logarithm of its share of all spectra.
    pub ln_share: f64,
    /// Its spectra.
    pub gaussian: Gaussian,
}

impl Prior {
    /// Mean and covariance of each class of a set of spectra on `wavelengths_nm`, with a Matérn 5/2 term (60 nm, 0.25 in
    /// logit) for what the set does not contain. `classes` holds the class of every spectrum; without it they are found
    /// ([`classes_of`]).
    ///
    /// # Source
    /// Rasmussen and Williams, *Gaussian Processes for Machine Learning* (2006), eq. (4.17).
    ///
    /// # Errors
    /// [`Error::Numeric`] with fewer than two spectra, or one that is not as long as the grid, or a class for none.
    pub fn from_spectra(
        wavelengths_nm: &[f64],
        spectra: &[Vec<f64>],
        classes: Option<&[usize]>,
    ) -> Result<Self> {
        let bands = wavelengths_nm.len();
        if spectra.len() < 2 || spectra.iter().any(|spectrum| spectrum.len() != bands) {
            return Err(Error::Numeric(format!(
                "a prior needs two spectra or more of {bands} wavebands each"
            )));
        }
        let (logits, matern) = (logits_of(spectra), matern(wavelengths_nm));
        let classes = classes.map_or_else(|| divide(&logits, &matern), <[usize]>::to_vec);
        if classes.len() != spectra.len() {
            return Err(Error::Numeric(format!("{} classes for {} spectra", classes.len(), spectra.len())));
        }
        let (mean, covariance) = moments(&logits, &RowDVector::from_element(spectra.len(), 1.0));
        let class = |members: Vec<usize>| {
            let count = members.len() as f64;
            let (mean, own) =
                moments(&logits.select_columns(&members), &RowDVector::from_element(members.len(), 1.0));
            let gaussian = Gaussian::new(mean, &(shrunk(&own, count, &covariance) + &matern));
            Class { ln_share: (count / spectra.len() as f64).ln(), gaussian }
        };
        let last = classes.iter().copied().max().unwrap_or(0);
        let members = |k| (0..classes.len()).filter(|n| classes[*n] == k).collect::<Vec<_>>();
        Ok(Self {
            broad: Gaussian::new(mean, &(&covariance + &matern)),
            classes: (0..=last).map(members).filter(|members| !members.is_empty()).map(class).collect(),
        })
    }

    /// All spectra as one Gaussian.
    #[must_use]
    pub fn broad(&self) -> &Gaussian {
        &self.broad
    }

    /// The classes.
    #[must_use]
    pub fn classes(&self) -> &[Class] {
        &self.classes
    }
}

/// Classes into which a set of spectra on `wavelengths_nm` falls, one per spectrum.
#[must_use]
pub fn classes_of(wavelengths_nm: &[f64], spectra: &[Vec<f64>]) -> Vec<usize> {
    divide(&logits_of(spectra), &matern(wavelengths_nm))
}

/// Waveband by spectrum.
fn logits_of(spectra: &[Vec<f64>]) -> DMatrix<f64> {
    let bands = spectra.first().map_or(0, Vec::len);
    DMatrix::from_fn(bands, spectra.len(), |band, n| logit(spectra[n][band]))
}

fn matern(wavelengths_nm: &[f64]) -> DMatrix<f64> {
    let bands = wavelengths_nm.len();
    DMatrix::from_fn(bands, bands, |i, j| matern_5_2(wavelengths_nm[i] - wavelengths_nm[j]))
}

fn matern_5_2(distance_nm: f64) -> f64 {
    let x = 5.0_f64.sqrt() * distance_nm.abs() / MATERN_LENGTH_NM;
    MATERN_SD * MATERN_SD * (1.0 + x + x * x / 3.0) * (-x).exp()
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;

    #[test]
    fn matern_as_scikit_learn_has_it() {
        // 0.0625 * sklearn.gaussian_process.kernels.Matern(length_scale=60, nu=2.5)([[0.]], [[d]]) for d = 0, 30, 120.
        for (distance_nm, want) in [(0.0, 0.0625), (30.0, 0.051_790_572), (120.0, 0.008_666_264)] {
            let got = matern_5_2(distance_nm);
            assert!((got - want).abs() < 1e-8, "{distance_nm}: {got}");
        }
    }

    #[test]
    fn a_small_set_is_one_class_with_its_moments() {
        let wavelengths_nm: Vec<f64> = (0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect();
        let spectra: Vec<Vec<f64>> = [0.2, 0.4, 0.9].iter().map(|r| vec![*r; 31]).collect();
        let prior = Prior::from_spectra(&wavelengths_nm, &spectra, None).unwrap();
        let logits = [0.2, 0.4, 0.9_f64].map(|r| (r / (1.0 - r)).ln());
        let mean = logits.iter().sum::<f64>() / 3.0;
        let variance = logits.iter().map(|z| (z - mean).powi(2)).sum::<f64>() / 3.0;
        let broad = prior.broad();
        let covariance = broad.basis() * broad.basis().transpose();
        let at_mean = broad.logit_at(&DVector::zeros(broad.basis().ncols()));
        assert_eq!(prior.classes().len(), 1);
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
        assert!(Prior::from_spectra(&[400.0, 500.0], &[vec![0.1, 0.2]], None).is_err());
    }
}
