//! `vscore`: how far estimates are from the truth.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use vfold::cli::{self, Common, ToolArgs};
use vfold::colorimetry::{Colorimeter, Observer};
use vfold::plot::spectra::{CURVES_MAX, draw};
use vfold::score::{Metrics, Summary, pearson_distance, rmse};
use vfold::spectrum::{self, Outside, Spectrum, WavelengthGrid};
use vfold::stream::{Kept, Output, Reader, Record, ReflectanceRecord, Sample, Scene, Transform, pipe};
use vfold::{Error, Result};

/// Score estimated spectra against true ones
#[derive(Parser)]
#[command(
    name = "vscore",
    version,
    after_help = "Examples:\n  vkernel | vforward --reflectance cc24 | vestimate | vscore --table\n  \
                  vestimate samples.ndjson | vscore --truth measured.csv --illuminant D50 --plot spectra.svg"
)]
struct Args {
    /// Estimated samples from vestimate [default: standard input]
    #[arg(value_name = "SAMPLES", default_value = "-", hide_default_value = true)]
    samples: String,
    /// True reflectance: one for all samples, or a set with a member of each sample's name [default: what the samples say]
    #[arg(long, value_name = "SPEC")]
    truth: Option<String>,
    /// Illuminant of the colour difference
    #[arg(long, value_name = "SPEC", default_value = "D65")]
    illuminant: String,
    /// Standard observer of the colour difference, degrees
    #[arg(long, value_name = "2|10", default_value = "10", value_parser = observer)]
    observer: Observer,
    /// Draw estimates, their error bands and true spectra
    #[arg(long, value_name = "FILE.svg|.png", value_parser = cli::drawing)]
    plot: Option<PathBuf>,
    /// Print a table instead of records
    #[arg(long)]
    table: bool,
    #[command(flatten)]
    common: Common,
}

impl ToolArgs for Args {
    fn common(&self) -> &Common {
        &self.common
    }
}

struct Scorer<'a> {
    args: &'a Args,
    illuminant: Spectrum,
    truth: Option<Vec<Spectrum>>,
}

/// What the samples of one scene share.
struct Context {
    grid: WavelengthGrid,
    colorimeter: Colorimeter,
}

fn main() -> ExitCode {
    cli::run(tool)
}

fn tool(args: &Args, out: &mut Output) -> Result<()> {
    let truth = args.truth.as_deref().map(spectrum::reflectances).transpose()?;
    let illuminant = spectrum::illuminant(&args.illuminant)?;
    let scorer = Scorer { args, illuminant, truth };
    let (mut summary, mut curves) = (Summary::default(), Vec::new());
    if args.table {
        out.text(&format!("{:<28} {:>8} {:>10} {:>10}", "sample", "RMSE", "CIEDE2000", "PD"))?;
    }
    // To score a sample takes no longer than to read it: all are scored anew, and the summary is that of all.
    pipe(&mut Reader::open(&args.samples)?, &scorer, Kept::none(), |record| {
        if let Record::Sample(sample) = &record {
            summary.add(sample.metrics()?);
            if args.plot.is_some() && curves.len() < CURVES_MAX {
                curves.extend(sample.curve()?);
            }
        }
        match (args.table, &record) {
            (true, Record::Sample(sample)) => row(out, sample),
            (true, _) => Ok(()),
            (false, record) => out.record(record),
        }
    })?;
    args.plot.as_ref().map_or(Ok(()), |path| draw(path, &curves))?;
    if args.table { footer(out, &summary) } else { out.fields(&vfold::stream::summary(&summary)?) }
}

impl Transform for Scorer<'_> {
    type Context = Context;

    fn scene(&self, scene: &mut Scene) -> Result<Context> {
        if !self.args.common.no_history {
            scene.fields.add_history("vscore")?;
        }
        let grid = scene.grid()?;
        Ok(Context { colorimeter: Colorimeter::new(&grid, &self.illuminant, self.args.observer)?, grid })
    }

    fn sample(&self, context: &Context, sample: &mut Sample) -> Result<()> {
        let Some(estimate) = sample.estimated()? else {
            return Err(Error::field("estimate", "missing; run the samples through vestimate first"));
        };
        if estimate.reflectance.len() != context.grid.len()
            || estimate.wavelengths_nm != context.grid.wavelengths_nm()
        {
            return Err(Error::field("estimate", "not on the wavelengths of its scene; estimate it again"));
        }
        let truth = self.truth_of(sample)?.on(&context.grid, Outside::Refuse)?;
        let wavelengths_nm = context.grid.wavelengths_nm().to_vec();
        sample.set_truth(&ReflectanceRecord { wavelengths_nm, reflectance: truth.clone() })?;
        sample.set_metrics(&Metrics {
            rmse: rmse(&truth, &estimate.reflectance),
            ciede2000: context.colorimeter.delta_e_2000(&truth, &estimate.reflectance),
            pd: pearson_distance(&truth, &estimate.reflectance),
        })
    }
}

impl Scorer<'_> {
    fn truth_of(&self, sample: &Sample) -> Result<Spectrum> {
        match (self.truth.as_deref(), sample.truth()?) {
            (Some([one]), _) => Ok(one.clone()),
            (Some(spectra), _) => {
                let id = sample.id()?;
                // A column of a file is called after both: `truth:photo`.
                let named = |spectrum: &&Spectrum| {
                    spectrum.name() == id
                        || spectrum.name().split_once(':').is_some_and(|(_, member)| member == id)
                };
                spectra.iter().find(named).cloned().ok_or_else(|| {
                    Error::field("id", format!("--truth has no member '{id}' among its {}", spectra.len()))
                })
            }
            (None, Some(truth)) => Spectrum::new("truth", truth.wavelengths_nm, truth.reflectance),
            (None, None) => Err(Error::field("truth", "missing; give --truth SPEC")),
        }
    }
}

fn row(out: &mut Output, sample: &Sample) -> Result<()> {
    let id = sample.id()?;
    match (sample.metrics()?, sample.error()?) {
        (Some(metrics), None) => out.text(&line(&id, metrics)),
        (_, error) => out.failed_text(&format!("{id:<28} {}", error.unwrap_or_default())),
    }
}

fn footer(out: &mut Output, summary: &Summary) -> Result<()> {
    let Some([mean, median, worst]) = summary.statistics() else {
        return out.text("no sample was scored");
    };
    for (name, m) in [("mean", mean), ("median", median), ("worst", worst)] {
        out.text(&line(name, m))?;
    }
    Ok(())
}

fn line(name: &str, m: Metrics) -> String {
    format!("{name:<28} {:>8.4} {:>10.3} {:>10.5}", m.rmse, m.ciede2000, m.pd)
}

fn observer(text: &str) -> std::result::Result<Observer, String> {
    match text {
        "2" => Ok(Observer::Cie1931_2deg),
        "10" => Ok(Observer::Cie1964_10deg),
        _ => Err("write 2 or 10".to_owned()),
    }
}
