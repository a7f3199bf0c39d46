//! The light inferred by an estimate.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fields::finite;
use super::optics::SpectrumRecord;
use crate::error::Result;
use crate::estimate::light::{InferredLight, Weighed};
use crate::plot::spectra::LightCurve;
use crate::spectrum::UNKNOWN_LIGHT;

/// Less probable candidates are omitted.
const PROBABILITY_LEAST: f64 = 1e-3;

/// The light, inferred together with the reflectance.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct InferredLightRecord {
    /// Lights that it may be, the most probable first; lights with a probability below 0.001 are left out.
    pub candidates: Vec<CandidateRecord>,
    /// The expected relative power, one number per wavelength, its mean 1.
    #[schemars(inner(range(min = 0)))]
    pub power: Vec<f64>,
    /// Its standard deviation.
    #[schemars(inner(range(min = 0)))]
    pub power_sd: Vec<f64>,
}

/// A light that it may be.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct CandidateRecord {
    /// Built-in name, or that of a column of `vestimate --illuminants`.
    pub name: String,
    /// Probability that it is this light.
    #[schemars(range(min = 0, max = 1))]
    pub probability: f64,
    /// Correlated colour temperature, K, of daylight and black bodies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cct_k: Option<f64>,
}

impl From<&Weighed> for CandidateRecord {
    fn from(Weighed { name, probability, cct_k }: &Weighed) -> Self {
        Self { name: name.clone(), probability: *probability, cct_k: *cct_k }
    }
}

impl InferredLightRecord {
    /// The record of an inferred light.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn of(found: &InferredLight) -> Result<Self> {
        finite("estimate.light", found.power.iter().chain(&found.power_sd))?;
        let probable = found.candidates.iter().filter(|one| one.probability >= PROBABILITY_LEAST);
        Ok(Self {
            candidates: probable.map(CandidateRecord::from).collect(),
            power: found.power.clone(),
            power_sd: found.power_sd.clone(),
        })
    }

    /// The mean light as a curve to draw.
    #[must_use]
    pub fn curve(&self) -> LightCurve {
        let most = self.candidates.first();
        let name = most
            .map_or_else(|| UNKNOWN_LIGHT.to_owned(), |one| format!("{} ({:.2})", one.name, one.probability));
        LightCurve { name, power: self.power.clone() }
    }

    /// The mean light as an illuminant of a scene.
    #[must_use]
    pub fn spectrum(&self) -> SpectrumRecord {
        let name = self.candidates.first().map_or(UNKNOWN_LIGHT, |first| &first.name);
        SpectrumRecord { name: name.to_owned(), power: self.power.clone(), interpolation: None }
    }
}
