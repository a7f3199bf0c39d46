//! The assumed noise of facets.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fields::finite;
use super::sample::Sample;
use crate::error::Result;
use crate::estimate::noise::{Noise, NoiseSource};

/// The noise of facets that was assumed.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub(super) struct NoiseRecord {
    /// Where it comes from.
    from: NoiseSourceRecord,
    /// Error of the model, relative to a facet's value.
    #[schemars(range(min = 0))]
    pub(super) model_error: f64,
    /// Standard deviation of all facets, if stated by a flag.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub(super) sd: Option<f64>,
}

/// Where the assumed noise of facets comes from.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "NoiseSource")]
enum NoiseSourceRecord {
    /// `vestimate --noise-sd`.
    Flag,
    /// The sample's `facet_sd`.
    FacetSd,
    /// The facets themselves: the part of their values that no reflectance explains.
    Facets,
}

impl NoiseRecord {
    /// The record of the assumed noise of facets.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub(super) fn of(noise: &Noise) -> Result<Self> {
        let (from, sd) = match noise.source {
            NoiseSource::Stated(sd) => (NoiseSourceRecord::Flag, Some(sd)),
            NoiseSource::OfFacets(_) => (NoiseSourceRecord::FacetSd, None),
            NoiseSource::Unexplained => (NoiseSourceRecord::Facets, None),
        };
        finite("estimate.noise", sd.iter().chain([&noise.model_error]))?;
        Ok(Self { from, model_error: noise.model_error, sd })
    }
}

impl Sample {
    /// The noise of facets: the stated one, else that of the sample, else estimated from the residuals that
    /// no reflectance explains; and the stated model error, else the usual one.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if `facet_sd` does not hold numbers.
    pub fn noise(&self, sd: Option<f64>, model_error: Option<f64>) -> Result<Noise> {
        let source = match sd {
            Some(sd) => NoiseSource::Stated(sd),
            None => self.facet_sd()?.map_or(NoiseSource::Unexplained, NoiseSource::OfFacets),
        };
        let model_error = model_error.unwrap_or_else(|| Noise::model_error(self.is_photograph()));
        Ok(Noise { source, model_error })
    }
}
