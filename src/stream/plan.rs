//! The plan record: the expected accuracy of estimates from a scene.

use schemars::JsonSchema;
use serde::Serialize;

use super::fields::{Fields, finite};
use super::quantities::Quantities;
use super::scene::Scene;
use crate::error::Result;
use crate::estimate::unknowns::Unknown;

/// How accurate estimates of sheets in a scene will be, computed before any photograph is taken.
#[derive(Serialize, JsonSchema)]
#[serde(tag = "kind", rename = "plan")]
#[schemars(extend("x-writer" = "vestimate"))]
pub(super) struct PlanRecord {
    /// Name of the scene.
    scene: String,
    /// Angle between the panels of a fold, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    angle_deg: Option<f64>,
    /// The other picture of the sheet, if two are to be estimated together.
    #[serde(skip_serializing_if = "Option::is_none")]
    with_photograph: Option<WithPhotographRecord>,
    /// Reflectances of the sheets that will be photographed, as `vestimate --reflectance` names them.
    reflectances: String,
    /// Number of these reflectances.
    samples: usize,
    /// Standard deviation of the noise of each facet's value; white is 1.
    #[schemars(range(min = 0))]
    noise_sd: f64,
    /// Expected error of the estimated reflectances, on their scale from 0 to 1: root mean square over the
    /// wavelengths.
    expected_rmse: ExpectedRmse,
    /// Expected standard deviation of each quantity that is fitted together with the reflectance.
    #[serde(skip_serializing_if = "Option::is_none")]
    expected_sd: Option<Quantities<f64>>,
}

/// Another picture of the same sheet.
#[derive(Serialize, JsonSchema)]
struct WithPhotographRecord {
    /// Name of its scene.
    scene: String,
    /// Angle between the panels of its fold, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    angle_deg: Option<f64>,
}

/// Mean and largest error of several reflectances.
#[derive(Serialize, JsonSchema)]
struct ExpectedRmse {
    /// Mean.
    #[schemars(range(min = 0))]
    mean: f64,
    /// Largest.
    #[schemars(range(min = 0))]
    worst: f64,
}

/// A plan for [`plan`].
pub struct NewPlan<'a> {
    /// Angle between the panels of a fold, degrees.
    pub angle_deg: Option<f64>,
    /// The scene of the picture that will be estimated jointly with this one, and the angle of its fold,
    /// degrees.
    pub with_photograph: Option<(&'a Scene, Option<f64>)>,
    /// The reflectances that will be photographed, in the terms of `vestimate --reflectance`.
    pub reflectances: &'a str,
    /// Standard deviation of the noise of each facet's value; white is 1.
    pub noise_sd: f64,
    /// Expected root mean square error of each reflectance.
    pub rmse: &'a [f64],
    /// Expected standard deviations of the fitted unknowns.
    pub fitted_sd: Vec<(&'static Unknown, f64)>,
}

/// The record of a plan: mean and worst expected RMSE of the reflectances, and expected standard deviations
/// of the fitted unknowns.
///
/// # Errors
/// [`crate::Error::Field`] if a number is not finite or the scene has no name.
pub fn plan(scene: &Scene, new: NewPlan) -> Result<Fields> {
    let NewPlan { angle_deg, with_photograph, reflectances, noise_sd, rmse, fitted_sd } = new;
    let mean = rmse.iter().sum::<f64>() / rmse.len().max(1) as f64;
    let worst = rmse.iter().copied().fold(0.0, f64::max);
    finite("expected_rmse", [&mean, &worst])?;
    finite("expected_sd", fitted_sd.iter().map(|(_, sd)| sd))?;
    let with_photograph =
        with_photograph.map(|(scene, angle_deg)| Ok(WithPhotographRecord { scene: scene.id()?, angle_deg }));
    Fields::of(&PlanRecord {
        scene: scene.id()?,
        angle_deg,
        with_photograph: with_photograph.transpose()?,
        reflectances: reflectances.to_owned(),
        samples: rmse.len(),
        noise_sd,
        expected_rmse: ExpectedRmse { mean, worst },
        expected_sd: Quantities::of(fitted_sd),
    })
}
