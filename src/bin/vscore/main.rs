//! `vscore`: distances between estimates and the truth.

mod groups;
mod metric;
mod scorer;
mod table;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use groups::Groups;
use metric::metric;
use scorer::Scorer;
use table::Table;
use vfold::Result;
use vfold::cli::{self, Common};
use vfold::colorimetry::Observer;
use vfold::plot::spectra::CURVES_MAX;
use vfold::plot::{batch, sheets};
use vfold::report::{self, Gallery, SECTIONS_MAX, View};
use vfold::score::{Metric, Summary};
use vfold::spectrum::formats::{check_ending, write};
use vfold::stream::{Kept, Output, Reader, Record, pipe, summary};

/// Most samples listed as the worst in a drawing.
const WORST_MAX: usize = 10;

/// Score estimated spectra against true ones
#[derive(Parser)]
#[command(
    name = "vscore",
    version,
    after_help = "Examples:\n  vkernel | vforward --reflectance cc24 | vestimate | vscore --table\n  \
                  vestimate samples.ndjson | vscore --truth measured.csv --illuminant D50 \
                  --plot spectra.svg\n  \
                  vscore estimates.ndjson --illuminant D65 --illuminant A \
                  --metrics ciede2000,metamerism --table\n  \
                  cat angle-*.ndjson | vscore --by geometry.angle_deg --table\n  \
                  vscore estimates.ndjson --report report.html > scores.ndjson"
)]
struct Args {
    /// Estimated samples from vestimate [default: standard input]
    #[arg(value_name = "SAMPLES", default_value = "-", hide_default_value = true)]
    samples: String,
    /// True reflectance: one for all samples, or a set in which each sample has its namesake [default: the
    /// samples' own]
    #[arg(long, value_name = "SPEC")]
    truth: Option<String>,
    /// Measurement condition of ISO 13655: M2, without ultraviolet, compares what the sheet reflects; M1,
    /// under D50, also what it emits by fluorescence. Without fluorescence they are the same
    #[arg(long, value_name = "M1|M2", default_value = "M2", ignore_case = true)]
    condition: Condition,
    /// Illuminant of the colour difference; repeated: differences under each, and metamerism from the first
    /// to the others
    #[arg(long, value_name = "SPEC", default_value = "D65", value_parser = cli::light)]
    illuminant: Vec<String>,
    /// Standard observer of the colour difference, degrees
    #[arg(long, value_name = "2|10", default_value = "10", value_parser = observer)]
    observer: Observer,
    /// Scores: rmse, ciede2000, pd (1 - gfc), gfc (goodness of fit), angle (spectral, degrees), metamerism
    /// (special index of CIE 15, by CIEDE2000) [default: rmse,ciede2000,pd, and metamerism under several
    /// illuminants]
    #[arg(long, value_name = "LIST", value_delimiter = ',', hide_possible_values = true,
        value_parser = metric())]
    metrics: Vec<&'static Metric>,
    /// Add the estimate's XYZ, CIELAB and sRGB under the first illuminant to the records, with standard
    /// deviations
    #[arg(long, conflicts_with = "table")]
    colour: bool,
    /// Also summarise by the value of a field of the samples or their scenes, such as
    /// `geometry.angle_deg`
    #[arg(long, value_name = "FIELD")]
    by: Option<String>,
    /// Draw estimates with their error bands, true spectra, the sheets' colours, flat and folded, and the
    /// residuals of a single sheet; for more than seven samples, the distribution of scores and the ten
    /// worst; -: spectra as text on standard error, as wide as the terminal
    #[arg(long, value_name = "FILE.svg|.png|-", value_parser = cli::drawing_or_terminal)]
    plot: Option<PathBuf>,
    /// Write an HTML page with all results and the tools' decisions, for browsers and printers; of many
    /// samples it shows the worst 24. Neither this nor --plot needs true spectra
    #[arg(long, value_name = "FILE.html", value_parser = page)]
    report: Option<PathBuf>,
    /// Picture of what was measured, for --report, as drawn by vextract --overlay; {} in the name stands
    /// for the sample's; repeated: pictures named after their samples
    #[arg(long, value_name = "FILE.png", requires = "report")]
    overlay: Vec<PathBuf>,
    /// Also write the estimates as a file of spectra: CSV with standard deviations, CGATS, IES TM-27
    #[arg(long, value_name = "FILE.csv|.sp|.spdx")]
    spectra: Option<PathBuf>,
    /// Print a table instead of records
    #[arg(long)]
    table: bool,
    #[command(flatten)]
    common: Common,
}

