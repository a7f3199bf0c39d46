//! `vestimate`: from facet RGB to the spectrum of the sheet.

mod asked;
mod context;
mod drawing;
mod estimator;
mod flat;
mod join;
mod known_fold;
mod latest;
mod messages;
mod method;
mod plan;
mod settings;
mod verdicts;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{ArgGroup, Parser};
use drawing::Drawing;
use estimator::{Estimator, Made};
use flat::{MethodArgs, MethodName};
use join::Join;
use plan::PlanArgs;
use settings::{NoiseSd, Smoothness};
use verdicts::Verdicts;
use vfold::Result;
use vfold::cli::{self, Common, KernelArgs, MaterialArgs};
use vfold::estimate::Exposure;
use vfold::estimate::unknowns::Flag;
use vfold::spectrum::formats::{check_ending, write};
use vfold::stream::{EstimateRecord, Output, Reader, Record, pipe};

/// Estimate spectral reflectance from the facet RGB of a folded sheet
///
/// Most users need only --spectra and --plot.
#[derive(Parser)]
#[command(
    name = "vestimate",
    version,
    group(ArgGroup::new("scene without a camera").args(["plan", "kernel"]).multiple(true)),
    after_help = "Examples:\n  vestimate samples.ndjson --plot spectrum.svg > estimates.ndjson\n  \
                  vestimate samples.ndjson --fit exposure,tilt,sky \
                  --save estimate.reflectance=spectra.npy\n  \
                  vestimate samples.ndjson --prior smooth --smoothness 1e-4\n  \
                  vkernel --angle-deg 60 | vestimate --plan --camera nikon-d5100 --noise-sd 1e-3"
)]
struct Args {
    /// Scenes and samples from vforward or vextract [default: standard input]
    #[arg(value_name = "SAMPLES", default_value = "-", hide_default_value = true)]
    samples: String,
    /// Prior on the reflectance: sheets (paint, cloth, plants, skin, paper, prints), spectra (set or
    /// file), smooth (the paper's estimator) or none [default: sheets]
    #[arg(long, value_name = "SPEC|smooth|none")]
    prior: Option<String>,
    /// Weight of the squared second differences of the spectrum, for --prior smooth and --method park or
    /// khan; auto: as the noise allows [default: 1e-5; 1e-4 for park, 0 for khan]
    #[arg(long, value_name = "X|auto", value_parser = settings::smoothness)]
    smoothness: Option<Smoothness>,
    /// Standard deviation of the noise of every facet, on the scale of its value; auto: from the samples,
    /// else from what no reflectance explains
    #[arg(long, value_name = "X|auto", default_value = "auto",
        default_value_if("plan", "true", plan::NOISE_SD), value_parser = settings::noise_sd)]
    noise_sd: NoiseSd,
    /// Independent error of each value, relative to it, 0 to 1, in addition to the model error of real sheets
    /// [default: 3e-4 for photographs, 0 for computed facets]
    #[arg(long, value_name = "X")]
    model_error: Option<f64>,
    /// Pixel value of a perfect white diffuser facing the sun; free: fit it; sum: normalise by sums, as
    /// in the paper [default: the sample's, else free]
    #[arg(long, value_name = "X|free|sum", value_parser = settings::exposure)]
    exposure: Option<Exposure>,
    /// Scene parameters to fit, comma-separated, each expected near what the scene states [default: auto
    /// for photographs, else none]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = settings::fit())]
    fit: Vec<&'static Flag>,
    /// Estimate photographs of one sheet together: group by FIELD, or join the listed IDs. Without a
    /// value, group by the id up to its last - or _
    #[arg(long, value_name = "FIELD|IDS", num_args = 0..=1, require_equals = true,
        default_missing_value = "id", conflicts_with = "fit")]
    join: Option<Join>,
    /// Candidates for an unknown light: every column of a file [default: daylight of 4000 to 12500 K,
    /// suns, black bodies of 2500 to 4000 K, LEDs, fluorescent lamps]
    #[arg(long, value_name = "FILE")]
    illuminants: Option<String>,
    /// A fold of a sheet of known reflectance, taken by the same camera in the same light: one sample of
    /// vforward or vextract, and its reflectance. It fixes the light and, for computed facets, the
    /// exposure
    #[arg(long, value_name = "FILE=SPEC", value_parser = known_fold::file_and_spec,
        conflicts_with_all = ["join", "plan"])]
    known_fold: Option<(String, String)>,
    /// The sheet is backed by black card or the like: no light comes through it from behind
    #[arg(long)]
    backed: bool,
    /// Panel 1 is a card of this reflectance [default: the scene's]
    #[arg(long, value_name = "SPEC")]
    reference_panel: Option<String>,
    /// Initial reflectance [default: the prior mean; 0.5 for --prior smooth and none]
    #[arg(long, value_name = "SPEC|X")]
    start: Option<String>,
    /// Draw estimates with their error bands, true spectra, the sheets' colours under D65, flat and folded,
    /// and the residuals of a single sheet; for 8 to 60 samples, a small chart each; -: spectra of the
    /// first seven as text on standard error, as wide as the terminal
    #[arg(long, value_name = "FILE.svg|.png|-", value_parser = cli::drawing_or_terminal)]
    plot: Option<PathBuf>,
    /// Also write the estimates as a file of spectra: CSV with standard deviations, CGATS, IES TM-27
    #[arg(long, value_name = "FILE.csv|.sp|.spdx")]
    spectra: Option<PathBuf>,
    /// Write the iterations of every estimate, one JSON record per line
    #[arg(long, value_name = "FILE", conflicts_with = "resume")]
    trace: Option<PathBuf>,
    #[command(flatten)]
    method: MethodArgs,
    #[command(flatten)]
    planning: PlanArgs,
    #[command(flatten)]
    materials: MaterialArgs,
    #[command(flatten)]
    kernel: KernelArgs,
    #[command(flatten)]
    common: Common,
}

