//! A camera's sensitivities from one photograph of a colour chart.
//!
//! J. Jiang, D. Liu, J. Gu, S. Süsstrunk, "What is the space of spectral sensitivity functions for digital
//! color cameras?", *IEEE Workshop on Applications of Computer Vision* (2013): a few principal components
//! describe the sensitivities of all cameras. Here all components of the measured cameras form a Gaussian
//! prior, each with its variance, plus a small smooth variation in which no measured camera shares.

use nalgebra::{DMatrix, DVector};

use super::measured::{KnownSensitivities, known_sensitivities};
use crate::error::{Error, Result};
use crate::spectrum::WavelengthGrid;

/// The variation beyond measured cameras: its standard deviation, relative to the geometric mean of a
/// sensitivity and its peak, and its correlation length, nm.
const OTHER_SD: f64 = 0.05;
const OTHER_REACH_NM: f64 = 20.0;
/// Standard deviation of a channel's scale around its initial guess.
const SCALE_SD: f64 = 0.3;
/// Standard deviation of stray light and black level, relative to the brightest patch.
const OFFSET_SD: f64 = 1e-3;
/// Candidates for the patches' relative error, among which the evidence decides: ageing, dirt, another batch,
/// uneven light.
const PATCH_SDS: [f64; 7] = [0.002, 0.005, 0.01, 0.015, 0.02, 0.04, 0.08];
/// Patches with a larger mean deviation are not the stated ones.
const LARGEST_RESIDUAL: f64 = 0.25;

/// A patch of a chart in a photograph.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartPatch {
    /// Reflectance, one number per waveband.
    pub reflectance: Vec<f64>,
    /// Value of R, G and B.
    pub measured: [f64; 3],
    /// Standard errors of these.
    pub standard_error: [f64; 3],
}

/// A camera derived from a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartCamera {
    /// Sensitivity of R, G and B per waveband, at least 0, normalised to green's peak.
    pub sensitivities: [Vec<f64>; 3],
    /// Standard deviations of these.
    pub sensitivities_sd: [Vec<f64>; 3],
    /// Relative error of the patches with the largest evidence.
    pub patch_sd: f64,
    /// Root mean square of the patches' relative residuals in the channel where it is largest.
    pub residual: f64,
}

