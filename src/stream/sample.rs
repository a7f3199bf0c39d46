//! The sample record: one sheet's facet RGB, and what the tools make of it.

use serde::{Deserialize, Serialize};
use serde_json::json;

use super::fields::{Fields, finite};
use crate::error::{Error, Result};
use crate::estimate::Estimate;
use crate::solve::Termination;

/// Facet by channel; null for a facet that was not measured.
pub type Colours = Vec<Option<Vec<f64>>>;

/// A sample record.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Its fields, those that the tools do not know included.
    pub fields: Fields,
}

/// The true reflectance of a sample, on its own wavelengths.
#[derive(Clone, Debug, Serialize, Deserialize, PartialEq)]
pub struct Truth {
    /// Wavelengths, nm.
    pub wavelengths_nm: Vec<f64>,
    /// Reflectance a wavelength.
    pub reflectance: Vec<f64>,
}

impl Sample {
    /// An empty sample of a scene.
    ///
    /// # Errors
    /// As [`Fields::set`].
    pub fn new(scene: &str, id: &str) -> Result<Self> {
        let mut fields = Fields::of_kind("sample");
        fields.set("scene", scene)?;
        fields.set("id", id)?;
        Ok(Self { fields })
    }

    /// The sample's name.
    ///
    /// # Errors
    /// [`Error::Field`] if it has none.
    pub fn id(&self) -> Result<String> {
        self.fields.require("id", "vforward and vextract name their samples")
    }

    /// Sets the facets' values and, where known, their standard deviations.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_facets(&mut self, rgb: &Colours, sd: Option<&Colours>) -> Result<()> {
        finite("facet_rgb", rgb.iter().flatten().flatten())?;
        self.fields.set("facet_rgb", rgb)?;
        if let Some(sd) = sd {
            finite("facet_sd", sd.iter().flatten().flatten())?;
            self.fields.set("facet_sd", sd)?;
        }
        Ok(())
    }

    /// The facets' values.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing.
    pub fn facet_rgb(&self) -> Result<Colours> {
        self.fields.require("facet_rgb", "make it with vforward or vextract")
    }

    /// The facets' standard deviations, if known.
    ///
    /// # Errors
    /// [`Error::Field`] if they are not numbers.
    pub fn facet_sd(&self) -> Result<Option<Colours>> {
        self.fields.get("facet_sd")
    }

    /// Adds an estimate.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_estimate(&mut self, method: &str, prior: &str, wavelengths_nm: &[f64], estimate: &Estimate) -> Result<()> {
        finite("estimate.reflectance", &estimate.reflectance)?;
        finite("estimate.reflectance_sd", estimate.reflectance_sd.iter().flatten())?;
        finite("estimate", [&estimate.exposure, &estimate.residual_rms])?;
        let mut record = json!({
            "method": method,
            "prior": prior,
            "wavelengths_nm": wavelengths_nm,
            "reflectance": estimate.reflectance,
            "exposure": estimate.exposure,
            "residual_rms": estimate.residual_rms,
            "iterations": estimate.iterations,
            "termination": termination(&estimate.termination),
        });
        if let Some(sd) = &estimate.reflectance_sd {
            record["reflectance_sd"] = json!(sd);
        }
        self.fields.set("estimate", record)
    }

    /// The estimated spectrum, on its wavelengths; none if the sample has no estimate.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a spectrum.
    pub fn estimated(&self) -> Result<Option<Truth>> {
        self.fields.get("estimate")
    }

    /// The standard deviation of the estimated spectrum, if there is one.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a list of numbers.
    pub fn estimated_sd(&self) -> Result<Option<Vec<f64>>> {
        #[derive(Deserialize)]
        struct Deviation {
            reflectance_sd: Option<Vec<f64>>,
        }
        Ok(self.fields.get::<Deviation>("estimate")?.and_then(|estimate| estimate.reflectance_sd))
    }

    /// The true spectrum, if the sample carries it.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a spectrum.
    pub fn truth(&self) -> Result<Option<Truth>> {
        self.fields.get("truth")
    }

    /// Marks the sample as failed.
    ///
    /// # Errors
    /// As [`Fields::set`].
    pub fn set_error(&mut self, error: &Error) -> Result<()> {
        self.fields.set("error", error.to_string())
    }

    /// Whether an earlier tool failed on this sample.
    ///
    /// # Errors
    /// [`Error::Field`] if `error` is not text.
    pub fn has_error(&self) -> Result<bool> {
        Ok(self.fields.get::<String>("error")?.is_some())
    }
}

fn termination(termination: &Termination) -> serde_json::Value {
    match termination {
        Termination::Converged { gradient_norm } => json!({ "reason": "converged", "gradient_norm": gradient_norm }),
        Termination::IterationLimit => json!({ "reason": "iteration limit" }),
        Termination::NoProgress { gradient_norm } => json!({ "reason": "no progress", "gradient_norm": gradient_norm }),
    }
}
