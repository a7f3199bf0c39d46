//! An estimate.

use nalgebra::DMatrix;

use super::fluorescence::Fluorescence;
use super::smooth_errors::smooth_errors;
use super::unknowns::Fitted;
use super::{light, photograph};
use crate::kernel::skipped::Skipped;
use crate::solve::Termination;
use crate::solve::posterior::Iteration;

/// An estimated spectrum and how it was reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Reflectance in every waveband, in (0, 1].
    pub reflectance: Vec<f64>,
    /// Bihemispherical albedo in every waveband, of a sheet that is not taken to be Lambertian.
    pub albedo: Option<Vec<f64>>,
    /// How far it may be off, one column per waveband: the product of its transpose with it is the covariance
    /// of the reflectance. None from a method that has no model of its error.
    pub spread: Option<DMatrix<f64>>,
    /// Exposure: as known, or as found.
    pub exposure: f64,
    /// Numbers of the scene that were found along with the spectrum.
    pub fitted: Vec<Fitted>,
    /// What of a photograph is not ideal, what the facets are surest of first.
    pub findings: Vec<photograph::Finding>,
    /// What was not looked at, or not determined by the facets of a photograph.
    pub skipped: Vec<Skipped>,
    /// Reduced chi: root mean square of the residuals, in units of their expected size; near 1 for a good
    /// model.
    pub residual_rms: f64,
    /// Share of the light that the estimate leaves over, in what a reflectance can do to the facets at all.
    pub unexplained: f64,
    /// The kind of day on which the photograph was taken, where that is looked for.
    pub day: Option<photograph::day::DayEstimate>,
    /// What the sheet sends out itself, if it probably does.
    pub fluorescence: Option<Fluorescence>,
    /// The light, where nobody stated it.
    pub light: Option<light::InferredLight>,
    /// Probability that no light bounces between the panels, as far as that is weighed.
    pub without_bounces: f64,
    /// Iterations.
    pub iterations: u32,
    /// What happened in them, by runs: under all spectra, under the most probable class to where classes are
    /// distinguished, then under each class that was tried. Empty from a method that keeps no trace.
    pub trace: Vec<Vec<Iteration>>,
    /// Why the solver stopped.
    pub termination: Termination,
}

/// What is stated of light and camera is right to that, as a part of the reflectance: no photograph tells
/// more.
const STATED_LIGHT_AND_CAMERA: f64 = 0.02;

impl Estimate {
    /// The same with error bars that hold what light and camera may be off as stated.
    #[must_use]
    pub fn in_stated_light(mut self, wavelengths_nm: &[f64]) -> Self {
        let sd: Vec<f64> = self.reflectance.iter().map(|r| STATED_LIGHT_AND_CAMERA * r).collect();
        if let (Some(spread), Some(errors)) = (&self.spread, smooth_errors(wavelengths_nm, &sd)) {
            let rows: Vec<_> =
                spread.row_iter().chain(errors.row_iter()).map(nalgebra::Matrix::into_owned).collect();
            self.spread = Some(DMatrix::from_rows(&rows));
        }
        self
    }

    /// Standard deviation in every waveband.
    #[must_use]
    pub fn reflectance_sd(&self) -> Option<Vec<f64>> {
        Some(self.spread.as_ref()?.column_iter().map(|column| column.norm()).collect())
    }

    /// Covariance, waveband by waveband.
    #[must_use]
    pub fn covariance(&self) -> Option<DMatrix<f64>> {
        self.spread.as_ref().map(|spread| spread.transpose() * spread)
    }
}
