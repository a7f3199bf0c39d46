//! An estimate.

use nalgebra::DMatrix;

use super::fluorescence::Fluorescence;
use super::smooth_errors::smooth_errors;
use super::unknowns::Fitted;
use super::{light, photograph};
use crate::kernel::skipped::Skipped;
use crate::solve::Termination;
use crate::solve::posterior::Iteration;

/// An estimated spectrum and how it was obtained.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Reflectance in every waveband, in (0, 1].
    pub reflectance: Vec<f64>,
    /// Bihemispherical albedo per waveband, for a sheet that is not assumed to be Lambertian.
    pub albedo: Option<Vec<f64>>,
    /// Square root of the covariance of the reflectance, with one column per waveband: its transpose times
    /// itself is the covariance. `None` for a method without an error model.
    pub spread: Option<DMatrix<f64>>,
    /// Exposure, known or fitted.
    pub exposure: f64,
    /// Parameters of the scene fitted along with the spectrum.
    pub fitted: Vec<Fitted>,
    /// Deviations of a photograph from the ideal, the most certain first.
    pub findings: Vec<photograph::Finding>,
    /// What was not examined, or not determined by the facets of a photograph.
    pub skipped: Vec<Skipped>,
    /// Reduced chi: root mean square of the residuals relative to their expected size, near 1 for a good
    /// model.
    pub residual_rms: f64,
    /// Share of the light that the estimate leaves unexplained, within what a reflectance can do to the
    /// facets.
    pub unexplained: f64,
    /// Distance of computed facets from what spectra like the estimate let expect, in standard deviations
    /// beyond chance, as far as it was computed.
    pub surprise: f64,
    /// The kind of day on which the photograph was taken, if that was inferred.
    pub day: Option<photograph::day::DayEstimate>,
    /// Emission of the sheet, if it probably has any.
    pub fluorescence: Option<Fluorescence>,
    /// The light, if it was not stated.
    pub light: Option<light::InferredLight>,
    /// Probability that no light bounces between the panels, as far as it was computed.
    pub without_bounces: f64,
    /// Number of iterations.
    pub iterations: u32,
    /// Iterations by run: under all spectra, in each light that was tried; under the most probable class
    /// until classes are distinguished; then under each class that was tried. Empty for a method without a
    /// trace.
    pub trace: Vec<Vec<Iteration>>,
    /// Why the solver stopped.
    pub termination: Termination,
}

/// Assumed accuracy of the stated light and camera, relative to the reflectance: no photograph reveals more.
const STATED_LIGHT_AND_CAMERA: f64 = 0.02;

impl Estimate {
    /// A spectrum and its exposure alone, with what they leave of the facets, [`Self::residual_rms`] and
    /// [`Self::unexplained`], and how the solver ended: all that a method without an error model gives.
    #[must_use]
    pub fn of(
        reflectance: Vec<f64>,
        exposure: f64,
        (residual_rms, unexplained): (f64, f64),
        (iterations, termination): (u32, Termination),
    ) -> Self {
        Self {
            reflectance,
            albedo: None,
            spread: None,
            exposure,
            fitted: Vec::new(),
            findings: Vec::new(),
            skipped: Vec::new(),
            residual_rms,
            unexplained,
            surprise: 0.0,
            day: None,
            fluorescence: None,
            light: None,
            without_bounces: 0.0,
            iterations,
            trace: Vec::new(),
            termination,
        }
    }

    /// The same, as a search with this trace gives it.
    pub(super) fn searched(
        reflectance: Vec<f64>,
        exposure: f64,
        left: (f64, f64),
        (trace, termination): (Vec<Vec<Iteration>>, Termination),
    ) -> Self {
        let iterations = trace.iter().map(Vec::len).sum::<usize>() as u32;
        Self { trace, ..Self::of(reflectance, exposure, left, (iterations, termination)) }
    }

    /// The same with error bars that include the errors of the stated light and camera.
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
