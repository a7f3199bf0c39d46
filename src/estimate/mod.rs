//! From facet RGB to the spectrum: by its most probable value among the classes of known spectra ([`map`]), of photographs together with the
//! unknowns of sheet, light and camera ([`photograph`]). The paper's own estimator and its rivals are in [`paper`](crate::paper).

mod alternatives;
mod built_in;
mod channels;
pub mod classes;
mod compress;
pub mod data;
pub mod emission;
mod facets;
mod family;
pub mod fluorescence;
pub mod gaussian;
pub mod light;
mod linear;
pub mod map;
pub mod measured;
pub mod measurement;
mod mixture;
pub mod noise;
pub mod photograph;
pub mod prior;
mod search;
pub mod shading;
pub mod shadow;
mod smooth_errors;
mod starts;
pub mod taking;
pub mod unknowns;
pub mod verdict;

use fluorescence::Fluorescence;
use nalgebra::DMatrix;
use photograph::beliefs::Beliefs;
use smooth_errors::smooth_errors;
use unknowns::{Normal, Unknown};

use crate::kernel::skipped::Skipped;
use crate::solve::Termination;
use crate::solve::posterior::Iteration;

/// Residuals, in units of their expected size, beyond which the scene cannot be right.
pub const MISFIT: f64 = 5.0;

/// How the exposure of the picture enters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// Known: a perfect white diffuser facing the sun has this value in its strongest channel.
    Known(f64),
    /// Unknown: the exposure that fits best, for every spectrum tried (variable projection, Golub and Pereyra 1973).
    Free,
    /// Unknown, and its logarithm normal before the picture is looked at: the one that is most probable, for every spectrum tried.
    Expected(Normal),
    /// Unknown: picture and model are divided by their sums, as the paper does (section 5D).
    Sum,
}

impl Exposure {
    /// Its value, if it is known.
    #[must_use]
    pub fn known(self) -> Option<f64> {
        match self {
            Self::Known(exposure) => Some(exposure),
            Self::Free | Self::Expected(_) | Self::Sum => None,
        }
    }

    /// The same where something is known of its logarithm, if it is.
    #[must_use]
    pub fn or_expected(self, known: Option<Normal>) -> Self {
        match (self, known) {
            (Self::Free, Some(known)) => Self::Expected(known),
            _ => self,
        }
    }

    /// The same of a photograph: of an exposure that nobody states something is known, as [people expose](Beliefs::exposure).
    #[must_use]
    pub fn of_photograph(self) -> Self {
        match self {
            Self::Free => Self::Expected(Beliefs::USUAL.exposure()),
            stated => stated,
        }
    }
}

/// An estimated spectrum and how it was reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Reflectance in every waveband, in (0, 1].
    pub reflectance: Vec<f64>,
    /// Albedo in every waveband, of a sheet that is not taken to be Lambertian: reflectance for light from everywhere to everywhere.
    pub total: Option<Vec<f64>>,
    /// How far it may be off, one column per waveband: the product of its transpose with it is the covariance of the reflectance.
    /// None from a method that has no model of its error.
    pub spread: Option<DMatrix<f64>>,
    /// Exposure: as known, or as found.
    pub exposure: f64,
    /// Numbers of the scene that were found along with the spectrum.
    pub fitted: Vec<Fitted>,
    /// What of a photograph is not ideal, what the facets are surest of first.
    pub findings: Vec<photograph::Finding>,
    /// What was not looked at, or not told by the facets of a photograph.
    pub skipped: Vec<Skipped>,
    /// Root mean square of the residuals, in units of their expected size: near 1 for a good model.
    pub residual_rms: f64,
    /// Share of the light that the estimate leaves over, in what a reflectance can do to the facets at all.
    pub unexplained: f64,
    /// The kind of day on which the photograph was taken, where that is looked for.
    pub day: Option<photograph::day::Found>,
    /// What the sheet sends out itself, if it probably does.
    pub fluorescence: Option<Fluorescence>,
    /// The light, where nobody stated it.
    pub light: Option<light::FoundLight>,
    /// Probability that no light bounces between the panels, as far as that is weighed.
    pub without_bounces: f64,
    /// Iterations.
    pub iterations: u32,
    /// What happened in them, by runs: under all spectra, under the likeliest class to where classes are told apart, then under each class that
    /// was tried. Empty from a method that keeps no trace.
    pub trace: Vec<Vec<Iteration>>,
    /// Why the solver stopped.
    pub termination: Termination,
}

/// A number of the scene as found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// What it is.
    pub unknown: &'static Unknown,
    /// Value.
    pub value: f64,
    /// Standard deviation, in the same unit.
    pub sd: f64,
    /// Whether the facets say more of it than was known before.
    pub supported: bool,
}

/// What is stated of light and camera is right to that, as a part of the reflectance: no photograph tells more.
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
