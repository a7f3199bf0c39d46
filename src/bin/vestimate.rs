//! `vestimate`: from facet RGB to the spectrum of the sheet.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use vfold::cli::{self, Common, ToolArgs};
use vfold::estimate::classes;
use vfold::estimate::data::{FacetData, Measured};
use vfold::estimate::noise::{deviations, unexplained};
use vfold::estimate::prior::Prior;
use vfold::estimate::{Estimate, Exposure, map, smooth};
use vfold::forward::FacetModel;
use vfold::plot::spectra::{CURVES_MAX, draw};
use vfold::spectrum::{self, Outside, Spectrum, WavelengthGrid};
use vfold::stream::{Colours, Output, Reader, Record, ReferencePanel, Sample, Scene, Transform, pipe};
use vfold::{Error, Result};

/// The prior whose classes are known.
const MUNSELL: &str = "munsell";
/// Least change that counts to the paper's estimator, white being 1.
const SMOOTH_CUTOFF: f64 = 1e-8;
/// What a real fold does that the model does not, relative to the facet's value.
const MODEL_ERROR: f64 = 3e-4;
/// Least change that counts, in standard deviations.
const CUTOFF: f64 = 1e-2;
/// Residuals, in units of their expected size, beyond which the scene cannot be right.
const MISFIT: f64 = 5.0;

/// Estimate spectral reflectance from the facet RGB of a folded sheet
#[derive(Parser)]
#[command(
    name = "vestimate",
    version,
    after_help = "Examples:\n  vkernel | vextract photo.tif --camera nikon-d5100 --panel0 ... --panel1 ... | vestimate --plot spectrum.svg\n  \
                  vestimate --prior smooth --smoothness 1e-4 samples.ndjson"
)]
struct Args {
    /// Scenes and samples from vforward or vextract [default: standard input]
    #[arg(value_name = "SAMPLES", default_value = "-", hide_default_value = true)]
    samples: String,
    /// What is known of reflectances beforehand: spectra (set or CSV), smooth (the paper's estimator) or none
    #[arg(long, value_name = "SPEC|smooth|none", default_value = MUNSELL)]
    prior: String,
    /// Weight of the squared second differences of the spectrum, for --prior smooth; auto: what the noise allows
    #[arg(long, value_name = "X|auto", default_value = "1e-5", allow_negative_numbers = true, value_parser = smoothness)]
    smoothness: Smoothness,
    /// Standard deviation of every facet; auto: what the samples say, else what no reflectance explains
    #[arg(long, value_name = "X|auto", default_value = "auto", allow_negative_numbers = true, value_parser = noise_sd)]
    noise_sd: NoiseSd,
    /// Error of the model, relative to a facet's value [default: 3e-4 for photographs, 0 for computed facets]
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    model_error: Option<f64>,
    /// Value of white facing the sun; free: fitted; sum: by sums, as in the paper [default: what the sample says, else free]
    #[arg(long, value_name = "X|free|sum", value_parser = exposure)]
    exposure: Option<Exposure>,
    /// Panel 1 is a card of this reflectance [default: what the scene says]
    #[arg(long, value_name = "SPEC")]
    reference_panel: Option<String>,
    /// Reflectance to set out from [default: the prior's mean; 0.5 for --prior smooth and none]
    #[arg(long, value_name = "SPEC|X")]
    start: Option<String>,
    /// Draw estimates, their error bands and true spectra
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    common: Common,
}

impl ToolArgs for Args {
    fn common(&self) -> &Common {
        &self.common
    }
}

/// Where the standard deviations of facets come from.
#[derive(Clone, Copy)]
enum NoiseSd {
    Auto,
    All(f64),
}

/// Weight of smoothness in the paper's objective.
#[derive(Clone, Copy)]
enum Smoothness {
    Auto,
    /// In units of white squared.
    Weight(f64),
}

/// How spectra are estimated, from `--prior`.
enum Method {
    /// Spectra of the prior, and their classes where they are known.
    Map(Vec<Spectrum>, Option<Vec<usize>>),
    Smooth(Smoothness),
}

