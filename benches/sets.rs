//! What estimates of many sheets are worth, their exposure known and free: how near they are, how often
//! error bars hold the truth, how many end in a false maximum, and how long they take on one thread: mean,
//! median, 95th percentile and worst.
//!
//! `cargo bench --bench sets -- [--maxima] STREAM...` prints a row of a table for the samples of all streams
//! together, which carry their true reflectance; with `--maxima` every sample is estimated from the truth,
//! too. `cargo bench --bench sets -- --spectra COUNT` prints spectra that no chart has. `benches/sets.sh`
//! makes a page of it.

#![allow(clippy::print_stdout, reason = "a measurement for the reader of a terminal")]
#![allow(clippy::unwrap_used, reason = "a benchmark stops at the first surprise")]

#[allow(dead_code, reason = "other benchmarks use the rest")]
mod common;
#[path = "common/many_spectra.rs"]
mod many_spectra;
#[allow(dead_code, reason = "other benchmarks use the rest")]
#[path = "common/samples.rs"]
mod samples;

use common::timed_once;
use many_spectra::many_spectra;
use samples::Batch;
use vfold::estimate::prior::Prior;
use vfold::estimate::{Estimate, Exposure, map};
use vfold::score::rmse;
use vfold::{Error, Result};

/// The fastest of so many runs is the time of an estimate.
const RUNS: usize = 3;
/// A maximum is false if it is further from the truth than the one that the truth leads to, by so much and so
/// many times.
const FURTHER: (f64, f64) = (0.01, 2.0);
/// Parts of the spectrum, nm.
const PARTS: [(f64, f64); 3] = [(0.0, f64::MAX), (0.0, 420.0), (680.0, f64::MAX)];

/// What is counted of all estimates of a row.
#[derive(Default)]
struct Row {
    errors: Vec<f64>,
    /// By part: wavebands, those within one and within two standard deviations.
    held: [[usize; 3]; PARTS.len()],
    false_maxima: usize,
    times_ms: Vec<f64>,
}

fn main() -> Result<()> {
    common::on_one_thread();
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench").peekable();
    if arguments.next_if(|argument| argument == "--spectra").is_some() {
        let count = arguments.next().and_then(|count| count.parse().ok());
        let count =
            count.ok_or_else(|| Error::Numeric("no number of spectra; write one after --spectra".into()))?;
        print!("{}", many_spectra(count));
        return Ok(());
    }
    let counts_maxima = arguments.next_if(|argument| argument == "--maxima").is_some();
    let mut row = Row::default();
    for stream in arguments {
        row.add(&Batch::read(&stream)?, counts_maxima)?;
    }
    row.print(counts_maxima);
    Ok(())
}

impl Row {
    fn add(&mut self, batch: &Batch, counts_maxima: bool) -> Result<()> {
        let nm = batch.grid.wavelengths_nm();
        let prior = Prior::built_in(nm)?;
        for shot in &batch.shots {
            for exposure in [shot.exposure, Exposure::Free] {
                let shot = shot.clone().with_exposure(exposure);
                let data = shot.data(&batch.scene)?;
                let runs = (0..RUNS).map(|_| timed_once(|| map::estimate(&data, &prior, None).unwrap()));
                let Some((ms, estimate)) = runs.min_by(|(a, _), (b, _)| a.total_cmp(b)) else { continue };
                self.times_ms.push(ms);
                let error = rmse(&shot.truth, &estimate.reflectance);
                self.errors.push(error);
                self.hold(nm, &shot.truth, &estimate);
                if counts_maxima {
                    let from_truth = map::estimate(&data, &prior, Some(&shot.truth)).unwrap();
                    let least = rmse(&shot.truth, &from_truth.reflectance);
                    self.false_maxima += usize::from(error > least + FURTHER.0 && error > least * FURTHER.1);
                }
            }
        }
        Ok(())
    }

    fn hold(&mut self, nm: &[f64], truth: &[f64], estimate: &Estimate) {
        for (band, truth) in truth.iter().enumerate() {
            let off = (truth - estimate.reflectance[band]).abs();
            let sd = estimate.spread.as_ref().map_or(f64::INFINITY, |spread| spread.column(band).norm());
            for ((first, last), held) in PARTS.iter().zip(&mut self.held) {
                if (first..=last).contains(&&nm[band]) {
                    held[0] += 1;
                    held[1] += usize::from(off < sd);
                    held[2] += usize::from(off < 2.0 * sd);
                }
            }
        }
    }

    fn print(mut self, counts_maxima: bool) {
        let count = self.errors.len();
        let mean = self.errors.iter().sum::<f64>() / count as f64;
        let share = |part: usize, sds: usize| 100.0 * self.held[part][sds] as f64 / self.held[part][0] as f64;
        let held: Vec<_> =
            (0..PARTS.len()).map(|part| format!("{:.0} / {:.0}", share(part, 1), share(part, 2))).collect();
        self.times_ms.sort_by(f64::total_cmp);
        let mean_ms = self.times_ms.iter().sum::<f64>() / count as f64;
        let [median, high, most] = [count / 2, 95 * count / 100, count - 1].map(|n| self.times_ms[n]);
        let maxima = if counts_maxima { self.false_maxima.to_string() } else { String::new() };
        println!(
            "{count} | {mean:.4} | {} | {maxima} | {mean_ms:.2} | {median:.2} | {high:.1} | {most:.1}",
            held.join(" | ")
        );
    }
}
