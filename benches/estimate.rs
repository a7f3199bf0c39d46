//! Time beside error of the estimates of the samples on standard input, which carry their true reflectance;
//! one thread. Prints a row of a table: mean RMSE, mean CIEDE2000 (10°, D65), times of an estimate and mean
//! iterations, for the default estimator and then for the paper's with the weight of smoothness given:
//!
//! `vkernel | vforward --reflectance cc24 --noise-sd 1e-3 | cargo bench --bench estimate -- 1e-3`
//!
//! `benches/estimates.sh` makes a table of such rows.

#![allow(clippy::print_stdout, reason = "a measurement for the reader of a terminal")]
#![allow(clippy::unwrap_used, reason = "a benchmark stops at the first surprise")]

#[allow(dead_code, reason = "other benchmarks use the rest")]
mod common;
#[allow(dead_code, reason = "other benchmarks use the rest")]
#[path = "common/samples.rs"]
mod samples;

use common::timed;
use samples::{Batch, Shot};
use vfold::colorimetry::{Colorimeter, Observer};
use vfold::estimate::prior::Prior;
use vfold::estimate::{Estimate, map};
use vfold::paper::smooth;
use vfold::score::rmse;
use vfold::spectrum::illuminant;
use vfold::{Error, Result};

fn main() -> Result<()> {
    common::on_one_thread();
    let smoothness: f64 = std::env::args()
        .find_map(|argument| argument.parse().ok())
        .ok_or_else(|| Error::Numeric("no weight of smoothness; write one after --".to_owned()))?;
    let batch = Batch::read("-")?;
    let prior = Prior::built_in(batch.grid.wavelengths_nm())?;
    let default = row(&batch, |shot| map::estimate(&shot.data(&batch.scene)?, &prior, None))?;
    let grey = vec![0.5; batch.grid.len()];
    let papers = row(&batch, |shot| smooth::estimate(&shot.unweighted(&batch.scene)?, smoothness, &grey))?;
    println!("{default} | {papers}");
    Ok(())
}

/// Scores and times one estimator.
fn row(batch: &Batch, estimate: impl Fn(&Shot) -> Result<Estimate>) -> Result<String> {
    let d65 = Colorimeter::new(&batch.grid, &illuminant("D65")?, Observer::Cie1964_10deg)?;
    let (mut times, mut iterations, mut scores) = (Vec::new(), Vec::new(), [0.0; 2]);
    for shot in &batch.shots {
        let (ms, made) = timed(|| estimate(shot));
        let made = made?;
        times.push(ms);
        iterations.push(f64::from(made.iterations));
        scores[0] += rmse(&shot.truth, &made.reflectance);
        scores[1] += d65.delta_e_2000(&shot.truth, &made.reflectance);
    }
    let mean = |sum: f64| sum / batch.shots.len() as f64;
    let [rmse, delta_e] = scores.map(mean);
    let iterations = mean(iterations.iter().sum());
    Ok(format!("{rmse:.4} | {delta_e:.3} | {} | {iterations:.0}", spread_of(times)))
}

/// Mean, median, 95th percentile and worst.
fn spread_of(mut times: Vec<f64>) -> String {
    times.sort_by(f64::total_cmp);
    let mean = times.iter().sum::<f64>() / times.len() as f64;
    let at = |share: f64| times[(share * (times.len() - 1) as f64).round() as usize];
    format!("{mean:.2} / {:.2} / {:.2} / {:.1}", at(0.5), at(0.95), at(1.0))
}
