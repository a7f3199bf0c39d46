//! The camera of a photograph: its response to light of any spectrum, and the errors of its sensitivities.

use nalgebra::{DMatrix, DVector};

use super::priors::Priors;
use crate::solve::Eigen;

/// The camera's response to light of any spectrum.
#[derive(Clone, Debug)]
pub struct Eye {
    /// Wavelengths, nm.
    pub wavelengths_nm: Vec<f64>,
    /// Widths of the wavebands, nm.
    pub widths_nm: Vec<f64>,
    /// Sensitivity times the width of the waveband: waveband by channel.
    pub sensitivities: DMatrix<f64>,
    /// Possible errors of the sensitivities, each of one standard deviation: error by waveband, with its
    /// channel.
    pub errors: Vec<(usize, DVector<f64>)>,
    /// True if the sensitivities are those of another camera, which stands in for this one.
    pub is_stand_in: bool,
    /// Stated power of the sun.
    pub sun: DVector<f64>,
    /// Stated power of the sky.
    pub sky: DVector<f64>,
    /// Mean daylight and its two characteristic vectors: waveband by three.
    pub daylight: DMatrix<f64>,
    /// The channel in which white is 1.
    pub reference: usize,
}

impl Eye {
    /// A camera with other sensitivities, one number per waveband for each channel, and these errors of them,
    /// in the same light.
    #[must_use]
    pub fn with(&self, sensitivities: &[Vec<f64>], errors: Vec<(usize, DVector<f64>)>) -> Self {
        let weighted = DMatrix::from_fn(self.widths_nm.len(), sensitivities.len(), |band, channel| {
            sensitivities[channel][band] * self.widths_nm[band]
        });
        Self {
            errors,
            is_stand_in: false,
            reference: weighted.tr_mul(&self.sun).imax(),
            sensitivities: weighted,
            ..self.clone()
        }
    }

    /// Sizes of its errors at which they are as nearly as possible those of another camera, of these sizes:
    /// errors of one channel are orthogonal.
    pub fn sizes_of(&self, other: &Self, sizes: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut all = DMatrix::zeros(other.sensitivities.nrows(), other.sensitivities.ncols());
        for ((channel, error), size) in other.errors.iter().zip(sizes) {
            all.column_mut(*channel).axpy(size, error, 1.0);
        }
        let size = |(channel, error): &(usize, DVector<f64>)| {
            error.dot(&all.column(*channel)) / error.norm_squared().max(f64::MIN_POSITIVE)
        };
        self.errors.iter().map(size).collect()
    }

    /// True if it is the same camera, judging by its sensitivities.
    #[must_use]
    pub fn is(&self, other: &Self) -> bool {
        (&self.wavelengths_nm, &self.sensitivities) == (&other.wavelengths_nm, &other.sensitivities)
            && self.errors == other.errors
    }
}

/// Principal components of a channel's errors that count. The next one is a tenth of the first, and light of
/// a sheet, which varies less over the wavelengths, hardly shows it.
const COMPONENTS: usize = 4;

/// Smooth errors of the sensitivities, independent of each other, the largest of each channel first. A
/// channel with fewer than ten samples that see anything belongs to a narrow filter and is assumed exact.
///
/// # Source
/// Principal components of errors that are alike over a range of wavelengths: Bishop, *Pattern Recognition
/// and Machine Learning* (2006), section 12.1.4.
#[must_use]
pub fn errors(
    sensitivities: &[Vec<f64>],
    wavelengths_nm: &[f64],
    widths: &[f64],
    priors: &Priors,
) -> Vec<(usize, DVector<f64>)> {
    let Priors { sensitivity_sd, sensitivity_step_nm, .. } = *priors;
    let (first, last) = (wavelengths_nm[0], wavelengths_nm[wavelengths_nm.len() - 1]);
    let count = ((last - first) / sensitivity_step_nm).round().max(1.0) as usize;
    let mut all = Vec::new();
    for (channel, curve) in sensitivities.iter().enumerate() {
        let most = curve.iter().copied().fold(0.0, f64::max);
        if curve.iter().filter(|value| **value > 1e-3 * most).count() < 10 {
            continue;
        }
        let bumps = DMatrix::from_fn(wavelengths_nm.len(), count + 1, |band, bump| {
            let middle = first + (last - first) * bump as f64 / count as f64;
            let off = (wavelengths_nm[band] - middle) / sensitivity_step_nm;
            let envelope = (curve[band] / most).max(0.0).sqrt();
            sensitivity_sd * most * envelope * (-0.5 * off * off).exp() * widths[band]
        });
        all.extend(principal_components(&bumps).into_iter().map(|error| (channel, error)));
    }
    all
}

/// The largest of the errors in which the columns, each with a standard normal size, are independent again.
fn principal_components(columns: &DMatrix<f64>) -> Vec<DVector<f64>> {
    let Eigen { values, vectors } = Eigen::of_symmetric(columns.tr_mul(columns));
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
    order.iter().take(COMPONENTS).map(|n| columns * vectors.column(*n)).collect()
}

/// The same errors as shares of the sensitivities.
#[must_use]
pub fn shares_of(
    sensitivities: &[Vec<f64>],
    wavelengths_nm: &[f64],
    priors: &Priors,
) -> Vec<(usize, DVector<f64>)> {
    let share = |(channel, mut error): (usize, DVector<f64>)| {
        let seen = error.iter_mut().zip(&sensitivities[channel]);
        seen.for_each(|(error, value)| *error = if *value > 0.0 { *error / value } else { 0.0 });
        (channel, error)
    };
    let of_unit_width = vec![1.0; wavelengths_nm.len()];
    errors(sensitivities, wavelengths_nm, &of_unit_width, priors).into_iter().map(share).collect()
}

#[cfg(test)]
mod tests {
    use std::iter;

    use super::*;

    #[test]
    fn errors_of_one_camera_are_its_own() {
        let wavelengths_nm: Vec<f64> = (0..31).map(|n| 400.0 + 10.0 * f64::from(n)).collect();
        let curve =
            |middle: f64| wavelengths_nm.iter().map(move |nm| (-((nm - middle) / 50.0).powi(2)).exp());
        let sensitivities = [600.0, 540.0, 460.0].map(|middle| curve(middle).collect::<Vec<_>>());
        let (widths_nm, white) = (vec![10.0; 31], DVector::from_element(31, 1.0));
        let errors = errors(&sensitivities, &wavelengths_nm, &widths_nm, &Priors::USUAL);
        assert_eq!(errors.len(), 3 * COMPONENTS);
        let camera = Eye {
            wavelengths_nm: wavelengths_nm.clone(),
            widths_nm,
            sensitivities: DMatrix::zeros(31, 3),
            errors,
            is_stand_in: false,
            sun: white.clone(),
            sky: white,
            daylight: DMatrix::zeros(31, 3),
            reference: 0,
        };
        let sizes: Vec<f64> = (0..3 * COMPONENTS).map(|n| (n as f64).sin()).collect();
        let same = camera.sizes_of(&camera, sizes.iter().copied());
        assert!(iter::zip(&sizes, &same).all(|(size, same)| (size - same).abs() < 1e-9), "{same:?}");
    }
}
