//! The sample record: one sheet's facet RGB, and what the tools make of it.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::fields::{Fields, finite};
use crate::error::{Error, Result};
use crate::estimate::unknowns::Quantity;
use crate::estimate::{Estimate, Fitted};
use crate::forward::bounces::Truncation;
use crate::plot::spectra::Curve;
use crate::score::{Metrics, Summary};
use crate::solve::Termination;
use crate::solve::posterior::Iteration;

/// Largest value of a facet that is read: sums and squares of such numbers stay finite.
const LARGEST: f64 = 1e30;

/// Facet by channel; null for a facet that was not measured.
pub type Colours = Vec<Option<Vec<f64>>>;

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
        let rgb: Colours = self.fields.require("facet_rgb", "make it with vforward or vextract")?;
        within("facet_rgb", &rgb, -LARGEST..=LARGEST)?;
        Ok(rgb)
    }

    /// The facets' standard deviations, if known.
    ///
    /// # Errors
    /// [`Error::Field`] if they are not numbers.
    pub fn facet_sd(&self) -> Result<Option<Colours>> {
        let sd: Option<Colours> = self.fields.get("facet_sd")?;
        sd.as_ref().map_or(Ok(()), |sd| within("facet_sd", sd, 0.0..=LARGEST))?;
        Ok(sd)
    }

    /// Adds an estimate, with its covariance (waveband by waveband) if asked to.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_estimate(
        &mut self,
        method: &str,
        prior: &str,
        wavelengths_nm: &[f64],
        estimate: &Estimate,
        with_covariance: bool,
    ) -> Result<()> {
        let sd = estimate.reflectance_sd();
        finite("estimate.reflectance", &estimate.reflectance)?;
        finite("estimate.reflectance_sd", sd.iter().flatten())?;
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
        if let Some(sd) = sd {
            record["reflectance_sd"] = json!(sd);
        }
        if !estimate.fitted.is_empty() {
            record["fit"] = fit(&estimate.fitted)?;
        }
        if let Some(covariance) = estimate.covariance().filter(|_| with_covariance) {
            let rows = covariance.row_iter().map(|row| row.iter().copied().collect());
            record["covariance"] = json!(rows.collect::<Vec<Vec<f64>>>());
        }
        self.fields.set("estimate", record)
    }

    /// Names of the numbers that were to be fitted and of which the facets say nothing.
    ///
    /// # Errors
    /// [`Error::Field`] if what was fitted is not what [`Sample::set_estimate`] writes.
    pub fn unsupported(&self) -> Result<Vec<String>> {
        #[derive(Deserialize)]
        struct Fit {
            fit: Option<BTreeMap<String, Supported>>,
        }
        #[derive(Deserialize)]
        struct Supported {
            supported: bool,
        }
        let fit = self.fields.get::<Fit>("estimate")?.and_then(|estimate| estimate.fit).unwrap_or_default();
        Ok(fit.into_iter().filter(|(_, one)| !one.supported).map(|(name, _)| name).collect())
    }

    /// Adds the iterations that led to an estimate, for [`Sample::take_trace`].
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_trace(&mut self, trace: &[Vec<Iteration>]) -> Result<()> {
        let mut lines = Vec::new();
        for (run, iterations) in trace.iter().enumerate() {
            for (iteration, Iteration { cost, gradient_norm, damping, inflation }) in
                iterations.iter().enumerate()
            {
                finite("trace", [cost, gradient_norm, damping, inflation])?;
                lines.push(json!({
                    "kind": "iteration",
                    "sample": self.id()?,
                    "run": run,
                    "iteration": iteration,
                    "cost": cost,
                    "gradient_norm": gradient_norm,
                    "damping": damping,
                    "noise": inflation,
                }));
            }
        }
        self.fields.set("trace", lines)
    }

    /// Takes the iterations out, a record each: `run` 0 is under all spectra as one Gaussian, the others each under a class.
    ///
    /// # Errors
    /// [`Error::Field`] if `trace` is not a list of objects.
    pub fn take_trace(&mut self) -> Result<Vec<Fields>> {
        let lines: Vec<Map<String, Value>> = self.fields.get("trace")?.unwrap_or_default();
        self.fields.0.remove("trace");
        Ok(lines.into_iter().map(Fields).collect())
    }

    /// The estimated spectrum, on its wavelengths; none if the sample has no estimate.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a spectrum.
    pub fn estimated(&self) -> Result<Option<ReflectanceRecord>> {
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

    /// Residuals of the estimate in units of their expected size, if there is an estimate.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a number.
    pub fn residual_rms(&self) -> Result<Option<f64>> {
        #[derive(Deserialize)]
        struct Fit {
            residual_rms: f64,
        }
        Ok(self.fields.get::<Fit>("estimate")?.map(|fit| fit.residual_rms))
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

/// Fitted numbers by name.
fn fit(fitted: &[Fitted]) -> Result<Value> {
    let mut all = Map::new();
    for Fitted { quantity, value, sd, supported } in fitted {
        finite("estimate.fit", [value, sd])?;
        all.insert(
            fitted_name(*quantity).to_owned(),
            json!({ "value": value, "sd": sd, "supported": supported }),
        );
    }
    Ok(Value::Object(all))
}

/// Field of a fitted number.
pub(super) fn fitted_name(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Exposure => "exposure",
        Quantity::TiltDeg => "tilt_deg",
        Quantity::Sky => "sky",
        Quantity::SkyCctK => "sky_cct_k",
        Quantity::AngleDeg => "angle_deg",
    }
}

fn termination(termination: &Termination) -> Value {
    match termination {
        Termination::Converged { gradient_norm } => {
            json!({ "reason": "converged", "gradient_norm": gradient_norm })
        }
        Termination::IterationLimit => json!({ "reason": "iteration limit" }),
        Termination::NoProgress { gradient_norm } => {
            json!({ "reason": "no progress", "gradient_norm": gradient_norm })
        }
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

fn within(name: &str, facets: &Colours, range: RangeInclusive<f64>) -> Result<()> {
    match facets.iter().flatten().flatten().find(|value| !range.contains(*value)) {
        Some(value) => Err(Error::field(name, format!("{value:e} cannot be the value of a facet"))),
        None => Ok(()),
    }
}
