//! What a sample says of its estimate.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::fields::{Fields, finite};
use super::sample::{ReflectanceRecord, Sample};
use crate::error::Result;
use crate::estimate::unknowns::Quantity;
use crate::estimate::{Estimate, Fitted};
use crate::solve::Termination;
use crate::solve::posterior::Iteration;

impl Sample {
    /// Adds an estimate, with its covariance (waveband by waveband) if asked to.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
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

    /// Whether this is what an estimate, or the attempt of one, made of `measured`.
    #[must_use]
    pub fn is_estimate_of(&self, measured: &Self) -> bool {
        let same = |name: &&str| self.fields.0.get(*name) == measured.fields.0.get(*name);
        let is_done = ["estimate", "error"].iter().any(|name| self.fields.0.contains_key(*name));
        is_done && ["id", "scene", "facet_rgb", "facet_sd", "exposure"].iter().all(same)
    }

    /// Names of the numbers that were to be fitted and of which the facets say nothing.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if what was fitted is not what [`Sample::set_estimate`] writes.
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
    /// [`crate::Error::Field`] if a number is not finite.
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
    /// [`crate::Error::Field`] if `trace` is not a list of objects.
    pub fn take_trace(&mut self) -> Result<Vec<Fields>> {
        let lines: Vec<Map<String, Value>> = self.fields.get("trace")?.unwrap_or_default();
        self.fields.0.remove("trace");
        Ok(lines.into_iter().map(Fields).collect())
    }

    /// The estimated spectrum, on its wavelengths; none if the sample has no estimate.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if it is not a spectrum of numbers from 0 to 1.
    pub fn estimated(&self) -> Result<Option<ReflectanceRecord>> {
        self.reflectance("estimate")
    }

    /// The standard deviation of the estimated spectrum, if there is one.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if it is not a list of numbers.
    pub fn estimated_sd(&self) -> Result<Option<Vec<f64>>> {
        #[derive(Deserialize)]
        struct Deviation {
            reflectance_sd: Option<Vec<f64>>,
        }
        Ok(self.fields.get::<Deviation>("estimate")?.and_then(|estimate| estimate.reflectance_sd))
    }

    /// The covariance of the estimated spectrum, waveband by waveband, if the sample has it.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if it is not a list of rows.
    pub fn estimated_covariance(&self) -> Result<Option<Vec<Vec<f64>>>> {
        #[derive(Deserialize)]
        struct Spread {
            covariance: Option<Vec<Vec<f64>>>,
        }
        Ok(self.fields.get::<Spread>("estimate")?.and_then(|estimate| estimate.covariance))
    }

    /// Residuals of the estimate in units of their expected size, if there is an estimate.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if it is not a number.
    pub fn residual_rms(&self) -> Result<Option<f64>> {
        #[derive(Deserialize)]
        struct Fit {
            residual_rms: f64,
        }
        Ok(self.fields.get::<Fit>("estimate")?.map(|fit| fit.residual_rms))
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
