//! How many classes the prior needs: mean RMSE of the samples on standard input, which carry their true reflectance, with the
//! Munsell chips in 1, 2, 4 and 8 classes. `benches/priors.sh` makes the table of `docs/priors.md` of it.

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
    let chips = batch.chips()?;
    // The built-in classes, and those joined again that were halved last.
    let means = [3, 2, 1, 0].map(|joins| {
        let classes: Vec<usize> = classes::of_munsell().iter().map(|class| class >> joins).collect();
        let prior = Prior::from_spectra(batch.grid.wavelengths_nm(), &chips, Some(&classes))?;
        mean_rmse(&batch, &prior)
    });
    let means = means.into_iter().collect::<Result<Vec<f64>>>()?;
    println!("{}", means.iter().map(|mean| format!("{mean:.4}")).collect::<Vec<_>>().join(" | "));
    Ok(())
}

fn mean_rmse(batch: &Batch, prior: &Prior) -> Result<f64> {
    let error = |shot: &samples::Shot| {
        Ok(rmse(&shot.truth, &map::estimate(&shot.data(&batch.scene)?, prior, None).reflectance))
    };
    let sum: f64 = batch.shots.iter().map(error).sum::<Result<f64>>()?;
    Ok(sum / batch.shots.len() as f64)
}
