//! The effect of the numbers in the priors on photographs: the error of estimates, and how well the posterior
//! predicts the truth.
//!
//! `cargo bench --bench photograph_priors -- STREAM...` prints one table row per number, for photographs that
//! carry their true reflectance; a measured sheet is left out of the priors where the stream has its name.
//! With `--fit [NAME[=VALUE]...]` it changes all numbers, or those named, one after the other by a quarter as
//! long as the score rises, from their usual or the stated values, and prints those that changed.
//! `benches/photograph_priors.sh` makes the streams.

#![allow(clippy::print_stdout, reason = "a measurement for the reader of a terminal")]
#![allow(clippy::unwrap_used, reason = "a benchmark stops at the first surprise")]

use rayon::prelude::*;
use vfold::estimate::measured::Measured;
use vfold::estimate::photograph;
use vfold::estimate::photograph::priors::Priors;
use vfold::estimate::prior::Prior;
use vfold::forward::FacetValues;
use vfold::scene::{FoldSetting, PhotographedFold, Picture};
use vfold::sheet::measured_names;
use vfold::stream::{Reader, Record, Sample};
use vfold::{Error, Result};

/// A truth further off than so many standard deviations counts as one that far: a posterior is not judged by
/// one waveband.
const FURTHEST: f64 = 7.0;
/// What a fit changes a number by, and the least that it has to gain.
const STEP: f64 = 1.25;
const LEAST_GAIN: f64 = 1e-3;

/// A photograph of a sheet that is known.
struct Known {
    setting: FoldSetting,
    sample: Sample,
    rgb: FacetValues,
    sd: FacetValues,
    wavelengths_nm: Vec<f64>,
    prior: Prior,
    /// Wavebands in which the truth is known, and the reflectance there.
    truth: Vec<(usize, f64)>,
    /// The measured sheet that it is of, which nobody is to know.
    left_out: Option<String>,
}

/// How good estimates are, in the mean over photographs.
#[derive(Clone, Copy)]
struct Quality {
    score: f64,
    rmse: f64,
    within_two_sd: f64,
}

impl Known {
    fn read(path: &str) -> Result<Self> {
        let mut reader = Reader::open(path)?;
        let (Some(Record::Scene(scene)), Some(Record::Sample(sample))) = (reader.read()?, reader.read()?)
        else {
            return Err(Error::Numeric(format!("{path}: no scene with a sample")));
        };
        let missing = |field| Error::field(field, format!("missing in {path}"));
        let wavelengths_nm = scene.grid()?.wavelengths_nm().to_vec();
        let truth = sample.truth()?.ok_or_else(|| missing("truth"))?;
        let band = |nm: &f64| wavelengths_nm.iter().position(|own| (own - nm).abs() < 0.1);
        let known = truth.wavelengths_nm.iter().zip(&truth.reflectance);
        Ok(Self {
            setting: FoldSetting::of(&scene)?,
            rgb: sample.facet_rgb()?,
            sd: sample.facet_sd()?.ok_or_else(|| missing("facet_sd"))?,
            prior: Prior::built_in(&wavelengths_nm)?,
            truth: known.filter_map(|(nm, reflectance)| Some((band(nm)?, *reflectance))).collect(),
            left_out: measured_names().find(|name| path.contains(name)).map(ToOwned::to_owned),
            wavelengths_nm,
            sample,
        })
    }

    fn quality(&self, priors: &'static Priors) -> Result<Quality> {
        let measured = Measured { rgb: &self.rgb, sd: &self.sd };
        let picture = Picture::of(&self.sample, &measured, self.sample.exposure()?)?;
        let fold = PhotographedFold::of(&self.setting).believing(priors);
        let fold = self.left_out.iter().fold(fold, |fold, name| fold.leaving_out(name));
        let parts =
            fold.parts(&picture)?.map_err(|why| Error::Numeric(format!("{}: {why}", self.sample.id())))?;
        let parts = [parts];
        let mut sheet = photograph::estimate(&parts, &self.prior)?;
        let estimate = sheet.photographs.remove(0).in_stated_light(&self.wavelengths_nm);
        let sd = estimate.reflectance_sd().unwrap();
        let off = |(band, truth): &(usize, f64)| (estimate.reflectance[*band] - truth, sd[*band]);
        let off: Vec<(f64, f64)> = self.truth.iter().map(off).collect();
        let mean = |of: &dyn Fn(f64, f64) -> f64| {
            off.iter().map(|(off, sd)| of(*off, *sd)).sum::<f64>() / off.len() as f64
        };
        Ok(Quality {
            score: mean(&|off, sd| -0.5 * (off / sd).powi(2).min(FURTHEST.powi(2)) - sd.ln()),
            rmse: mean(&|off, _| off.powi(2)).sqrt(),
            within_two_sd: mean(&|off, sd| f64::from(u8::from(off.abs() < 2.0 * sd))),
        })
    }
}

