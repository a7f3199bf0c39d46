//! `vestimate --trace`: the iterations of every estimate, one record each.

use schemars::JsonSchema;
use serde::Serialize;

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

/// The iterations that led to the estimate of a `sample`, one record each.
///
/// # Errors
/// [`crate::Error::Field`] if a number is not finite.
pub fn trace(sample: &str, runs: &[Vec<Iteration>]) -> Result<Vec<Fields>> {
    let mut records = Vec::new();
    for (run, iterations) in runs.iter().enumerate() {
        for (iteration, &Iteration { cost, gradient_norm, damping, tempering: noise }) in
            iterations.iter().enumerate()
        {
            finite("trace", &[cost, gradient_norm, damping, noise])?;
            let sample = sample.to_owned();
            let record = IterationRecord { sample, run, iteration, cost, gradient_norm, damping, noise };
            records.push(Fields::of(&record)?);
        }
    }
    Ok(records)
}
