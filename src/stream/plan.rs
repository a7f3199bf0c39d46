//! The plan record: what estimates from a scene will be worth.

use schemars::JsonSchema;
use serde::Serialize;

use super::fields::{Fields, finite};
use super::fit::Fit;
use super::scene::Scene;
use crate::error::Result;
use crate::estimate::Estimate;
use crate::estimate::unknowns::Unknown;

/// What estimates of a scene's samples will be worth, before any is taken.
#[derive(Serialize, JsonSchema)]
#[serde(tag = "kind", rename = "plan")]
#[schemars(extend("x-writer" = "vestimate"))]
pub(super) struct PlanRecord {
    /// Name of the scene.
    scene: String,
    /// Angle between the panels of a fold, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    angle_deg: Option<f64>,
    /// The reflectances that will be photographed, as `vestimate --reflectance` names them.
    reflectances: String,
    /// Number of them.
    samples: usize,
    /// Standard deviation of every facet's value, white being 1.
    #[schemars(range(min = 0))]
    noise_sd: f64,
    /// Root mean square error over the wavelengths to expect of the reflectances.
    expected_rmse: ExpectedRmse,
    /// Standard deviation to expect of what is fitted along.
    #[serde(skip_serializing_if = "Option::is_none")]
    expected_sd: Option<Fit<f64>>,
}

/// Of several reflectances.
#[derive(Serialize, JsonSchema)]
struct ExpectedRmse {
    /// Mean.
    #[schemars(range(min = 0))]
    mean: f64,
    /// Largest.
    #[schemars(range(min = 0))]
    worst: f64,
}

/// Standard deviations of several estimates.
#[derive(Clone, Debug, Default)]
pub struct ExpectedError {
    /// Root mean square over the wavelengths, an estimate each.
    reflectance: Vec<f64>,
    /// Sum of squares of what is fitted along.
    fitted: Vec<(&'static Unknown, f64)>,
}

impl ExpectedError {
    /// Adds what an estimate says of its error.
    pub fn add(&mut self, estimate: &Estimate) {
        let sd = estimate.reflectance_sd().unwrap_or_default();
        let square = sd.iter().map(|sd| sd * sd).sum::<f64>() / sd.len().max(1) as f64;
        self.reflectance.push(square.sqrt());
        for fitted in &estimate.fitted {
            match self.fitted.iter_mut().find(|(unknown, _)| *unknown == fitted.unknown) {
                Some((_, sum)) => *sum += fitted.sd * fitted.sd,
                None => self.fitted.push((fitted.unknown, fitted.sd * fitted.sd)),
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
    let sds: Vec<_> = expected.fitted.iter().map(|(of, squares)| (*of, (squares / count).sqrt())).collect();
    finite("expected_sd", sds.iter().map(|(_, sd)| sd))?;
    Fields::of(&PlanRecord {
        scene: scene.id()?,
        angle_deg: if scene.is_fold()? { Some(scene.fold()?.angle_deg()) } else { None },
        reflectances: set.to_owned(),
        samples: expected.reflectance.len(),
        noise_sd,
        expected_rmse: ExpectedRmse { mean, worst },
        expected_sd: Fit::of(sds),
    })
}
