//! The accuracy with which a scene's bounces are solved.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::BY_VKERNEL;
use crate::error::{Error, Result};
use crate::kernel::mesh::{Accuracy, KernelSource};

/// How well the bounces are solved.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct AccuracyRecord {
    /// Where they are solved, as `vkernel --mesh` names it: auto, facets, `ROWSxCOLS` or `CELLS`.
    mesh: String,
    /// Relative error that facet means were allowed.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    tolerance: f64,
    /// Number of unknowns: of a fold those of one panel.
    unknowns: usize,
    /// Largest error of a facet mean, as estimated, relative to it, on shapes at least to a tenth of the mean
    /// of all; null where no second solution tells.
    #[schemars(range(min = 0))]
    facet_mean_error: Option<f64>,
    /// Residual that Lanczos' method left, relative to the light.
    #[schemars(range(min = 0))]
    residual: f64,
    /// Form factors between flat patches, where the bounces were solved on them.
    #[serde(skip_serializing_if = "Option::is_none")]
    kernel: Option<KernelRecord>,
}

/// How form factors were found.
#[derive(Serialize, Deserialize, JsonSchema)]
struct KernelRecord {
    /// As `vkernel --method` names it: exact, monte-carlo or midpoint.
    method: String,
    /// As `vkernel --sampling` names it: area or cosine.
    #[serde(skip_serializing_if = "Option::is_none")]
    sampling: Option<String>,
    /// Pairs of points a distinct entry, or rays a row of facets.
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
