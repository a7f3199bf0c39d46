//! The accuracy with which a scene's bounces are solved.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::BY_VKERNEL;
use crate::error::{Error, Result};
use crate::kernel::mesh::{Accuracy, KernelSource};

/// The method of form factors without sampling.
const EXACT: &str = "exact";

/// How accurately the bounces were solved.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct AccuracyRecord {
    /// The mesh on which they were solved, as `vkernel --mesh` names it: auto, facets, `ROWSxCOLS` or
    /// `CELLS`.
    mesh: String,
    /// Largest relative error that was allowed for the mean over a facet.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    tolerance: f64,
    /// Number of unknowns of the solution; of a fold those of one panel.
    unknowns: usize,
    /// Largest relative error of the mean over a facet, as estimated; on shapes, relative to at least a tenth
    /// of the mean of all facets. Null if there was no second solution to compare with.
    #[schemars(range(min = 0))]
    facet_mean_error: Option<f64>,
    /// Residual left by Lanczos' method, relative to the light.
    #[schemars(range(min = 0))]
    residual: f64,
    /// Form factors between flat patches, where the bounces were solved on them.
    #[serde(skip_serializing_if = "Option::is_none")]
    kernel: Option<KernelRecord>,
}

/// How form factors were computed.
#[derive(Serialize, Deserialize, JsonSchema)]
struct KernelRecord {
    /// The method, as `vkernel --method` names it: exact, monte-carlo or midpoint.
    method: String,
    /// What was sampled, as `vkernel --sampling` names it: area or cosine.
    #[serde(skip_serializing_if = "Option::is_none")]
    sampling: Option<String>,
    /// Number of pairs of points for each distinct form factor, or of rays for each row of facets.
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<u32>,
    /// Seed of the samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    /// Largest standard error of a form factor.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    entry_sd: Option<f64>,
}

impl AccuracyRecord {
    fn new(mesh: &str, tolerance: f64, accuracy: &Accuracy) -> Self {
        Self {
            mesh: mesh.to_owned(),
            tolerance,
            unknowns: accuracy.unknowns,
            facet_mean_error: accuracy.facet_mean_error,
            residual: accuracy.residual,
            kernel: accuracy.kernel.as_ref().map(KernelRecord::from),
        }
    }
}

impl From<&KernelSource> for KernelRecord {
    fn from(source: &KernelSource) -> Self {
        Self {
            method: source.method.to_owned(),
            sampling: source.samples.map(|samples| samples.sampling.to_owned()),
            samples: source.samples.map(|samples| samples.count),
            seed: source.samples.map(|samples| samples.seed),
            entry_sd: source.entry_sd,
        }
    }
}

impl Scene {
    /// Records the accuracy of the response and its mesh.
    ///
    /// # Errors
    /// As [`Fields::set`](super::Fields::set).
    pub fn set_accuracy(&mut self, mesh: &str, tolerance: f64, accuracy: &Accuracy) -> Result<()> {
        self.fields.set("accuracy", AccuracyRecord::new(mesh, tolerance, accuracy))
    }

    /// Whether the scene records how its bounces were solved.
    #[must_use]
    pub fn has_accuracy(&self) -> bool {
        self.fields.has("accuracy")
    }

    fn accuracy(&self) -> Result<AccuracyRecord> {
        self.fields.require("accuracy", BY_VKERNEL)
    }

    /// The mesh on which the bounces were solved, in the terms of `vkernel --mesh`.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not there.
    pub fn mesh(&self) -> Result<String> {
        Ok(self.accuracy()?.mesh)
    }

    /// Whether form factors are exact to the tolerance: the scene says so, and none was sampled.
    ///
    /// # Errors
    /// [`Error::Field`] if the record of the accuracy is not one.
    pub fn has_exact_form_factors(&self) -> Result<bool> {
        if !self.has_accuracy() {
            return Ok(false);
        }
        Ok(self.accuracy()?.kernel.is_none_or(|kernel| kernel.method == EXACT))
    }

    /// Number of unknowns with which the bounces were solved.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not there.
    pub fn unknowns(&self) -> Result<usize> {
        Ok(self.accuracy()?.unknowns)
    }

    /// Tolerance for the relative error of the response.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not there or not between 0 and 1.
    pub fn tolerance(&self) -> Result<f64> {
        match self.accuracy()?.tolerance {
            tolerance if tolerance > 0.0 && tolerance < 1.0 => Ok(tolerance),
            tolerance => {
                Err(Error::field("accuracy.tolerance", format!("{tolerance} is not between 0 and 1")))
            }
        }
    }
}
