//! The record of a sample's calibration by a chart or a white card.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fields::finite;
use super::{Corners, Sample};
use crate::calibrate::{Calibration, Patch};
use crate::error::Result;

/// How a photograph's values were converted to those of the scene's camera.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct CalibrationRecord {
    /// What the photograph was calibrated with: chart or white card.
    by: &'static str,
    /// Rows and columns of its patches.
    grid: [usize; 2],
    /// Cosine of the angle between the direction to the sun and the normal of the chart or card.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    cos: f64,
    /// Its four corners, [x, y] each, in pixels of the upright picture.
    corners: [[f64; 2]; 4],
    /// Probability that the corners are right, if the chart was detected rather than marked.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0, max = 1)))]
    detection_confidence: Option<f64>,
    /// Exposure that follows from it: value of a perfect white diffuser that faces the sun.
    #[schemars(extend("exclusiveMinimum" = 0))]
    exposure: f64,
    /// Standard deviation of the exposure.
    #[schemars(range(min = 0))]
    exposure_sd: f64,
    /// Constant, linear and quadratic coefficients of each channel, which convert the photograph's values to
    /// those of the camera.
    coefficients: Vec<[f64; 3]>,
    /// Root mean square of the patches' residuals, one per channel.
    #[schemars(inner(range(min = 0)))]
    residual_rms: Vec<f64>,
    /// The patches, row by row.
    patches: Vec<PatchRecord>,
}

/// A patch of known reflectance.
#[derive(Clone, Debug, Serialize, JsonSchema)]
struct PatchRecord {
    /// Name.
    name: String,
    /// Value in the photograph before calibration, one per channel.
    measured: Vec<f64>,
    /// Value in the scene's camera at exposure 1, one per channel.
    expected: Vec<f64>,
    /// Error of the calibrated value, relative to the expected value, one per channel.
    residual: Vec<f64>,
}

impl CalibrationRecord {
    /// The record of a calibration by `patches` in `grid` rows and columns between `corners`, px, whose
    /// normal is at an angle of cosine `cos` to the sun; `by` names the target.
    #[must_use]
    pub fn new(
        by: &'static str,
        (grid, cos, corners): ([usize; 2], f64, Corners),
        calibration: &Calibration,
        patches: &[Patch],
    ) -> Self {
        let patch = |patch: &Patch| PatchRecord {
            name: patch.name.clone(),
            measured: patch.measured.clone(),
            expected: patch.expected.clone(),
            residual: calibration.residual(patch),
        };
        let residual_rms = calibration.residual_rms(patches);
        Self {
            by,
            grid,
            cos,
            corners: corners.map(|corner| [corner.x, corner.y]),
            detection_confidence: None,
            exposure: calibration.exposure(),
            exposure_sd: calibration.exposure_sd(),
            coefficients: (0..residual_rms.len()).map(|channel| calibration.coefficients(channel)).collect(),
            residual_rms,
            patches: patches.iter().map(patch).collect(),
        }
    }
}

impl CalibrationRecord {
    /// The record with the probability that a detected chart is right; none for a stated one.
    #[must_use]
    pub fn with_confidence(mut self, confidence: Option<f64>) -> Self {
        self.detection_confidence = confidence;
        self
    }

    /// Root mean square of the patches' residuals in the channel where it is largest.
    #[must_use]
    pub fn residual(&self) -> f64 {
        largest(&self.residual_rms)
    }
}

/// One line for users.
impl fmt::Display for CalibrationRecord {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let percent = |residual: &f64| format!("{:.2} %", 100.0 * residual);
        let rms: Vec<_> = self.residual_rms.iter().map(percent).collect();
        write!(f, "{}: exposure {:.4} ± {:.4}", self.by, self.exposure, self.exposure_sd)?;
        if self.patches.len() == 1 {
            return Ok(());
        }
        write!(f, ", residuals {}", rms.join(", "))?;
        let worst = |patch: &PatchRecord| patch.residual.iter().fold(0.0, |most: f64, r| most.max(r.abs()));
        match self.patches.iter().max_by(|a, b| worst(a).total_cmp(&worst(b))) {
            Some(patch) => write!(f, " (most {} in {})", percent(&worst(patch)), patch.name),
            None => Ok(()),
        }
    }
}

impl Sample {
    /// Records how the facets were calibrated, and sets the resulting exposure.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn set_calibration(&mut self, record: &CalibrationRecord) -> Result<()> {
        let coefficients = record.coefficients.iter().flatten();
        finite("calibration", coefficients.chain([&record.exposure, &record.exposure_sd]))?;
        self.fields.set("calibration", record)?;
        self.fields.set("exposure", record.exposure)
    }

    /// Root mean square of the residuals of a chart's patches, relative to what they should be, in the
    /// channel where it is largest; 0 if the record does not say, `None` without a chart or a card.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if residuals are not numbers.
    pub fn chart_residual(&self) -> Result<Option<f64>> {
        let chart: Option<Residuals> = self.fields.get("calibration")?;
        Ok(chart.map(|chart| largest(&chart.residual_rms)))
    }
}

/// What is read of a [`CalibrationRecord`].
#[derive(Deserialize)]
struct Residuals {
    #[serde(default)]
    residual_rms: Vec<f64>,
}

fn largest(residuals: &[f64]) -> f64 {
    residuals.iter().copied().fold(0.0, f64::max)
}