/// What of a sheet's light is compared.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "verbatim")]
enum Condition {
    /// All light that it sends out.
    M1,
    /// What it reflects.
    M2,
}

impl Args {
    /// Whether more than the scores of a sample is shown.
    fn draws(&self) -> bool {
        self.plot.is_some() || self.report.is_some()
    }
}

fn main() -> ExitCode {
    cli::run(|args: &Args| &args.common, tool)
}

fn tool(args: &Args, out: &mut Output) -> Result<()> {
    args.spectra.as_deref().map_or(Ok(()), check_ending)?;
    let scorer = Scorer::new(args)?;
    let table = args.table.then(|| Table::new(&scorer.scores));
    let (mut groups, mut measured) = (Groups::new(args.by.as_deref()), Vec::new());
    let mut gallery = gallery(args);
    let mut header = table.as_ref();
    // scoring a sample takes no longer than reading it: all are scored again, and the summary covers all of
    // them
    pipe(&mut Reader::open(&args.samples)?, &scorer, Kept::none(), |record, _| {
        header.take().map_or(Ok(()), |table| table.header(out))?;
        match &record {
            Record::Scene(scene) => {
                groups.enter(scene)?;
                gallery.iter_mut().for_each(|gallery| gallery.enter(scene));
            }
            Record::Sample(sample) => {
                groups.add(sample)?;
                gallery.iter_mut().try_for_each(|gallery| gallery.add(sample))?;
                if args.spectra.is_some() {
                    let estimate = sample.estimate()?;
                    measured.extend(estimate.iter().flat_map(|estimate| estimate.measured(sample.id())));
                }
            }
            Record::Other(_) => {}
        }
        let Some(table) = &table else { return out.record(&record) };
        out.saves.record(record.fields())?; // as if the record were written
        if let Record::Sample(sample) = &record { table.row(out, sample) } else { Ok(()) }
    })?;
    args.spectra.as_ref().map_or(Ok(()), |path| write(path, &measured))?;
    let by = groups.found()?;
    let summary = summary(groups.all(), by)?;
    match table {
        Some(table) => {
            out.saves.record(&summary)?;
            table.footer(out, groups.all(), by)?;
        }
        None => out.fields(&summary)?,
    }
    gallery.as_ref().map_or(Ok(()), |gallery| draw(args, gallery, groups.all(), &scorer))
}

/// The store of samples for drawings, if any.
fn gallery(args: &Args) -> Option<Gallery> {
    match (&args.report, &args.plot) {
        (Some(_), _) => Some(Gallery::new(SECTIONS_MAX)),
        (None, Some(_)) => Some(Gallery::new(WORST_MAX)),
        (None, None) => None,
    }
}

fn draw(args: &Args, gallery: &Gallery, all: &Summary, scorer: &Scorer) -> Result<()> {
    let view =
        View { illuminant: scorer.first_illuminant(), observer: args.observer, overlays: &args.overlay };
    args.report.as_ref().map_or(Ok(()), |path| report::write(path, gallery, all, &view))?;
    match &args.plot {
        Some(path) if gallery.seen() > CURVES_MAX && path != Path::new("-") => {
            batch::draw(path, &gallery.batch(all)?)
        }
        Some(path) => sheets::draw(path, &gallery.sheets(&view)?, gallery.seen()),
        None => Ok(()),
    }
}

fn page(text: &str) -> std::result::Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    let is_page = ending.is_some_and(|ending| matches!(ending.as_str(), "html" | "htm"));
    if is_page { Ok(path) } else { Err("end the name in .html".to_owned()) }
}

fn observer(text: &str) -> std::result::Result<Observer, String> {
    match text {
        "2" => Ok(Observer::Cie1931_2deg),
        "10" => Ok(Observer::Cie1964_10deg),
        _ => Err("write 2 or 10".to_owned()),
    }
}
