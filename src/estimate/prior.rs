//! The prior on reflectances.

use std::sync::{Arc, OnceLock};

use nalgebra::{DMatrix, DVector, RowDVector};

use super::built_in::{TabledClass, classes_on};
use super::classes::{divide, moments, shrunk};
use super::gaussian::{Gaussian, logit};
use crate::error::{Error, Result, counted};
use crate::solve::dense::transposed_product;
use crate::solve::ln_sum;

/// Correlation length and standard deviation, in logit, of deviations of spectra from the set behind a prior,
/// if all spectra are one Gaussian; also used to distinguish classes.
const MATERN_LENGTH_NM: f64 = 60.0;
const MATERN_SD: f64 = 0.25;
/// The same under a class: smaller, but increasing towards the ends of the visible spectrum, where cameras
/// see little and materials differ most. The increase falls off by a factor of e per decay length.
const MIDDLE_SD: f64 = 0.16;
const VIOLET_SD: f64 = 0.2;
const RED_SD: f64 = 0.1;
const VIOLET_NM: f64 = 400.0;
const RED_NM: f64 = 700.0;
const DECAY_NM: f64 = 20.0;

/// Possible widths of a class, relative to its usual width, with their probabilities: some spectra of a class
/// are more unusual than others, and a scale for each makes the tails heavy.
pub const SCALES: [(f64, f64); 4] = [(0.6, 0.4), (1.1, 0.35), (2.0, 0.2), (3.5, 0.05)];
/// Possible sizes of deviations beyond a class, relative to the usual size, with their probabilities: some
/// spectra are smoother than others, whatever their class.
pub const ROUGHNESSES: [(f64, f64); 2] = [(0.75, 0.65), (1.7, 0.35)];

/// A mixture of Gaussians in the logit of reflectance, one per class of spectra, and the Gaussian of all
/// classes together.
#[derive(Clone, Debug)]
pub struct Prior {
    broad: Gaussian,
    classes: Vec<Class>,
    beyond: Arc<DMatrix<f64>>,
}

/// One class of spectra.
#[derive(Clone, Debug)]
pub struct Class {
    /// Logarithm of its prior probability.
    pub ln_share: f64,
    mean: DVector<f64>,
    own: DMatrix<f64>,
    beyond: Arc<DMatrix<f64>>,
    /// Computed on first use: most classes are never needed.
    usual: OnceLock<Gaussian>,
    rough: [OnceLock<Gaussian>; ROUGHNESSES.len()],
}

impl Class {
    fn new(ln_share: f64, mean: DVector<f64>, own: DMatrix<f64>, beyond: &Arc<DMatrix<f64>>) -> Self {
        let (beyond, usual, rough) = (Arc::clone(beyond), OnceLock::new(), Default::default());
        Self { ln_share, mean, own, beyond, usual, rough }
    }

    /// Mean logit in every waveband.
    #[must_use]
    pub fn mean(&self) -> &DVector<f64> {
        &self.mean
    }

    /// Factor by waveband: a square root of the covariance of the class, without deviations of spectra beyond
    /// it.
    #[must_use]
    pub fn own(&self) -> &DMatrix<f64> {
        &self.own
    }

    /// Its spectra with deviations of the usual size.
    #[must_use]
    pub fn gaussian(&self) -> &Gaussian {
        self.usual.get_or_init(|| self.as_rough_as(1.0))
    }

    /// Its spectra at one of the [`ROUGHNESSES`].
    #[must_use]
    pub fn rough(&self, roughness: usize) -> &Gaussian {
        self.rough[roughness].get_or_init(|| self.as_rough_as(ROUGHNESSES[roughness].0))
    }

    fn as_rough_as(&self, roughness: f64) -> Gaussian {
        let beyond = roughness.powi(2) * &*self.beyond;
        Gaussian::new(self.mean.clone(), &(transposed_product(&self.own, &self.own) + beyond))
    }
}

