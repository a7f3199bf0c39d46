//! `vscore`: how far estimates are from the truth.

mod groups;
mod metric;
mod scorer;
mod table;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use groups::Groups;
use metric::Metric;
use scorer::Scorer;
use table::Table;
use vfold::Result;
use vfold::cli::{self, Common, ToolArgs};
use vfold::colorimetry::Observer;
use vfold::plot::spectra::{CURVES_MAX, draw};
use vfold::spectrum::formats::{check_ending, write};
use vfold::stream::{Kept, Output, Reader, Record, pipe, summary};

/// Score estimated spectra against true ones
#[derive(Parser)]
#[command(
    name = "vscore",
    version,
    after_help = "Examples:\n  vkernel | vforward --reflectance cc24 | vestimate | vscore --table\n  \
                  vestimate samples.ndjson | vscore --truth measured.csv --illuminant D50 --plot spectra.svg\n  \
                  vscore estimates.ndjson --illuminant D65 --illuminant A --metrics ciede2000,metamerism --table\n  \
                  cat angle-*.ndjson | vscore --by geometry.angle_deg --table"
)]
struct Args {
    /// Estimated samples from vestimate [default: standard input]
    #[arg(value_name = "SAMPLES", default_value = "-", hide_default_value = true)]
    samples: String,
    /// True reflectance: one for all samples, or a set with a member of each sample's name [default: what the samples say]
    #[arg(long, value_name = "SPEC")]
    truth: Option<String>,
    /// Illuminant of the colour difference; repeated: differences under each, and metamerism from the first to the others
    #[arg(long, value_name = "SPEC", default_value = "D65")]
    illuminant: Vec<String>,
    /// Standard observer of the colour difference, degrees
    #[arg(long, value_name = "2|10", default_value = "10", value_parser = observer)]
    observer: Observer,
    /// What is scored: rmse, ciede2000, pd, gfc (goodness of fit), angle (spectral angle, degrees), metamerism (special index
    /// of CIE 15, by CIEDE2000) [default: rmse,ciede2000,pd, and metamerism under several illuminants]
    #[arg(long, value_name = "LIST", value_delimiter = ',', hide_possible_values = true)]
    metrics: Vec<Metric>,
    /// Add the estimate's XYZ, CIELAB and sRGB under the first illuminant to the records, with standard deviations
    #[arg(long, conflicts_with = "table")]
    colour: bool,
    /// Also sum up the samples that share the value of a field of theirs or of their scene, such as `geometry.angle_deg`
    #[arg(long, value_name = "FIELD")]
    by: Option<String>,
    /// Draw estimates, their error bands and true spectra; -: on standard error, in characters as wide as the terminal
    #[arg(long, value_name = "FILE.svg|.png|-", value_parser = cli::drawing)]
    plot: Option<PathBuf>,
    /// Also write the estimates as a file of spectra: CSV with standard deviations, CGATS, IES TM-27
    #[arg(long, value_name = "FILE.csv|.sp|.spdx")]
    spectra: Option<PathBuf>,
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

fn main() -> ExitCode {
    cli::run(tool)
}

fn tool(args: &Args, out: &mut Output) -> Result<()> {
    args.spectra.as_deref().map_or(Ok(()), check_ending)?;
    let scorer = Scorer::new(args)?;
    let table = args.table.then(|| Table::new(scorer.names.clone()));
    let (mut groups, mut curves, mut measured) = (Groups::new(args.by.as_deref()), Vec::new(), Vec::new());
    table.as_ref().map_or(Ok(()), |table| table.header(out))?;
    // To score a sample takes no longer than to read it: all are scored anew, and the summary is that of all.
    pipe(&mut Reader::open(&args.samples)?, &scorer, Kept::none(), |record| {
        match &record {
            Record::Scene(scene) => groups.enter(scene),
            Record::Sample(sample) => {
                groups.add(sample)?;
                if args.plot.is_some() && curves.len() < CURVES_MAX {
                    curves.extend(sample.curve()?);
                }
                if args.spectra.is_some() {
                    measured.extend(sample.measured()?);
                }
            }
            Record::Other(_) => {}
        }
        match (&table, &record) {
            (Some(table), Record::Sample(sample)) => table.row(out, sample),
            (Some(_), _) => Ok(()),
            (None, record) => out.record(record),
        }
    })?;
    args.plot.as_ref().map_or(Ok(()), |path| draw(path, &curves))?;
    args.spectra.as_ref().map_or(Ok(()), |path| write(path, &measured))?;
    let by = groups.found()?;
    match table {
        Some(table) => table.footer(out, groups.all(), by),
        None => out.fields(&summary(groups.all(), by)?),
    }
}

fn observer(text: &str) -> std::result::Result<Observer, String> {
    match text {
        "2" => Ok(Observer::Cie1931_2deg),
        "10" => Ok(Observer::Cie1964_10deg),
        _ => Err("write 2 or 10".to_owned()),
    }
}