impl Args {
    /// The prior on reflectances.
    fn prior(&self) -> &str {
        self.prior.as_deref().unwrap_or(settings::SHEETS)
    }

    /// Whether estimates include their error bars.
    fn has_prior(&self) -> bool {
        self.method.method == MethodName::Interreflection && !matches!(self.prior(), "smooth" | "none")
    }
}

fn main() -> ExitCode {
    cli::run(|args: &Args| &args.common, tool)
}

fn tool(args: &Args, out: &mut Output) -> Result<()> {
    args.spectra.as_deref().map_or(Ok(()), check_ending)?;
    args.join.as_ref().map_or(Ok(()), |_| join::check(args))?;
    check_trace(args)?;
    let estimator = Estimator::new(args)?;
    let mut reader = Reader::open(&args.samples)?;
    if let Some(kernel) = args.kernel.external()? {
        let mut scene = kernel.scene()?;
        args.planning.complete(&mut scene, &args.common)?;
        reader = reader.after(scene);
    }
    if args.planning.plan {
        return args.planning.run(&estimator, &mut reader, out);
    }
    let mut drawing = args.plot.as_deref().map(Drawing::new).transpose()?;
    let mut verdicts = (!args.common.quiet).then(Verdicts::on_terminal).flatten();
    let mut measured = Vec::new();
    let mut traces = args.trace.as_deref().map(|path| Output::to(Some(path), &[])).transpose()?;
    let kept = out.kept()?.to_be_checked(); // files that flags name may have changed
    let done = |record: Record, made: Option<Made>| {
        let (estimate, trace) = match (made, &record) {
            (Some(Made { estimate, trace }), _) => (Some(estimate), trace),
            // the result of an interrupted run
            (None, Record::Sample(sample)) => (sample.estimate()?, Vec::new()),
            (None, _) => (None, Vec::new()),
        };
        if let (Record::Sample(sample), Some(estimate)) = (&record, &estimate) {
            let id = sample.id();
            warn(args, &id, estimate, verdicts.is_some());
            if let (Some(verdicts), Some(verdict)) = (&mut verdicts, &estimate.verdict) {
                verdicts.add(&id, verdict);
            }
            if let Some(file) = &mut traces {
                trace.iter().try_for_each(|line| file.fields(line))?;
            }
            if args.spectra.is_some() {
                measured.extend(estimate.measured(id));
            }
        }
        drawing.as_mut().map_or(Ok(()), |drawing| drawing.add(&record, estimate.as_ref()))?;
        out.record(&record)
    };
    match &args.join {
        Some(join) => join::run(join, &mut reader, &estimator, kept, done)?,
        None => pipe(&mut reader, &estimator, kept, done)?,
    }
    traces.map(Output::finish).transpose()?;
    args.spectra.as_ref().map_or(Ok(()), |path| write(path, &measured))?;
    verdicts.iter().for_each(Verdicts::say);
    drawing.as_ref().map_or(Ok(()), Drawing::write)
}

/// Refuses the iterations among the records, which readers would take for records of the stream.
fn check_trace(args: &Args) -> Result<()> {
    let is_stdout = |path: &Option<PathBuf>| path.as_deref() == Some(Path::new("-"));
    let records_there = args.common.output.is_none() || is_stdout(&args.common.output);
    let flags = [("--trace", is_stdout(&args.trace) && records_there)];
    cli::refuse(flags, "standard output already has the records", "name a file, or give --output FILE")
}

/// Reports departures of a photograph from the ideal, facets that cannot be those of the scene, so that a
/// fitted spectrum is meaningless, and unknowns that the facets do not determine; unless verdicts at the end
/// report these.
fn warn(args: &Args, id: &str, estimate: &EstimateRecord, is_judged: bool) {
    if args.common.quiet || !args.has_prior() {
        return;
    }
    if !estimate.findings.is_empty() {
        let all: Vec<_> = estimate.findings.iter().map(ToString::to_string).collect();
        cli::say("vestimate", &format!("{id}: allowed for: {}", all.join("; ")));
    }
    for doubt in estimate.doubts().into_iter().filter(|_| !is_judged) {
        cli::say("vestimate", &format!("{id}: {doubt}"));
    }
}