/// What the samples of one scene need.
struct Context {
    grid: WavelengthGrid,
    model: FacetModel,
    method: SceneMethod,
    start: Option<Vec<f64>>,
}

/// The method on the wavelengths of a scene.
enum SceneMethod {
    Map(Prior),
    Smooth(Smoothness),
}

struct Estimator<'a> {
    args: &'a Args,
    method: Method,
}

fn main() -> ExitCode {
    cli::run(tool)
}

fn tool(args: &Args, out: &mut Output) -> Result<()> {
    let estimator = Estimator { args, method: method(args)? };
    let mut curves = Vec::new();
    pipe(&mut Reader::open(&args.samples)?, &estimator, |record| {
        if let Record::Sample(sample) = &record {
            warn_of_misfit(args, sample)?;
            if args.plot.is_some() && curves.len() < CURVES_MAX {
                curves.extend(sample.curve()?);
            }
        }
        out.record(&record)
    })?;
    args.plot.as_ref().map_or(Ok(()), |path| draw(path, &curves))
}

/// Says when the facets cannot be those of the scene: a spectrum fitted to them means nothing.
fn warn_of_misfit(args: &Args, sample: &Sample) -> Result<()> {
    match sample.residual_rms()? {
        Some(rms)
            if rms > MISFIT && !args.common.quiet && !matches!(args.prior.as_str(), "smooth" | "none") =>
        {
            let problem = format!("facets are {rms:.0} times further from the model than their noise");
            cli::say(
                "vestimate",
                &format!("{}: {problem}; check angle, corners, light, camera and exposure", sample.id()?),
            );
        }
        _ => {}
    }
    Ok(())
}

fn method(args: &Args) -> Result<Method> {
    if let Some(error) = args.model_error.filter(|error| !(0.0..=1.0).contains(error)) {
        return Err(Error::usage("--model-error", format!("{error} is not a relative error"), "give 0 to 1"));
    }
    Ok(match args.prior.as_str() {
        "smooth" => Method::Smooth(args.smoothness),
        "none" => Method::Smooth(Smoothness::Weight(0.0)),
        spec => {
            let classes = (spec == MUNSELL).then(classes::of_munsell);
            Method::Map(spectrum::reflectances(spec)?, classes)
        }
    })
}

impl Transform for Estimator<'_> {
    type Context = Context;

    fn scene(&self, scene: &mut Scene) -> Result<Context> {
        let grid = scene.grid()?;
        if let Some(spec) = &self.args.reference_panel {
            let card = cli::one_reflectance("--reference-panel", spec)?;
            let reflectance = card.on(&grid, Outside::Refuse)?;
            scene.set_reference_panel(&ReferencePanel::new(1, card.name(), reflectance))?;
        }
        let method = match &self.method {
            Method::Map(spectra, classes) => {
                let on_grid: Vec<_> =
                    spectra.iter().map(|s| s.on(&grid, Outside::Refuse)).collect::<Result<_>>()?;
                SceneMethod::Map(Prior::from_spectra(grid.wavelengths_nm(), &on_grid, classes.as_deref())?)
            }
            Method::Smooth(smoothness) => SceneMethod::Smooth(*smoothness),
        };
        if !self.args.common.no_history {
            scene.fields.add_history("vestimate")?;
        }
        let start = match &self.args.start {
            Some(spec) => Some(cli::one_reflectance("--start", spec)?.on(&grid, Outside::Refuse)?),
            None => None,
        };
        Ok(Context { grid, model: scene.model()?, method, start })
    }

    fn sample(&self, context: &Context, sample: &mut Sample) -> Result<()> {
        let rgb = sample.facet_rgb()?;
        let exposure = match self.args.exposure {
            Some(exposure) => exposure,
            None => sample.exposure()?.map_or(Exposure::Free, Exposure::Known),
        };
        let estimate = match &context.method {
            SceneMethod::Map(prior) => {
                let sd = self.deviations(context, &rgb, sample)?;
                let measured = Measured { rgb: &rgb, sd: &sd };
                let data = FacetData::new(&context.model, &measured, exposure, CUTOFF)?;
                map::estimate(&data, prior, context.start.as_deref())
            }
            SceneMethod::Smooth(smoothness) => self.smooth(context, sample, exposure, *smoothness)?,
        };
        let with_covariance = self.args.common.save.iter().any(|(field, _)| field.ends_with("covariance"));
        let wavelengths_nm = context.grid.wavelengths_nm();
        sample.set_estimate("interreflection", &self.args.prior, wavelengths_nm, &estimate, with_covariance)
    }
}

