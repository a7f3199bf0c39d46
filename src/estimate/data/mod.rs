//! Facet RGB as data to fit, compressed to what exceeds the noise.
//!
//! All facets combine the same few terms of the reflectance, so hundreds of facet values hold a dozen numbers
//! per channel (the rank of the terms over reflectances from 0 to 1, given the noise). The rest is pure noise
//! and omitted.

mod derivatives;
mod emitting;

use std::borrow::Cow;

pub use derivatives::{Curvature, FittedExposure, LinearisedFacets, Predicted, SecondDerivatives};
use nalgebra::{DVector, DVectorView};

use super::channels::Channels;
use super::compress::{Compressed, sum_of_rows};
use super::emission::Emission;
use super::measured::{Measured, usable_facets};
use crate::camera::CameraResponse;
use crate::error::Result;
use crate::estimate::Exposure;
use crate::estimate::unknowns::{Normal, SceneModel};

/// The problem of one sample: weighted, compressed data and the model that predicts them.
///
/// A point of the model is a reflectance per waveband and a standard normal number for each unknown of the
/// scene.
#[derive(Clone)]
pub struct FacetData<'a> {
    scene: Cow<'a, SceneModel>,
    exposure: Exposure,
    /// The compressed data, in units of their noise, and the model of each channel that predicts them.
    values: DVector<f64>,
    channels: Channels,
    /// Sum of squares that no reflectance explains.
    outside: f64,
    /// Number of facet values.
    count: usize,
    /// The brightest facet value in units of its noise.
    pub(super) peak: f64,
    sums: SumRule,
    /// Logarithm of the determinant of what makes errors of these data independent.
    pub(super) ln_whitening: f64,
    /// Possible emission of the sheet; `None` if it is not considered.
    emission: Option<Emission>,
    /// True if the sheet may fluoresce at all.
    may_fluoresce: bool,
}

/// The sum of all facet values: measured, and of the terms of each source.
#[derive(Clone)]
struct SumRule {
    measured: f64,
    sources: Vec<DVector<f64>>,
}

/// Brightness used to weigh directions of the model, at least 1: the exposure or, if that is fitted, the
/// brightest facet. At an exposure below 1 a few more directions are kept than exceed the noise.
fn brightness(measured: &Measured, exposure: Exposure) -> f64 {
    match exposure {
        Exposure::Known(exposure) => exposure.max(1.0),
        Exposure::Free | Exposure::Expected(_) | Exposure::Sum => measured.rgb.greatest().max(1.0),
    }
}

impl<'a> FacetData<'a> {
    /// Weights and compresses the facets of a sample, omitting directions in which no reflectance moves the
    /// data by more than `cutoff` standard deviations.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if facets, channels or values do not fit the scene, or no facet was measured.
    pub fn new(scene: &'a SceneModel, measured: &Measured, exposure: Exposure, cutoff: f64) -> Result<Self> {
        let model = scene.facets();
        let usable = usable_facets(model, measured)?;
        let channels = model.sources()[0].camera.channels();
        let cutoff = cutoff / brightness(measured, exposure);
        let compressed =
            |channel| Compressed::channel(model, || scene.reach(), (measured, &usable, channel), cutoff);
        let all: Vec<_> = (0..channels).map(compressed).collect();
        let values = all.iter().flat_map(|one| one.data.iter().copied()).collect();
        let maps: Vec<_> = all.iter().map(|one| one.maps.as_slice()).collect();
        let cameras = model.sources().iter().map(|source| &source.camera);
        let sums = SumRule {
            measured: usable
                .iter()
                .filter_map(|facet| measured.rgb.facet(*facet))
                .map(|facet| facet.sum())
                .sum(),
            sources: model.sources().iter().map(|source| sum_of_rows(&source.facets, &usable)).collect(),
        };
        Ok(Self {
            scene: Cow::Borrowed(scene),
            exposure,
            values: DVector::from_vec(values),
            channels: Channels::new(&maps, cameras),
            outside: all.iter().map(|one| one.outside).sum(),
            count: usable.len() * channels,
            peak: all.iter().map(|one| one.peak).fold(0.0, f64::max),
            sums,
            ln_whitening: 0.0,
            emission: None,
            may_fluoresce: true,
        })
    }

    /// The possible emission of the sheet; `None` if it is not considered.
    #[must_use]
    pub fn emission(&self) -> Option<&Emission> {
        self.emission.as_ref()
    }

