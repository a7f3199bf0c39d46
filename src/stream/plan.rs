//! The plan record: what estimates from a scene will be worth.

use serde_json::{Map, Value, json};

use super::estimate::fitted_name;
use super::fields::{Fields, finite};
use super::scene::Scene;
use crate::error::Result;
use crate::estimate::Estimate;
use crate::estimate::unknowns::Quantity;

/// Standard deviations of several estimates.
#[derive(Clone, Debug, Default)]
pub struct ExpectedError {
    /// Root mean square over the wavelengths, an estimate each.
    reflectance: Vec<f64>,
    /// Sum of squares of what is fitted along.
    fitted: Vec<(Quantity, f64)>,
}

impl ExpectedError {
    /// Adds what an estimate says of its error.
    pub fn add(&mut self, estimate: &Estimate) {
        let sd = estimate.reflectance_sd().unwrap_or_default();
        let square = sd.iter().map(|sd| sd * sd).sum::<f64>() / sd.len().max(1) as f64;
        self.reflectance.push(square.sqrt());
        for fitted in &estimate.fitted {
            match self.fitted.iter_mut().find(|(quantity, _)| *quantity == fitted.quantity) {
                Some((_, sum)) => *sum += fitted.sd * fitted.sd,
                None => self.fitted.push((fitted.quantity, fitted.sd * fitted.sd)),
            }
        }
    }
}

/// The record of a plan: RMSE to expect of the reflectances of `set`, mean and worst, and the root mean square of the standard
/// deviations of what is fitted along.
///
/// # Errors
/// [`crate::Error::Field`] if a number is not finite or the scene lacks its geometry.
pub fn plan(scene: &Scene, set: &str, noise_sd: f64, expected: &ExpectedError) -> Result<Fields> {
    let count = expected.reflectance.len().max(1) as f64;
    let mean = expected.reflectance.iter().sum::<f64>() / count;
    let worst = expected.reflectance.iter().copied().fold(0.0, f64::max);
    finite("expected_rmse", [&mean, &worst])?;
    let mut fields = Fields::of_kind("plan");
    fields.set("scene", scene.id()?)?;
    if scene.is_fold()? {
        fields.set("angle_deg", scene.fold()?.angle_deg())?;
    }
    fields.set("reflectances", set)?;
    fields.set("samples", expected.reflectance.len())?;
    fields.set("noise_sd", noise_sd)?;
    fields.set("expected_rmse", json!({ "mean": mean, "worst": worst }))?;
    let mut sds = Map::new();
    for (quantity, squares) in &expected.fitted {
        let sd = (squares / count).sqrt();
        finite("expected_sd", [&sd])?;
        sds.insert(fitted_name(*quantity).to_owned(), Value::from(sd));
    }
    if !sds.is_empty() {
        fields.set("expected_sd", sds)?;
    }
    Ok(fields)
}
