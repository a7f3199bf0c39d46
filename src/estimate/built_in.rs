//! The built-in prior: classes of spectra of paint and cloth, leaves, skin, paper and prints, as made by
//! `share/make-prior.py`.

use half::f16;
use nalgebra::{DMatrix, DVector};

use crate::error::{Error, Result};

const TABLE: &[u8] = include_bytes!("../../share/prior.npy");
const NAMES: &str = include_str!("../../share/prior.txt");

/// Wavelengths of the table, nm.
const FIRST_NM: f64 = 380.0;
const STEP_NM: f64 = 5.0;
const BANDS: usize = 81;

/// A class of the table, interpolated to some wavelengths.
pub struct TabledClass {
    /// Logarithm of its prior probability.
    pub ln_share: f64,
    /// Mean logit in every waveband.
    pub mean: DVector<f64>,
    /// Waveband by factor: a square root of the covariance, which is its product with its transpose.
    pub factors: DMatrix<f64>,
}

/// Classes of the table on `wavelengths_nm`, interpolated linearly; the last is all spectra together.
///
/// # Errors
/// [`Error::Spectrum`] if the table does not cover the wavelengths.
pub fn classes_on(wavelengths_nm: &[f64]) -> Result<Vec<TabledClass>> {
    let last_nm = FIRST_NM + STEP_NM * (BANDS - 1) as f64;
    if let Some(beyond) = wavelengths_nm.iter().find(|nm| !(FIRST_NM..=last_nm).contains(nm)) {
        let problem = format!("it covers {FIRST_NM}..{last_nm} nm, the grid has {beyond} nm");
        let remedy = "choose a grid within it or give --prior a file of spectra that covers it";
        return Err(Error::spectrum("the built-in prior", problem, remedy));
    }
    let numbers: Vec<f16> = npyz::NpyFile::new(TABLE)
        .and_then(npyz::NpyFile::into_vec)
        .map_err(|e| Error::file("share/prior.npy", e))?;
    let shares = NAMES.lines().filter_map(|line| line.split_once(' ')?.1.parse().ok());
    let shares: Vec<f64> = shares.collect();
    let rows = numbers.len() / (BANDS * shares.len().max(1));
    let places: Vec<(usize, f64)> =
        wavelengths_nm.iter().map(|nm| place((nm - FIRST_NM) / STEP_NM)).collect();
    let class = |(share, numbers): (&f64, &[f16])| {
        let value = |band: usize, row: usize| {
            let (left, part) = places[band];
            let at = |n: usize| f64::from(numbers[row * BANDS + n]);
            at(left) * (1.0 - part) + at(left + 1) * part
        };
        TabledClass {
            ln_share: share.ln(),
            mean: DVector::from_fn(places.len(), |band, _| value(band, 0)),
            factors: DMatrix::from_fn(places.len(), rows - 1, |band, factor| value(band, factor + 1)),
        }
    };
    Ok(shares.iter().zip(numbers.chunks_exact(BANDS * rows)).map(class).collect())
}

/// The table sample to the left of a position, and the distance of the position beyond it.
fn place(samples: f64) -> (usize, f64) {
    let left = (samples as usize).min(BANDS - 2);
    (left, samples - left as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_those_of_a_mixture_and_spectra_are_legal() {
        let table = classes_on(&[380.0, 402.5, 555.0, 780.0]).unwrap();
        let (all, classes) = table.split_last().unwrap();
        let total: f64 = classes.iter().map(|class| class.ln_share.exp()).sum();
        assert!((total - 1.0).abs() < 1e-4 && all.ln_share.abs() < 1e-12, "{total}");
        assert!(table.iter().all(|class| class.factors.shape() == (4, 16) && class.mean.amax() < 6.0));
    }

    #[test]
    fn what_the_table_does_not_cover_is_refused() {
        assert!(classes_on(&[379.0, 400.0]).is_err() && classes_on(&[400.0, 781.0]).is_err());
    }
}