fn quality(all: &[Known], priors: Priors) -> Result<Quality> {
    // a photograph's parts hold them as long as they like
    let priors: &'static Priors = Box::leak(Box::new(priors));
    let each: Vec<Quality> = all.par_iter().map(|one| one.quality(priors)).collect::<Result<_>>()?;
    let mean = |of: fn(&Quality) -> f64| each.iter().map(of).sum::<f64>() / each.len() as f64;
    Ok(Quality {
        score: mean(|one| one.score),
        rmse: mean(|one| one.rmse),
        within_two_sd: mean(|one| one.within_two_sd),
    })
}

/// The same with one number changed: by a factor, or, if it is a mean, by as many standard deviations as the
/// factor is doublings, halved.
fn changed(mut priors: Priors, number: usize, factor: f64) -> Priors {
    let (name, of) = Priors::NUMBERS[number];
    let sd_of_mean = Priors::NUMBERS.get(number + 1).filter(|(next, _)| next.replacen("_sd", "", 1) == name);
    match sd_of_mean {
        Some((_, sd)) => {
            let sd = *sd(&mut priors);
            *of(&mut priors) += 0.5 * factor.log2() * sd;
        }
        None => *of(&mut priors) *= factor,
    }
    priors
}

fn table(all: &[Known]) -> Result<()> {
    let usual = quality(all, Priors::USUAL)?;
    println!("| number | value | half: score | error | double: score | error |\n|---|---|---|---|---|---|");
    println!(
        "| unchanged: score {:.3}, error {:.4}, within two sd {:.0} % | | | | | |",
        usual.score,
        usual.rmse,
        100.0 * usual.within_two_sd
    );
    for (number, (name, of)) in Priors::NUMBERS.iter().enumerate() {
        print!("| `{name}` | {}", *of(&mut Priors::USUAL.clone()));
        for factor in [0.5, 2.0] {
            let other = quality(all, changed(Priors::USUAL, number, factor))?;
            print!(" | {:+.3} | {:.4}", other.score - usual.score, other.rmse);
        }
        println!(" |");
    }
    Ok(())
}

/// The usual priors, but for numbers of `asked` that are named with a value.
fn start(asked: &[String]) -> Result<Priors> {
    let mut priors = Priors::USUAL;
    for (name, value) in asked.iter().filter_map(|one| one.split_once('=')) {
        let number = Priors::NUMBERS.iter().find(|(known, _)| *known == name);
        let (Some((_, of)), Ok(value)) = (number, value.parse()) else {
            return Err(Error::Numeric(format!(
                "{name}={value}: neither the name nor the value of a number"
            )));
        };
        *of(&mut priors) = value;
    }
    Ok(priors)
}

fn fit(all: &[Known], asked: &[String]) -> Result<()> {
    let start = start(asked)?;
    let mut best = (quality(all, start)?, start);
    println!("score {:.4}, error {:.4}", best.0.score, best.0.rmse);
    let is_asked =
        |name: &str| asked.is_empty() || asked.iter().any(|one| one.split('=').next() == Some(name));
    loop {
        let before = best.0.score;
        for (number, (name, of)) in Priors::NUMBERS.iter().enumerate().filter(|(_, (name, _))| is_asked(name))
        {
            for factor in [STEP, STEP.recip()] {
                let start = best.0.score;
                loop {
                    let priors = changed(best.1, number, factor);
                    let one = quality(all, priors)?;
                    if one.score < best.0.score + LEAST_GAIN {
                        break;
                    }
                    best = (one, priors);
                    println!("{name} {:.4}: score {:.4}, error {:.4}", *of(&mut best.1), one.score, one.rmse);
                }
                if best.0.score > start {
                    break;
                }
            }
        }
        if best.0.score < before + LEAST_GAIN {
            break;
        }
    }
    let within = 100.0 * best.0.within_two_sd;
    println!("score {:.4}, error {:.4}, within two sd {within:.0} %", best.0.score, best.0.rmse);
    for (name, of) in Priors::NUMBERS {
        let (was, is) = (*of(&mut Priors::USUAL.clone()), *of(&mut best.1));
        if (was - is).abs() > 0.0 {
            println!("{name}: {was} -> {is:.4}");
        }
    }
    Ok(())
}

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let (streams, rest): (Vec<_>, Vec<_>) = arguments.into_iter().partition(|one| one.ends_with(".ndjson"));
    let all: Vec<Known> = streams.iter().map(|path| Known::read(path)).collect::<Result<_>>()?;
    match rest.split_first() {
        Some((flag, names)) if flag == "--fit" => fit(&all, names),
        Some((other, _)) => Err(Error::Numeric(format!("{other}: neither a stream (*.ndjson) nor --fit"))),
        None => table(&all),
    }
}