impl ChartCamera {
    /// The most probable sensitivities of the camera that recorded `patches` in `light`, power per waveband
    /// of `grid`.
    ///
    /// # Errors
    /// [`Error::Numeric`] if a channel is dark, or the patches are off by more than a quarter for any camera.
    ///
    /// # Example
    /// ```
    /// use vfold::camera::{CameraResponse, ChartCamera, ChartPatch, sensitivity_error, known_sensitivities};
    /// use vfold::spectrum::{Outside, Spectrum, WavelengthGrid, illuminant, reflectances};
    /// let grid = WavelengthGrid::default();
    /// let light = illuminant("D55")?.on(&grid, Outside::Refuse)?;
    /// let truth = known_sensitivities(&grid)?.swap_remove(30).sensitivities;
    /// let response = CameraResponse::new(&grid, &truth, &light)?;
    /// let patch = |patch: &Spectrum| {
    ///     let reflectance = patch.on(&grid, Outside::Refuse)?;
    ///     let measured = response.of_flat(&reflectance).try_into().unwrap();
    ///     Ok(ChartPatch { reflectance, measured, standard_error: [1e-4; 3] })
    /// };
    /// let patches = reflectances("cc24")?.iter().map(patch).collect::<vfold::Result<Vec<_>>>()?;
    /// let camera = ChartCamera::new(&grid, &light, &patches)?;
    /// assert!(sensitivity_error(&camera.sensitivities, &truth) < 0.02);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(grid: &WavelengthGrid, light: &[f64], patches: &[ChartPatch]) -> Result<Self> {
        Self::by_prior_of(&known_sensitivities(grid)?, grid, light, patches)
    }

    /// The same, with these as the only known cameras.
    ///
    /// # Errors
    /// As [`ChartCamera::new`].
    pub fn by_prior_of(
        known: &[KnownSensitivities],
        grid: &WavelengthGrid,
        light: &[f64],
        patches: &[ChartPatch],
    ) -> Result<Self> {
        let bands = grid.len();
        let views = views(grid, light, patches)?;
        let measured = DVector::from_iterator(3 * patches.len(), channels(patches, |patch| patch.measured));
        let brightest = brightest(&measured, patches.len())?;
        let prior = Prior::new(known, grid)?.scaled(&views, &brightest);
        // rows: patches of R, of G, of B
        let design = DMatrix::identity(3, 3).kronecker(&views);
        let spread = &prior.covariance * design.transpose();
        let of_prior = &design * &spread;
        let residuals = &measured - &design * &prior.mean;
        let noise = |patch_sd: f64| {
            let errors =
                DVector::from_iterator(3 * patches.len(), channels(patches, |patch| patch.standard_error));
            let variance =
                errors.zip_map(&measured, |error, value| error.powi(2) + (patch_sd * value).powi(2));
            let same_channel = |row: usize, column: usize| row / patches.len() == column / patches.len();
            let offset = DMatrix::from_fn(measured.len(), measured.len(), |row, column| {
                let channel = brightest[row / patches.len()];
                if same_channel(row, column) { (OFFSET_SD * channel).powi(2) } else { 0.0 }
            });
            offset + DMatrix::from_diagonal(&variance)
        };
        let fit = |patch_sd: f64| {
            let solved = (&of_prior + noise(patch_sd)).cholesky()?;
            let doubt = residuals.dot(&solved.solve(&residuals))
                + 2.0 * solved.l_dirty().diagonal().map(f64::ln).sum();
            Some((doubt, patch_sd, solved))
        };
        let fits = PATCH_SDS.into_iter().filter_map(fit).filter(|(doubt, ..)| doubt.is_finite());
        let (_, patch_sd, solved) = fits
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .ok_or_else(|| Error::Numeric("the patches do not determine a camera".to_owned()))?;
        let sensitivities = (&prior.mean + &spread * solved.solve(&residuals)).map(|value| value.max(0.0));
        let covariance = &prior.covariance - &spread * solved.solve(&spread.transpose());
        let residual = residual(&(&design * &sensitivities), &measured, patches.len());
        if residual > LARGEST_RESIDUAL {
            let percent = 100.0 * residual;
            return Err(Error::Numeric(format!(
                "on average the patches are off by {percent:.0} % from any camera's response"
            )));
        }
        let peak = sensitivities.rows(bands, bands).max();
        let of_channels = |values: DVector<f64>| {
            [0, 1, 2].map(|k| values.rows(k * bands, bands).iter().map(|x| x / peak).collect())
        };
        let sensitivities_sd = covariance.diagonal().map(|variance| variance.max(0.0).sqrt());
        Ok(Self {
            sensitivities: of_channels(sensitivities),
            sensitivities_sd: of_channels(sensitivities_sd),
            patch_sd,
            residual,
        })
    }
}

/// Contribution of each waveband to each patch; they sum to 1 for the brightest patch.
fn views(grid: &WavelengthGrid, light: &[f64], patches: &[ChartPatch]) -> Result<DMatrix<f64>> {
    let widths_nm = grid.trapezoid_weights_nm();
    let view = |row: usize, band: usize| patches[row].reflectance[band] * light[band] * widths_nm[band];
    let views = DMatrix::from_fn(patches.len(), grid.len(), view);
    let most = views.column_sum().max();
    if most > 0.0 && most.is_finite() {
        return Ok(views / most);
    }
    Err(Error::Numeric("the light falls on no patch".to_owned()))
}

/// All of R, then G, then B.
fn channels(
    patches: &[ChartPatch],
    pick: impl Fn(&ChartPatch) -> [f64; 3] + Copy,
) -> impl Iterator<Item = f64> {
    (0..3).flat_map(move |channel| patches.iter().map(move |patch| pick(patch)[channel]))
}