    /// Number of unknowns, including those of the emission.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.scene.unknowns().len() + self.emission.as_ref().map_or(0, Emission::unknowns)
    }

    /// Number of compressed data, and of the facet values behind them.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.values.len(), self.count)
    }

    /// Number of the camera's channels in all lights together.
    #[must_use]
    pub fn channels(&self) -> usize {
        self.channels.count()
    }

    /// Root mean square of all facet residuals, including those outside the compressed data.
    #[must_use]
    pub fn rms(&self, residuals: &DVector<f64>) -> f64 {
        let of_facets = self.of_facets(residuals).norm_squared();
        ((of_facets + self.outside.max(0.0)) / self.count as f64).sqrt()
    }

    /// The residuals without that of the expected exposure.
    fn of_facets<'r>(&self, residuals: &'r DVector<f64>) -> DVectorView<'r, f64> {
        residuals.rows(0, self.values.len())
    }

    /// Residuals relative to the data, both without the noise that no reflectance can explain.
    #[must_use]
    pub fn unexplained(&self, residuals: &DVector<f64>) -> f64 {
        self.of_facets(residuals).norm() / self.values.norm().max(f64::MIN_POSITIVE)
    }

    /// The scene and its unknowns.
    #[must_use]
    pub fn scene(&self) -> &SceneModel {
        &self.scene
    }

    /// The same data with one unknown of the scene fixed at this value.
    #[must_use]
    pub fn with_known(&self, unknown: usize, value: f64) -> Self {
        let scene = self.scene.clone().into_owned().with_known(unknown, value);
        Self { scene: Cow::Owned(scene), ..self.clone() }
    }

    /// The same data in another light, given the camera's response to it. The facets' weights of the terms,
    /// and hence the compression, are unchanged.
    #[must_use]
    pub fn in_light(&self, camera: &CameraResponse) -> Self {
        let (scene, channels) = (self.scene.in_light(camera), self.channels.in_light(camera));
        let (values, sums, emission) = (self.values.clone(), self.sums.clone(), self.emission.clone());
        Self { scene: Cow::Owned(scene), channels, values, sums, emission, ..*self }
    }

    /// The same data if their noise is that many times as large, and errors of the camera's response, as they
    /// are at this point, come on top; `None` if there are none, or the point is not finite.
    #[must_use]
    pub fn with_camera_errors(&self, noise: f64, (reflectance, unknowns): (&[f64], &[f64])) -> Option<Self> {
        let errors = self.scene.camera_errors();
        if errors.is_empty() {
            return None;
        }
        let Predicted { exposure, amounts, .. } = self.residuals(reflectance, unknowns).ingredients;
        let terms = self.scene.facets().terms_of(reflectance);
        let amounts = exposure * amounts.values();
        let (channels, values, ln_whitening) =
            self.channels.whitened(&self.values, (&terms, &amounts), (noise, errors))?;
        let peak = self.peak / noise;
        let (scene, sums, emission) = (self.scene.clone(), self.sums.clone(), self.emission.clone());
        let outside = self.outside / (noise * noise);
        Some(Self { scene, channels, values, ln_whitening, outside, peak, sums, emission, ..*self })
    }

    /// The same data with this prior, if any, on the logarithm of an exposure that was entirely unknown.
    #[must_use]
    pub fn expecting(self, exposure: Option<Normal>) -> Self {
        Self { exposure: self.exposure.or_expected(exposure), ..self }
    }

    /// True if the exposure is fitted to the facets.
    #[must_use]
    pub fn fits_exposure(&self) -> bool {
        matches!(self.exposure, Exposure::Free | Exposure::Expected(_))
    }

    fn exposure_of(&self, values: &DVector<f64>, sum: impl Fn() -> f64) -> f64 {
        let by_sums = || self.sums.measured / sum().max(f64::MIN_POSITIVE);
        self.exposure.fitted(&self.values, values, by_sums)
    }

    /// Data minus model, given `values` of the model at exposure 1, followed by the deviation from the
    /// expected exposure, if there is one.
    fn left_over(&self, exposure: f64, values: &DVector<f64>) -> DVector<f64> {
        let of_facets = &self.values - exposure * values;
        match self.exposure.off(exposure) {
            Some(off) => of_facets.push(-off),
            None => of_facets,
        }
    }
}