impl Prior {
    /// The built-in prior on `wavelengths_nm`: classes of paint, cloth, plants, skin, paper and prints, and
    /// one of anything smooth.
    ///
    /// # Errors
    /// [`Error::Spectrum`] for wavelengths outside 380 to 780 nm.
    ///
    /// # Example
    /// ```
    /// use vfold::estimate::prior::Prior;
    /// let prior = Prior::built_in(&[400.0, 500.0, 600.0, 700.0])?;
    /// assert_eq!(prior.classes().len(), 42);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn built_in(wavelengths_nm: &[f64]) -> Result<Self> {
        let mut table = classes_on(wavelengths_nm)?;
        let Some(all) = table.pop() else {
            return Err(Error::Numeric("the table of the built-in prior is empty".to_owned()));
        };
        let beyond = Arc::new(beyond_class(wavelengths_nm));
        let class = |TabledClass { ln_share, mean, factors }| {
            Class::new(ln_share, mean, factors.transpose(), &beyond)
        };
        let of_all = &all.factors * all.factors.transpose() + matern(wavelengths_nm);
        Ok(Self {
            broad: Gaussian::new(all.mean, &of_all),
            classes: table.into_iter().map(class).collect(),
            beyond,
        })
    }

    /// Mean and covariance of each class of a set of spectra on `wavelengths_nm`, with a Matérn 5/2 term
    /// (60 nm, 0.16 in logit, more below 420 and above 680 nm) for what the set does not contain. `classes`
    /// gives the class of every spectrum; without it they are found ([`classes_of`]).
    ///
    /// # Source
    /// Rasmussen and Williams, *Gaussian Processes for Machine Learning* (2006), eq. (4.17).
    ///
    /// # Errors
    /// [`Error::Numeric`] for fewer than two spectra, for one whose length differs from the grid's, or if
    /// `classes` does not have one entry per spectrum.
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
        let beyond = Arc::new(beyond_class(wavelengths_nm));
        let classes = classes.map_or_else(|| divide(&logits, &matern), <[usize]>::to_vec);
        if classes.len() != spectra.len() {
            let (classes, spectra) = (counted(classes.len(), "class"), spectra.len());
            return Err(Error::Numeric(format!("{classes} for {spectra} spectra")));
        }
        let (mean, covariance) = moments(&logits, &RowDVector::from_element(spectra.len(), 1.0));
        let class = |members: Vec<usize>| {
            let count = members.len() as f64;
            let (mean, own) =
                moments(&logits.select_columns(&members), &RowDVector::from_element(members.len(), 1.0));
            let own = factor(&shrunk(&own, count, &covariance)).transpose();
            Class::new((count / spectra.len() as f64).ln(), mean, own, &beyond)
        };
        let last = classes.iter().copied().max().unwrap_or(0);
        let members = |k| (0..classes.len()).filter(|n| classes[*n] == k).collect::<Vec<_>>();
        Ok(Self {
            broad: Gaussian::new(mean, &(&covariance + &matern)),
            classes: (0..=last).map(members).filter(|members| !members.is_empty()).map(class).collect(),
            beyond,
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

    /// Logarithms of the class probabilities, tempered by this power of their shares among known spectra.
    #[must_use]
    pub fn ln_shares(&self, power: f64) -> Vec<f64> {
        let powers: Vec<f64> = self.classes.iter().map(|class| power * class.ln_share).collect();
        let ln_all = ln_sum(&powers);
        powers.into_iter().map(|ln| ln - ln_all).collect()
    }

    /// Covariance of the usual deviations of spectra beyond their class, waveband by waveband.
    #[must_use]
    pub fn beyond(&self) -> &DMatrix<f64> {
        &self.beyond
    }
}

/// Divides a set of spectra on `wavelengths_nm` into classes, one number per spectrum.
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

/// A square root of a covariance, with as few columns as matter.
fn factor(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    Gaussian::new(DVector::zeros(covariance.nrows()), covariance).basis().clone()
}

/// Covariance of the deviations of spectra beyond their class.
fn beyond_class(wavelengths_nm: &[f64]) -> DMatrix<f64> {
    let sd = |nm: f64| {
        let violet = (-(nm - VIOLET_NM).max(0.0) / DECAY_NM).exp();
        let red = (-(RED_NM - nm).max(0.0) / DECAY_NM).exp();
        (MIDDLE_SD + VIOLET_SD * violet + RED_SD * red) / MATERN_SD
    };
    let sd: Vec<f64> = wavelengths_nm.iter().map(|nm| sd(*nm)).collect();
    let mut covariance = matern(wavelengths_nm);
    for (j, mut column) in covariance.column_iter_mut().enumerate() {
        column.iter_mut().zip(&sd).for_each(|(value, own)| *value *= own * sd[j]);
    }
    covariance
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
        // 0.0625 * sklearn.gaussian_process.kernels.Matern(length_scale=60, nu=2.5)([[0.]], [[d]]) for d = 0,
        // 30, 120.
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
    fn a_rough_class_has_more_beyond_it() {
        let prior = Prior::built_in(&[400.0, 450.0, 550.0, 650.0, 700.0]).unwrap();
        let class = &prior.classes()[3];
        let own = class.own().tr_mul(class.own());
        let gaussians = ROUGHNESSES.iter().enumerate().map(|(n, (times, _))| (*times, class.rough(n)));
        for (times, gaussian) in gaussians.chain([(1.0, class.gaussian())]) {
            let covariance = gaussian.basis() * gaussian.basis().transpose();
            let want = &own + times.powi(2) * prior.beyond();
            assert!((covariance - want).amax() < 1e-3 && gaussian.mean() == class.mean(), "{times}");
        }
    }

    #[test]
    fn one_spectrum_is_no_prior() {
        assert!(Prior::from_spectra(&[400.0, 500.0], &[vec![0.1, 0.2]], None).is_err());
    }
}
