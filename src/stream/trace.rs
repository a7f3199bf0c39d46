//! `vestimate --trace`: the iterations of every estimate, one record each.

use schemars::JsonSchema;
use serde::Serialize;

use super::fields::{Fields, finite};
use crate::error::Result;
use crate::solve::posterior::Iteration;

/// One iteration of an estimate, at its beginning; `vestimate --trace FILE` writes them.
#[derive(Serialize, JsonSchema)]
#[serde(tag = "kind", rename = "iteration")]
#[schemars(extend("x-writer" = "vestimate"))]
pub(super) struct IterationRecord {
    /// Name of the sample.
    sample: String,
    /// Number of the search: 0 takes all spectra of the prior as one Gaussian, each later one takes one class
    /// of them.
    run: usize,
    /// Number of the iteration in its run, from 0.
    iteration: usize,
    /// What is minimised: the sum of the squares of residuals and unknowns, both in units of their standard
    /// deviations.
    #[schemars(range(min = 0))]
    cost: f64,
    /// Norm of the gradient of `cost` in the metric of its Hessian; it falls to about 0 at the minimum.
    #[schemars(range(min = 0))]
    gradient_norm: f64,
    /// Damping of Newton's method with which the iteration tried its first step.
    #[schemars(range(min = 0))]
    damping: f64,
    /// Factor, from 1, by which the noise is taken to be larger than it is, so that the data bind less at
    /// first.
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
