//! What the prior is worth: mean RMSE of the samples on standard input, which carry their true reflectance,
//! with the Munsell chips alone and with all classes of the built-in prior. `benches/priors.sh` makes a table
//! of it.

#![allow(clippy::print_stdout, reason = "a measurement for the reader of a terminal")]

#[allow(dead_code, reason = "another benchmark uses the rest")]
#[path = "common/samples.rs"]
mod samples;

use samples::Batch;
use vfold::Result;
use vfold::estimate::prior::Prior;
use vfold::estimate::{classes, map};
use vfold::score::rmse;

fn main() -> Result<()> {
    let batch = Batch::read("-")?;
    let nm = batch.grid.wavelengths_nm();
    let chips = Prior::from_spectra(nm, &batch.chips()?, Some(&classes::of_munsell()))?;
    let means = [mean_rmse(&batch, &chips)?, mean_rmse(&batch, &Prior::built_in(nm)?)?];
    println!("{}", means.map(|mean| format!("{mean:.4}")).join(" | "));
    Ok(())
}

fn mean_rmse(batch: &Batch, prior: &Prior) -> Result<f64> {
    let error = |shot: &samples::Shot| {
        Ok(rmse(&shot.truth, &map::estimate(&shot.data(&batch.scene)?, prior, None)?.reflectance))
    };
    let sum: f64 = batch.shots.iter().map(error).sum::<Result<f64>>()?;
    Ok(sum / batch.shots.len() as f64)
}
