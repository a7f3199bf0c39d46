//! A Gaussian of the logit of reflectance, `z = ln(r/(1 − r))`.
//!
//! In logit every value is a valid reflectance, and the covariance of a set of paints or dyes spreads evenly.

use nalgebra::{DMatrix, DVector};

use crate::solve::dense::add_product;

/// Distance from 0 and 1 at which reflectances are clamped, as the logit of a measured 0 or 1 would be
/// infinite.
const MARGIN: f64 = 2e-3;
/// Variance of a waveband's logit that the basis may omit.
const LEFT_OUT: f64 = 1e-4;

/// Mean and covariance of logits on a wavelength grid.
#[derive(Clone, Debug)]
pub struct Gaussian {
    mean: DVector<f64>,
    /// Waveband by coordinate; its product with its transpose is the covariance.
    basis: DMatrix<f64>,
}

impl Gaussian {
    /// A Gaussian with this mean and covariance. The coordinates are the columns of the pivoted Cholesky
    /// factor, starting with the least predictable waveband, until no remaining standard deviation
    /// exceeds 0.01.
    ///
    /// # Source
    /// Pivoted Cholesky decomposition: Higham, *Accuracy and Stability of Numerical Algorithms* (2002),
    /// section 10.3.
    #[must_use]
    pub fn new(mean: DVector<f64>, covariance: &DMatrix<f64>) -> Self {
        let mut columns: Vec<DVector<f64>> = Vec::new();
        let mut left = covariance.diagonal();
        while columns.len() < left.len() && left.max() > LEFT_OUT {
            let pivot = left.imax();
            let explained =
                columns.iter().fold(DVector::zeros(left.len()), |sum, column| sum + column * column[pivot]);
            let column = (covariance.column(pivot) - explained) / left[pivot].sqrt();
            left -= column.component_mul(&column);
            columns.push(column);
        }
        let basis =
            if columns.is_empty() { DMatrix::zeros(left.len(), 0) } else { DMatrix::from_columns(&columns) };
        Self { mean, basis }
    }

    /// A Gaussian around the logits of a reflectance that has these independent `errors`: one per row,
    /// waveband by waveband.
    #[must_use]
    pub fn centred_on(reflectance: &[f64], errors: &DMatrix<f64>) -> Self {
        let mean = DVector::from_iterator(reflectance.len(), reflectance.iter().map(|r| logit(*r)));
        let mut basis = errors.transpose();
        for (mut row, z) in basis.row_iter_mut().zip(&mean) {
            let r = logistic(*z);
            row /= r * (1.0 - r);
        }
        Self { mean, basis }
    }

    /// The same Gaussian, wider by a factor of `scale`.
    #[must_use]
    pub fn scaled(&self, scale: f64) -> Self {
        Self { mean: self.mean.clone(), basis: scale * &self.basis }
    }

    /// The same Gaussian with only the first `count` coordinates; the others move spectra least.
    #[must_use]
    pub fn leading(&self, count: usize) -> Self {
        let count = count.min(self.basis.ncols());
        Self { mean: self.mean.clone(), basis: self.basis.columns(0, count).into_owned() }
    }

    /// Mean logit in every waveband.
    #[must_use]
    pub fn mean(&self) -> &DVector<f64> {
        &self.mean
    }

    /// Derivatives of the logits by the whitened coordinates: waveband by coordinate.
    #[must_use]
    pub fn basis(&self) -> &DMatrix<f64> {
        &self.basis
    }

    /// Logits at the whitened coordinates `w`, each of which is standard normal.
    #[must_use]
    pub fn logit_at(&self, w: &DVector<f64>) -> DVector<f64> {
        let mut logit = self.mean.clone();
        add_product(&mut logit, &self.basis, w);
        logit
    }

    /// Whitened coordinates whose logits are closest to those of `reflectance`, one per waveband.
    #[must_use]
    pub fn nearest(&self, reflectance: &[f64]) -> DVector<f64> {
        let off =
            DVector::from_iterator(reflectance.len(), reflectance.iter().map(|r| logit(*r))) - &self.mean;
        let mut normal = self.basis.transpose() * &self.basis;
        (0..normal.nrows()).for_each(|i| normal[(i, i)] += LEFT_OUT);
        let start = normal.cholesky().map(|factor| factor.solve(&self.basis.tr_mul(&off)));
        start.unwrap_or_else(|| DVector::zeros(self.basis.ncols()))
    }
}

/// Logit of a reflectance, clamped away from the ends of its range.
#[must_use]
pub fn logit(r: f64) -> f64 {
    let r = r.clamp(MARGIN, 1.0 - MARGIN);
    (r / (1.0 - r)).ln()
}

/// Reflectance of a logit.
#[must_use]
pub fn logistic(z: f64) -> f64 {
    1.0 / (1.0 + (-z).exp())
}

/// Mean slope of reflectance as a function of its logit, over one standard deviation `sd` on both sides of
/// `z`. The slope at `z` itself vanishes near 0 and 1, however uncertain a logit is there.
#[must_use]
pub fn mean_slope(z: f64, sd: f64) -> f64 {
    // Below this sd the result is the slope at `z`, and digits would cancel. The slope is the same at -z,
    // where they do not.
    let (z, sd) = (-z.abs(), sd.max(1e-6));
    (logistic(z + sd) - logistic(z - sd)) / (2.0 * sd)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_logit_that_is_not_known_is_a_reflectance_that_is_not_known() {
        for z in [-40.0, -3.0, 0.0, 3.0, 40.0] {
            let slope = logistic(z) * logistic(-z);
            assert!((mean_slope(z, 1e-9) / slope - 1.0).abs() < 1e-7, "{z}");
            assert!((1e6 * mean_slope(z, 1e6) - 0.5).abs() < 1e-12, "{z}");
        }
    }

    #[test]
    fn the_basis_gives_the_covariance() {
        let covariance = DMatrix::from_fn(21, 21, |i, j| 2.0 * (-0.02 * (i as f64 - j as f64).powi(2)).exp());
        let gaussian = Gaussian::new(DVector::from_element(21, 0.3), &covariance);
        let basis = gaussian.basis();
        assert!(basis.ncols() < 12, "{} coordinates", basis.ncols());
        assert!((basis * basis.transpose() - covariance).amax() < 2.0 * LEFT_OUT);
        assert!((gaussian.logit_at(&DVector::zeros(basis.ncols())) - gaussian.mean()).amax() < 1e-15);
    }
}
