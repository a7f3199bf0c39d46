//! How many classes the prior needs: mean RMSE of the samples on standard input, which carry their true reflectance, with the
//! Munsell chips in 1, 2, 4 and 8 classes. `benches/priors.sh` makes the table of `docs/priors.md` of it.

#![allow(clippy::print_stdout, reason = "a measurement for the reader of a terminal")]

use vfold::estimate::data::{FacetData, Measured};
use vfold::estimate::noise::{deviations, unexplained};
use vfold::estimate::prior::Prior;
use vfold::estimate::unknowns::SceneModel;
use vfold::estimate::{Exposure, classes, map};
use vfold::spectrum::{Outside, WavelengthGrid, reflectances};
use vfold::stream::{Reader, Record, Sample};
use vfold::{Error, Result};

fn main() -> Result<()> {
    let mut reader = Reader::open("-")?;
    let (mut scene, mut squares) = (None, [0.0; 4]);
    let mut count = 0.0;
    while let Some(record) = reader.read()? {
        match (record, &scene) {
            (Record::Scene(line), _) => {
                scene = Some((SceneModel::known(line.model()?), priors(&line.grid()?)?));
            }
            (Record::Sample(sample), Some((scene, priors))) => {
                count += 1.0;
                for (sum, prior) in squares.iter_mut().zip(priors) {
                    *sum += rmse(scene, prior, &sample)?;
                }
            }
            _ => {}
        }
    }
    println!("{}", squares.map(|sum| format!("{:.4}", sum / count)).join(" | "));
    Ok(())
}

/// The Munsell chips in 1, 2, 4 and 8 classes: the built-in ones, and those joined again that were halved last.
fn priors(grid: &WavelengthGrid) -> Result<Vec<Prior>> {
    let chips = reflectances("munsell")?;
    let chips: Vec<_> = chips.iter().map(|chip| chip.on(grid, Outside::Refuse)).collect::<Result<_>>()?;
    let joined = |joins: u32| classes::of_munsell().iter().map(|class| class >> joins).collect::<Vec<_>>();
    [3, 2, 1, 0]
        .map(|joins| Prior::from_spectra(grid.wavelengths_nm(), &chips, Some(&joined(joins))))
        .into_iter()
        .collect()
}

fn rmse(scene: &SceneModel, prior: &Prior, sample: &Sample) -> Result<f64> {
    let rgb = sample.facet_rgb()?;
    let said = sample.facet_sd()?;
    let noise = unexplained(scene.facets(), &rgb);
    let noise_sd = |facet: usize, channel: usize| match &said {
        Some(said) => said[facet].as_ref().map_or(0.0, |sd| sd[channel]),
        None => noise[channel],
    };
    let sd = deviations(&rgb, noise_sd, 0.0);
    let exposure = sample.exposure()?.map_or(Exposure::Free, Exposure::Known);
    let data = FacetData::new(scene, &Measured { rgb: &rgb, sd: &sd }, exposure, 1e-2)?;
    let estimate = map::estimate(&data, prior, None);
    let truth = sample.truth()?.ok_or_else(|| Error::field("truth", "missing; vforward adds it"))?;
    let squares = estimate.reflectance.iter().zip(&truth.reflectance).map(|(a, b)| (a - b).powi(2));
    Ok((squares.sum::<f64>() / truth.reflectance.len() as f64).sqrt())
}
