//! `vestimate`: from facet RGB to the spectrum of the sheet.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use vfold::cli::{self, Common, ToolArgs};
use vfold::estimate::data::{FacetData, Measured};
use vfold::estimate::prior::Prior;
use vfold::estimate::{Estimate, Exposure, map, smooth};
use vfold::forward::FacetModel;
use vfold::plot::spectra::{CURVES_MAX, draw};
use vfold::spectrum::{self, Outside, Spectrum, WavelengthGrid};
use vfold::stream::{Colours, Output, Reader, Record, ReferencePanel, Sample, Scene, Transform, pipe};
use vfold::{Error, Result};

/// Noise that computed facets have all the same: what rounding and the scene's tolerance leave, relative to the brightest.
const NOISE_FLOOR: f64 = 1e-6;
/// What a real fold does that the model does not, relative to the facet's value.
const MODEL_ERROR: f64 = 1e-3;
/// Least change that counts, in standard deviations.
const CUTOFF: f64 = 1e-2;
/// Residuals, in units of their expected size, beyond which the scene cannot be right.
const MISFIT: f64 = 5.0;
/// Weight of smoothness in the paper's objective, in units of white squared.
const SMOOTHNESS: f64 = 1e-5;

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
    #[arg(long, value_name = "SPEC|smooth|none", default_value = "munsell")]
    prior: String,
    /// Weight of the squared second differences of the spectrum, for --prior smooth [default: 1e-5]
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    smoothness: Option<f64>,
    /// Standard deviation of every facet, or what the samples say
    #[arg(long, value_name = "X|auto", default_value = "auto", allow_negative_numbers = true, value_parser = noise_sd)]
    noise_sd: NoiseSd,
    /// Error of the model, relative to a facet's value [default: 1e-3 for photographs, 0 for computed facets]
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    model_error: Option<f64>,
    /// Value of white facing the sun; free: fitted; sum: by sums, as in the paper [default: what the sample says, else free]
    #[arg(long, value_name = "X|free|sum", value_parser = exposure)]
    exposure: Option<Exposure>,
    /// Panel 1 is a card of this reflectance [default: what the scene says]
    #[arg(long, value_name = "SPEC")]
    reference_panel: Option<String>,
    /// Reflectance, the same at all wavelengths, from which --prior smooth and none set out
    #[arg(long, value_name = "R", default_value_t = 0.5)]
    start: f64,
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

/// How spectra are estimated, from `--prior`.
enum Method {
    Map(Vec<Spectrum>),
    Smooth(f64),
}

/// What the samples of one scene need.
struct Context {
    grid: WavelengthGrid,
    model: FacetModel,
    method: SceneMethod,
}

/// The method on the wavelengths of a scene.
enum SceneMethod {
    Map(Prior),
    Smooth(f64),
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
    let smoothness = args.smoothness.unwrap_or(SMOOTHNESS);
    if !(smoothness >= 0.0 && smoothness.is_finite()) {
        return Err(Error::usage("--smoothness", format!("{smoothness} is not a weight"), "give 0 or more"));
    }
    if !(args.start > 0.0 && args.start < 1.0) {
        return Err(Error::usage(
            "--start",
            format!("{} is not inside (0, 1)", args.start),
            "give a reflectance",
        ));
    }
    if let Some(error) = args.model_error.filter(|error| !(0.0..=1.0).contains(error)) {
        return Err(Error::usage("--model-error", format!("{error} is not a relative error"), "give 0 to 1"));
    }
    Ok(match args.prior.as_str() {
        "smooth" => Method::Smooth(smoothness),
        "none" => Method::Smooth(0.0),
        spec => Method::Map(spectrum::reflectances(spec)?),
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
            Method::Map(spectra) => {
                let on_grid: Vec<_> =
                    spectra.iter().map(|s| s.on(&grid, Outside::Refuse)).collect::<Result<_>>()?;
                SceneMethod::Map(Prior::from_spectra(grid.wavelengths_nm(), &on_grid)?)
            }
            Method::Smooth(smoothness) => SceneMethod::Smooth(*smoothness),
        };
        if !self.args.common.no_history {
            scene.fields.add_history("vestimate")?;
        }
        Ok(Context { grid, model: scene.model()?, method })
    }

    fn sample(&self, context: &Context, sample: &mut Sample) -> Result<()> {
        let rgb = sample.facet_rgb()?;
        let exposure = match self.args.exposure {
            Some(exposure) => exposure,
            None => sample.exposure()?.map_or(Exposure::Free, Exposure::Known),
        };
        let estimate = match &context.method {
            SceneMethod::Map(prior) => {
                let sd = self.deviations(&rgb, sample)?;
                let measured = Measured { rgb: &rgb, sd: &sd };
                map::estimate(&FacetData::new(&context.model, &measured, exposure, CUTOFF)?, prior)
            }
            SceneMethod::Smooth(smoothness) => self.smooth(context, &rgb, exposure, *smoothness)?,
        };
        sample.set_estimate("interreflection", &self.args.prior, context.grid.wavelengths_nm(), &estimate)
    }
}

impl Estimator<'_> {
    /// The paper's objective weighs all facets alike, white being 1.
    fn smooth(
        &self,
        context: &Context,
        rgb: &Colours,
        exposure: Exposure,
        smoothness: f64,
    ) -> Result<Estimate> {
        let sd: Colours =
            rgb.iter().map(|facet| facet.as_ref().map(|values| vec![1.0; values.len()])).collect();
        let measured = Measured { rgb, sd: &sd };
        let data = FacetData::new(&context.model, &measured, exposure, NOISE_FLOOR * CUTOFF)?;
        smooth::estimate(&data, context.grid.len(), smoothness, self.args.start)
    }

    /// How far each facet may be off: its noise, and what the model leaves out.
    fn deviations(&self, rgb: &Colours, sample: &Sample) -> Result<Colours> {
        let said = sample.facet_sd()?;
        if let Some(said) = &said
            && said.len() != rgb.len()
        {
            return Err(Error::field(
                "facet_sd",
                format!("{} facets, but facet_rgb has {}", said.len(), rgb.len()),
            ));
        }
        let model_error = match self.args.model_error {
            Some(error) => error,
            None if sample.is_photograph()? => MODEL_ERROR,
            None => 0.0,
        };
        let floor = NOISE_FLOOR * rgb.iter().flatten().flatten().copied().fold(0.0, f64::max);
        let deviation = |facet: usize, channel: usize, value: f64| {
            let noise = match (self.args.noise_sd, &said) {
                (NoiseSd::All(sd), _) => sd,
                (NoiseSd::Auto, Some(said)) => {
                    said.get(facet).and_then(|sd| sd.as_ref()?.get(channel)).copied().unwrap_or(0.0)
                }
                (NoiseSd::Auto, None) => 0.0,
            };
            noise.hypot(model_error * value).hypot(floor)
        };
        let facet = |(facet, values): (usize, &Option<Vec<f64>>)| {
            values.as_ref().map(|values| {
                values.iter().enumerate().map(|(c, value)| deviation(facet, c, *value)).collect()
            })
        };
        Ok(rgb.iter().enumerate().map(facet).collect())
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
