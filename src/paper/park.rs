//! The estimator of Park and others for flat sheets, in one or several lights: a few components, and
//! smoothness.
//!
//! ## Reference
//! J.-I. Park, M.-H. Lee, M. D. Grossberg, S. K. Nayar, "Multispectral imaging using multiplexed
//! illumination", *ICCV* (2007); the components are those of J. P. S. Parkkinen, J. Hallikainen, T.
//! Jaaskelainen, *JOSA A* 6 (1989), p. 318.

use nalgebra::DMatrix;

use super::components;
use super::components::{Components, FlatSheet};
use crate::error::Result;
use crate::estimate::Estimate;
use crate::solve::Eigen;

/// Number of components in the paper, for three lights.
pub const COMPONENTS: usize = 8;
/// Weight of smoothness: with three lights and no noise, near the minimum of the error on the 24 patches of a
/// ColorChecker.
pub const SMOOTHNESS: f64 = 1e-4;

/// The combination of the first `count` principal components of a set of spectra, with reflectances from 0 to
/// 1, that minimises the squared distance to the sheet's values, white being 1, plus `smoothness` times its
/// squared second differences.
///
/// `autocorrelation` is [`components::autocorrelation`] of the set.
///
/// # Errors
/// [`crate::Error::Numeric`] if the set has fewer components or the solver fails.
///
/// # Example
/// ```
/// use nalgebra::dmatrix;
/// use vfold::paper::components::{FlatSheet, autocorrelation};
/// use vfold::paper::park;
/// // Two spectra, and a camera with a channel for each of their three wavebands.
/// let set = autocorrelation(&[vec![0.2, 0.4, 0.6], vec![0.6, 0.4, 0.2]]);
/// let sheet = FlatSheet {
///     view: dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.0, 1.0],
///     values: vec![0.3, 0.4, 0.5],
///     exposure: Some(1.0),
/// };
/// let estimate = park::estimate(&sheet, &set, 2, 0.0)?;
/// assert!((estimate.reflectance[2] - 0.5).abs() < 1e-6);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn estimate(
    sheet: &FlatSheet,
    autocorrelation: &DMatrix<f64>,
    count: usize,
    smoothness: f64,
) -> Result<Estimate> {
    components::estimate(&basis(autocorrelation, count)?, sheet, smoothness)
}

/// Eigenvectors of the largest eigenvalues. The mean of the set is not subtracted; the first one is close to
/// it.
fn basis(autocorrelation: &DMatrix<f64>, count: usize) -> Result<Components> {
    Components::leading(Eigen::of_symmetric(autocorrelation.clone()), count, |eigen, k| {
        eigen.vectors.column(k).into_owned()
    })
}
