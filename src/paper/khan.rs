//! The estimator of Khan and others for flat sheets, in one or several lights: the components visible to
//! sensors and lights.
//!
//! ## Reference
//! Khan and others (2013) as described by Deeb et al. in their introduction: basis functions "obtained by
//! eigendecomposition of spectral reflectances of 1257 Munsell color chips discarding the part of the spectra
//! that corresponds to the sensor-illuminant null-space".

use nalgebra::DMatrix;

use super::components;
use super::components::{Components, FlatSheet};
use crate::error::Result;
use crate::estimate::Estimate;
use crate::solve::Eigen;

/// Number of components in the paper: three channels under three lights.
pub const COMPONENTS: usize = 9;
/// Weight of smoothness: the method constrains a spectrum by its components alone.
pub const SMOOTHNESS: f64 = 0.0;

/// The combination of `count` components of a set of spectra, with reflectances from 0 to 1, that minimises
/// the squared distance to the sheet's values, white being 1, plus `smoothness` times its squared second
/// differences.
///
/// With as many components as values and no active bound it is `Σ Pᵀ(PΣPᵀ)⁻¹ρ`: Σ is the set's
/// `autocorrelation`, P contains the weights of wavebands in channels, ρ the values.
///
/// # Errors
/// [`crate::Error::Numeric`] if there are fewer components than `count` or the solver fails.
pub fn estimate(
    sheet: &FlatSheet,
    autocorrelation: &DMatrix<f64>,
    count: usize,
    smoothness: f64,
) -> Result<Estimate> {
    components::estimate(&basis(sheet, autocorrelation, count)?, sheet, smoothness)
}

/// The visible part of the set, by decreasing power in the values: columns of `ΣPᵀV`, with V the eigenvectors
/// of `PΣPᵀ`, in the scale of the set.
fn basis(sheet: &FlatSheet, autocorrelation: &DMatrix<f64>, count: usize) -> Result<Components> {
    let seen = autocorrelation * sheet.view.transpose();
    Components::leading(Eigen::of_symmetric(&sheet.view * &seen), count, |eigen, k| {
        &seen * eigen.vectors.column(k) / eigen.values[k].sqrt()
    })
}