impl Estimator<'_> {
    /// The paper's objective weighs all facets alike, white being 1.
    fn smooth(
        &self,
        context: &Context,
        sample: &Sample,
        exposure: Exposure,
        smoothness: Smoothness,
    ) -> Result<Estimate> {
        let rgb = sample.facet_rgb()?;
        let sd: Colours =
            rgb.iter().map(|facet| facet.as_ref().map(|values| vec![1.0; values.len()])).collect();
        let measured = Measured { rgb: &rgb, sd: &sd };
        let data = FacetData::new(&context.model, &measured, exposure, SMOOTH_CUTOFF)?;
        let middle = vec![0.5; context.grid.len()];
        let start = context.start.as_ref().unwrap_or(&middle);
        match smoothness {
            Smoothness::Weight(weight) => smooth::estimate(&data, weight, start),
            Smoothness::Auto => {
                let noise = self.deviations(context, &rgb, sample)?;
                smooth::estimate_by_discrepancy(&data, root_mean_square(&noise), start)
            }
        }
    }

    /// How far each facet may be off: its noise, and what the model leaves out.
    fn deviations(&self, context: &Context, rgb: &Colours, sample: &Sample) -> Result<Colours> {
        let model_error = match self.args.model_error {
            Some(error) => error,
            None if sample.is_photograph()? => MODEL_ERROR,
            None => 0.0,
        };
        if let NoiseSd::All(sd) = self.args.noise_sd {
            return Ok(deviations(rgb, |_, _| sd, model_error));
        }
        let Some(said) = sample.facet_sd()? else {
            let noise = unexplained(&context.model, rgb);
            return Ok(deviations(rgb, |_, channel| noise.get(channel).copied().unwrap_or(0.0), model_error));
        };
        if said.len() != rgb.len() {
            return Err(Error::field(
                "facet_sd",
                format!("{} facets, but facet_rgb has {}", said.len(), rgb.len()),
            ));
        }
        let noise = |facet: usize, channel: usize| said[facet].as_ref()?.get(channel).copied();
        Ok(deviations(rgb, |facet, channel| noise(facet, channel).unwrap_or(0.0), model_error))
    }
}

fn root_mean_square(facets: &Colours) -> f64 {
    let values: Vec<f64> = facets.iter().flatten().flatten().copied().collect();
    (values.iter().map(|value| value * value).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

fn smoothness(text: &str) -> std::result::Result<Smoothness, String> {
    match text.parse() {
        _ if text == "auto" => Ok(Smoothness::Auto),
        Ok(weight) if weight >= 0.0 && f64::is_finite(weight) => Ok(Smoothness::Weight(weight)),
        _ => Err("write a weight, 0 or more, or auto".to_owned()),
    }
}

fn noise_sd(text: &str) -> std::result::Result<NoiseSd, String> {
    match text.parse() {
        _ if text == "auto" => Ok(NoiseSd::Auto),
        Ok(sd) if sd >= 0.0 && f64::is_finite(sd) => Ok(NoiseSd::All(sd)),
        _ => Err("write a standard deviation, 0 or more, or auto".to_owned()),
    }
}

fn exposure(text: &str) -> std::result::Result<Exposure, String> {
    match text.parse() {
        _ if text == "free" => Ok(Exposure::Free),
        _ if text == "sum" => Ok(Exposure::Sum),
        Ok(exposure) if exposure > 0.0 && f64::is_finite(exposure) => Ok(Exposure::Known(exposure)),
        _ => Err("write a number above 0, free or sum".to_owned()),
    }
}
