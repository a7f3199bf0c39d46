//! `vestimate --trace`: the iterations of every estimate, a record each.

use schemars::JsonSchema;
use serde::Serialize;

use super::Sample;
use super::fields::{Fields, finite};
use crate::error::Result;
use crate::solve::posterior::Iteration;

/// An iteration of an estimate, as it began; in the file of `vestimate --trace`.
#[derive(Serialize, JsonSchema)]
#[serde(tag = "kind", rename = "iteration")]
#[schemars(extend("x-writer" = "vestimate"))]
pub(super) struct IterationRecord {
    /// Name of the sample.
    sample: String,
    /// 0 under all spectra of the prior as one Gaussian, the others each under a class of them.
    run: usize,
    /// Number of the iteration in its run, from 0.
    iteration: usize,
    /// Sum of the squares of residuals and unknowns, both in units of their standard deviations.
    #[schemars(range(min = 0))]
    cost: f64,
    /// Norm of its gradient in the metric of the Hessian.
    #[schemars(range(min = 0))]
    gradient_norm: f64,
    /// Damping of the first trial.
    #[schemars(range(min = 0))]
    damping: f64,
    /// Factor by which the noise is taken to be larger than it is.
    #[schemars(range(min = 0))]
    noise: f64,
}

impl Sample {
    /// Adds the iterations that led to an estimate, for [`Sample::take_trace`].
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn set_trace(&mut self, trace: &[Vec<Iteration>]) -> Result<()> {
        let sample = self.id();
        let mut records = Vec::new();
        for (run, iterations) in trace.iter().enumerate() {
            for (iteration, &Iteration { cost, gradient_norm, damping, inflation: noise }) in
                iterations.iter().enumerate()
            {
                finite("trace", &[cost, gradient_norm, damping, noise])?;
                let sample = sample.clone();
                records.push(IterationRecord { sample, run, iteration, cost, gradient_norm, damping, noise });
            }
        }
        self.fields.set("trace", records)
    }

    /// Takes the iterations out, a record each.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if `trace` is not a list of objects.
    pub fn take_trace(&mut self) -> Result<Vec<Fields>> {
        let records = self.fields.get("trace")?.unwrap_or_default();
        self.fields.remove("trace");
        Ok(records)
    }
}
