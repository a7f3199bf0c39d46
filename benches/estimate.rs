//! Time of one estimate in process, one thread, for the samples on standard input:
//!
//! `vkernel | vforward --reflectance cc24 --noise-sd 1e-3 | cargo bench --bench estimate`

#![allow(clippy::print_stdout, reason = "a measurement for the reader of a terminal")]

use std::hint::black_box;
use std::time::{Duration, Instant};

use vfold::estimate::data::{FacetData, Measured};
use vfold::estimate::prior::Prior;
use vfold::estimate::unknowns::SceneModel;
use vfold::estimate::{Exposure, classes, map};
use vfold::spectrum::{Outside, reflectances};
use vfold::stream::{Colours, Reader, Record};
use vfold::{Error, Result};

/// Facets without a standard deviation are computed ones: what rounding leaves, relative to white.
const ROUNDING: f64 = 1e-6;
/// Each estimate is made that often; the fastest counts.
const REPEATS: usize = 5;

fn main() -> Result<()> {
    let mut reader = Reader::open("-")?;
    let (mut scene, mut times, mut iterations) = (None, Vec::new(), Vec::new());
    while let Some(record) = reader.read()? {
        match record {
            Record::Scene(line) => {
                let grid = line.grid()?;
                let chips = reflectances("munsell")?;
                let chips: Vec<_> =
                    chips.iter().map(|chip| chip.on(&grid, Outside::Refuse)).collect::<Result<_>>()?;
                let prior = Prior::from_spectra(grid.wavelengths_nm(), &chips, Some(&classes::of_munsell()))?;
                scene = Some((SceneModel::known(line.model()?), prior));
            }
            Record::Sample(sample) => {
                let Some((model, prior)) = &scene else { return Err(Error::Numeric("no scene".to_owned())) };
                let rgb = sample.facet_rgb()?;
                let sd = sample.facet_sd()?.unwrap_or_else(|| rounding(&rgb));
                let measured = Measured { rgb: &rgb, sd: &sd };
                let exposure = sample.exposure()?.map_or(Exposure::Free, Exposure::Known);
                let mut best = [Duration::MAX; 2];
                for _ in 0..REPEATS {
                    let start = Instant::now();
                    let data = FacetData::new(model, &measured, exposure, 1e-2)?;
                    let compressed = start.elapsed();
                    let estimate = black_box(map::estimate(&data, prior, None));
                    best = [best[0].min(compressed), best[1].min(start.elapsed())];
                    iterations.push(estimate.iterations);
                }
                times.push(best);
            }
            Record::Other(_) => {}
        }
    }
    iterations.sort_unstable();
    let middle = |mut times: Vec<Duration>| {
        times.sort_unstable();
        times.get(times.len() / 2).map_or(f64::NAN, |time| time.as_secs_f64() * 1e3)
    };
    println!("samples                {}", times.len());
    println!("compression, median ms {:.3}", middle(times.iter().map(|time| time[0]).collect()));
    println!("estimate, median ms    {:.3}", middle(times.iter().map(|time| time[1]).collect()));
    println!("iterations, median     {}", iterations.get(iterations.len() / 2).copied().unwrap_or(0));
    Ok(())
}

fn rounding(rgb: &Colours) -> Colours {
    let sd = ROUNDING * rgb.iter().flatten().flatten().copied().fold(0.0, f64::max);
    rgb.iter().map(|facet| facet.as_ref().map(|values| vec![sd; values.len()])).collect()
}