/// The brightest patch of each channel.
fn brightest(measured: &DVector<f64>, patches: usize) -> Result<[f64; 3]> {
    let brightest = [0, 1, 2].map(|channel| measured.rows(channel * patches, patches).max());
    match brightest.iter().position(|value| !(*value > 0.0 && value.is_finite())) {
        Some(channel) => Err(Error::Numeric(format!("channel {channel} sees no light from the chart"))),
        None => Ok(brightest),
    }
}

/// Root mean square of relative residuals in the worst channel.
fn residual(fitted: &DVector<f64>, measured: &DVector<f64>, patches: usize) -> f64 {
    let relative =
        fitted.zip_map(measured, |fitted, measured| (fitted / measured.max(f64::MIN_POSITIVE) - 1.0).powi(2));
    let of_channel =
        |channel: usize| (relative.rows(channel * patches, patches).sum() / patches as f64).sqrt();
    (0..3).map(of_channel).fold(0.0, f64::max)
}

/// The prior on cameras, with R, G and B stacked.
struct Prior {
    mean: DVector<f64>,
    covariance: DMatrix<f64>,
    bands: usize,
}

impl Prior {
    /// From these cameras, with each channel normalised to a mean of 1 over the grid.
    fn new(known: &[KnownSensitivities], grid: &WavelengthGrid) -> Result<Self> {
        let bands = grid.len();
        if known.len() < 2 {
            return Err(Error::Numeric("a prior needs two cameras".to_owned()));
        }
        let column = |known: &KnownSensitivities| {
            let scaled = known.sensitivities.iter().flat_map(|curve| {
                let mean = curve.iter().sum::<f64>() / bands as f64;
                curve.iter().map(move |value| value / mean)
            });
            DVector::from_iterator(3 * bands, scaled)
        };
        let columns: Vec<_> = known.iter().map(column).collect();
        let cameras = DMatrix::from_columns(&columns);
        let mean = cameras.column_mean();
        let apart = DMatrix::from_columns(&columns.iter().map(|camera| camera - &mean).collect::<Vec<_>>());
        let covariance = &apart * apart.transpose() / (known.len() - 1) as f64 + other(&mean, grid);
        if covariance.iter().all(|number| number.is_finite()) {
            return Ok(Self { mean, covariance, bands });
        }
        Err(Error::Numeric(format!("no camera sees light on {grid}; choose wavelengths within 380..780 nm")))
    }

    /// The same, with channels scaled to match the brightest patch.
    fn scaled(self, views: &DMatrix<f64>, brightest: &[f64; 3]) -> Self {
        let bands = self.bands;
        let factor = [0, 1, 2].map(|channel| {
            let seen = (views * self.mean.rows(channel * bands, bands)).max();
            brightest[channel] / seen
        });
        let scale = DVector::from_fn(3 * bands, |row, _| factor[row / bands]);
        let mean = self.mean.component_mul(&scale);
        let covariance = DMatrix::from_fn(3 * bands, 3 * bands, |row, column| {
            let free =
                if row / bands == column / bands { SCALE_SD.powi(2) * mean[row] * mean[column] } else { 0.0 };
            self.covariance[(row, column)] * scale[row] * scale[column] + free
        });
        Self { mean, covariance, bands }
    }
}

/// Covariance of variation beyond the measured cameras: smooth along each sensitivity, small where the
/// sensitivity is.
fn other(mean: &DVector<f64>, grid: &WavelengthGrid) -> DMatrix<f64> {
    let (bands, nm) = (grid.len(), grid.wavelengths_nm());
    let peak = [0, 1, 2].map(|channel| mean.rows(channel * bands, bands).max());
    let sd = DVector::from_fn(3 * bands, |row, _| OTHER_SD * (mean[row] * peak[row / bands]).sqrt());
    DMatrix::from_fn(3 * bands, 3 * bands, |row, column| {
        let apart = (nm[row % bands] - nm[column % bands]) / OTHER_REACH_NM;
        if row / bands == column / bands { sd[row] * sd[column] * (-apart.powi(2) / 2.0).exp() } else { 0.0 }
    })
}
