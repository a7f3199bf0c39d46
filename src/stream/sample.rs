//! The sample record: one sheet's facet RGB, and what the tools make of it.

use serde::{Deserialize, Serialize};
use serde_json::json;

use super::fields::{Fields, finite};
use crate::error::{Error, Result};
use crate::forward::bounces::Truncation;
use crate::plot::spectra::Curve;
use crate::score::{Metrics, Summary};

/// Largest value of a exposure that is read: products and squares of such numbers stay finite.
const LARGEST: f64 = 1e30;

/// A sample record.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Its fields, those that the tools do not know included.
    pub fields: Fields,
}

/// A true or estimated reflectance, on its own wavelengths.
#[derive(Clone, Debug, Serialize, Deserialize, PartialEq)]
pub struct ReflectanceRecord {
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

    /// Says how many bounces of light the facets' values are made of.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_bounces(&mut self, truncation: &Truncation) -> Result<()> {
        let Truncation { count, missing } = truncation;
        finite("bounces.missing", [missing])?;
        self.fields.set("bounces", json!({ "count": count, "missing": missing }))
    }

    /// Sets the true spectrum.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_truth(&mut self, truth: &ReflectanceRecord) -> Result<()> {
        finite("truth", truth.reflectance.iter().chain(&truth.wavelengths_nm))?;
        self.fields.set("truth", truth)
    }

    /// The estimate as a curve to draw; none if there is none.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a spectrum.
    pub fn curve(&self) -> Result<Option<Curve>> {
        let Some(estimate) = self.estimated()? else { return Ok(None) };
        Ok(Some(Curve {
            name: self.id()?,
            wavelengths_nm: estimate.wavelengths_nm,
            reflectance: estimate.reflectance,
            reflectance_sd: self.estimated_sd()?,
            truth: self.truth()?.map(|truth| (truth.wavelengths_nm, truth.reflectance)),
        }))
    }

    /// The true spectrum, if the sample carries it.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a spectrum.
    pub fn truth(&self) -> Result<Option<ReflectanceRecord>> {
        self.fields.get("truth")
    }

    /// Marks the sample as failed.
    ///
    /// # Errors
    /// As [`Fields::set`].
    pub fn set_error(&mut self, error: &Error) -> Result<()> {
        self.fields.set("error", error.to_string())
    }

    /// What went wrong with this sample in an earlier tool, if anything did.
    ///
    /// # Errors
    /// [`Error::Field`] if `error` is not text.
    pub fn error(&self) -> Result<Option<String>> {
        self.fields.get("error")
    }

    /// The exposure at which the facets were computed or calibrated, if it is known.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a number above 0.
    pub fn exposure(&self) -> Result<Option<f64>> {
        match self.fields.get("exposure")? {
            Some(exposure) if !(exposure > 0.0 && exposure <= LARGEST) => Err(Error::field(
                "exposure",
                format!("{exposure} gives no picture; it needs a number above 0"),
            )),
            exposure => Ok(exposure),
        }
    }

    /// Whether the facets come from a photograph.
    ///
    /// # Errors
    /// [`Error::Field`] if `image` is not an object.
    pub fn is_photograph(&self) -> Result<bool> {
        Ok(self.fields.get::<serde::de::IgnoredAny>("image")?.is_some())
    }

    /// Adds scores.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_metrics(&mut self, metrics: &Metrics) -> Result<()> {
        finite("metrics", [&metrics.rmse, &metrics.ciede2000, &metrics.pd])?;
        self.fields
            .set("metrics", json!({ "rmse": metrics.rmse, "ciede2000": metrics.ciede2000, "pd": metrics.pd }))
    }

    /// The sample's scores, if it has any.
    ///
    /// # Errors
    /// [`Error::Field`] if they are not numbers.
    pub fn metrics(&self) -> Result<Option<Metrics>> {
        #[derive(Deserialize)]
        struct MetricsRecord {
            rmse: f64,
            ciede2000: f64,
            pd: f64,
        }
        let record: Option<MetricsRecord> = self.fields.get("metrics")?;
        Ok(record.map(|MetricsRecord { rmse, ciede2000, pd }| Metrics { rmse, ciede2000, pd }))
    }
}

/// The record that ends a scored stream: how many samples, and the mean, median and worst of each score.
///
/// # Errors
/// As [`Fields::set`].
pub fn summary(summary: &Summary) -> Result<Fields> {
    let mut fields = Fields::of_kind("summary");
    fields.set("samples", summary.samples())?;
    fields.set("scored", summary.scored())?;
    if let Some(statistics) = summary.statistics() {
        for (name, pick) in [
            ("rmse", (|m: &Metrics| m.rmse) as fn(&Metrics) -> f64),
            ("ciede2000", |m| m.ciede2000),
            ("pd", |m| m.pd),
        ] {
            let [mean, median, worst] = statistics.each_ref().map(pick);
            fields.set(name, json!({ "mean": mean, "median": median, "worst": worst }))?;
        }
    }
    Ok(fields)
}
