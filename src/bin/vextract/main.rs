//! `vextract`: the mean colour of every facet in photographs of a fold.

mod balance;
mod batch;
mod calibration;
mod camera;
mod chart_camera;
mod facing;
mod finding;
mod light;
mod list;
mod numbers;
mod paper;
mod picking;
mod pictures;
mod placing;
mod reading;
mod regions;
mod sample;
mod sheet;
mod target;
mod white;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use calibration::CalibrationArgs;
use clap::Parser;
use pictures::PictureArgs;
use placing::PlacingArgs;
use reading::ReadingArgs;
use regions::RegionArgs;
use sample::Setup;
use vfold::cli::{self, Common, OpticsArgs};
use vfold::image::Photograph;
use vfold::scene::Setting;
use vfold::stream::{Output, Reader, Record, Scene};
use vfold::surfaces::Sight;
use vfold::{Error, Result};

const AFTER_HELP: &str = "\
Examples:
  vkernel --angle-deg 50 | vextract photo.exr --camera canon-5d-mark-ii \\
    --panel0 \"332,462 345,77 122,12 104,442\" --panel1 \"332,462 345,77 485,17 472,446\" | vestimate
  vextract *.exr --scene scene.json --regions corners.json --camera nikon-d5100 -o samples.ndjson
  find . -name '*.exr' | sort | vextract --files-from - --scene scene.json --camera nikon-d5100 \\
    --regions corners.json --resume measured.ndjson

Without corners the fold is detected. Where detection is uncertain, vextract says what to do
instead of measuring. A colour chart of 4 x 6 patches, if detected with certainty and facing the
sun, calibrates the photograph. --find prints the corners of both, with the probability that all
of them are right, and areas that may be white paper or a card ('white_candidates'; to use one,
copy it to 'white'):
  vextract --find photo.tif > found.json
  vkernel --angle-deg 50 | vextract photo.tif --regions found.json --camera nikon-d5100

Corners are x,y in pixels from the top left corner of the upright picture; the centre of the
first pixel is at 0.5,0.5. Order:
  panel  crease end 0, crease end 1, outer end 1, outer end 0
  chart  outer corners of the first patch, the end of the first row, the last patch, the start
         of the last row
  white  any four round the card

A chart or card sets the exposure. It also gives each channel a quadratic polynomial, which
converts pixel values to those that the scene's camera would have recorded. Patches, coefficients
and residuals are in the record's 'calibration'.

--regions FILE holds the corners for every IMAGE:
  {\"panel0\": [[x,y],[x,y],[x,y],[x,y]], \"panel1\": ..., \"chart\": ..., \"white\": ...}
The record that vforward printed when it rendered IMAGE serves, too. For several photographs,
FILE holds a list of such objects, each with \"image\": \"NAME\", the file name of its IMAGE with or
without the extension. Corners marked in a picture of another size, such as a preview, are scaled
if \"width\" and \"height\" state its size in pixels.

If one of several photographs cannot be measured, its record has an 'error', and the exit status
is 3.";

const ILLUMINANT: &str = "\
Illuminant: a built-in name, daylight:CCT, a black body such as 2856K, the sun of a cloudless day at an \
angle from the zenith (sun:40deg) or at a place and time (sun:LAT,LON,TIME), a file, or unknown: \
vestimate finds it [default: by the photograph: the sun's at its place and time; unknown for a flash, \
lamps or night; else daylight, recorded as D65]";

/// Measure the facets of a folded sheet in photographs
#[derive(Parser)]
#[command(
    name = "vextract",
    version,
    after_help = AFTER_HELP,
    mut_arg("illuminant", |arg| arg.help(ILLUMINANT))
)]
struct Args {
    /// Photographs: PNG, TIFF, OpenEXR or JPEG; RAW if built with the feature raw
    #[arg(value_name = "IMAGE", required_unless_present_any = ["generate", "list", "files_from"])]
    images: Vec<PathBuf>,
    /// More photographs: a file with one name per line, - for standard input
    #[arg(long, value_name = "FILE")]
    files_from: Option<PathBuf>,
    /// Scene from vkernel [default: standard input]
    #[arg(long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    scene: String,
    /// Camera: built-in name, or a file (CSV, CGATS, rawtoaces JSON) [default: by the photograph's EXIF]
    #[arg(long, value_name = "SPEC")]
    camera: Option<String>,
    #[command(flatten)]
    optics: OpticsArgs,
    /// Print where the fold, the chart and what may be white are in each photograph, one line of JSON as
    /// --regions reads it, and exit; needs no scene
    #[arg(long,
        conflicts_with_all = ["regions", "panel0", "panel1", "panel", "chart", "white_region", "preview"])]
    find: bool,
    /// Show the photograph and the detected fold in a browser on this machine, to be corrected there,
    /// then print the corners as --find does; over SSH forward the port of the address that is shown:
    /// ssh -L PORT:127.0.0.1:PORT
    #[arg(long, conflicts_with_all = ["find", "regions", "panel0", "panel1", "panel", "chart", "white_region",
        "preview", "overlay"])]
    pick: bool,
    #[command(flatten)]
    regions: RegionArgs,
    #[command(flatten)]
    placing: PlacingArgs,
    #[command(flatten)]
    pictures: PictureArgs,
    #[command(flatten)]
    reading: ReadingArgs,
    #[command(flatten)]
    calibration: CalibrationArgs,
    #[command(flatten)]
    common: Common,
}

fn main() -> ExitCode {
    cli::run(|args: &Args| &args.common, tool)
}

/// Refuses to read two things from standard input: of two, one would find nothing there.
fn check_standard_input(args: &Args) -> Result<()> {
    let is_without_scene = args.find || args.pick || args.pictures.is_preview();
    let is_scene = args.scene == "-" && !is_without_scene && args.calibration.save_camera.is_none();
    let is_list = args.files_from.as_deref().is_some_and(|list| list == Path::new("-"));
    let are_regions = args.regions.is_stdin();
    cli::refuse(
        [("--files-from", is_list && is_scene), ("--regions", are_regions && is_scene)],
        "standard input is already the scene",
        "give --scene FILE",
    )?;
    cli::refuse(
        [("--regions", are_regions && is_list)],
        "standard input is already the list of photographs",
        "give --regions FILE",
    )
}

fn tool(args: &Args, out: &mut Output) -> Result<()> {
    let reading = args.reading.reading()?;
    check_standard_input(args)?;
    let images = list::images(args)?;
    args.pictures.check(&images)?;
    args.placing.check()?;
    let balance = |photograph: &Photograph| balance::of_photograph(args, photograph);
    if args.pictures.preview(&images, |path| reading.open(path), balance)? {
        return Ok(());
    }
    if args.find {
        return finding::print(args, &images, &reading, out);
    }
    if args.pick {
        return picking::print(args, &images, &reading, out);
    }
    let regions = args.regions.resolved()?;
    let calibration = args.calibration.resolved(&args.optics.wavelengths_nm, &args.common)?;
    args.optics.one_illuminant("name one: a photograph has one light")?;
    let sheet = args.reading.sheet(&reading)?;
    if let Some(file) = &args.calibration.save_camera {
        let first = reading.open(&images[0]);
        return chart_camera::save(args, file, &images, first, (&regions, &calibration), sheet.as_ref());
    }
    let mut scene = read_scene(&args.scene)?;
    let first = reading.open_to_measure(&images[0]);
    let seen = first.as_ref().ok().map(|opened| &opened.photograph);
    let mut notes = Vec::new();
    if let Some(camera) = camera::camera(args.camera.as_deref(), seen)? {
        let (resolved, assumed) = light::optics(&args.optics, &images[0], seen);
        let mut optics =
            resolved.resolve(&camera.sensitivities(|spec| args.common.camera(spec))?, &args.common)?;
        let stands_in = camera.stands_in.is_some();
        optics.camera.stands_in = camera.stands_in;
        scene.set_optics(&optics)?;
        if resolved.illuminant.is_empty() {
            scene.set_daylight_assumed()?;
        }
        // another camera's sensitivities are never used silently
        notes.extend(camera.note.filter(|_| stands_in || !args.common.quiet));
        notes.extend(assumed.filter(|_| !args.common.quiet));
    }
    if !args.common.no_history {
        scene.fields.add_history("vextract")?;
    }
    if !args.common.quiet {
        notes.extend(sheet.iter().flat_map(|sheet| sheet.warnings(&scene)));
    }
    let setting = Setting::of(&scene)?;
    let (id, panels, facet_count) = (scene.id()?, setting.panels()?, setting.facets()?);
    let sight = match &setting {
        Setting::Fold(_) => None,
        Setting::Surface(surface) => Some(Sight::new(&surface.scene.shape()?)),
    };
    let setup =
        Setup { args, reading, scene: &scene, id, panels, facet_count, sight, regions, calibration, sheet };
    if let Some(replaced) = batch::forget_replaced(&images, out)?
        && !args.common.quiet
    {
        let replaced = replaced.display();
        notes.push(format!(
            "{replaced} has changed since it was measured: it and all later photographs are measured again"
        ));
    }
    if let ([only], None) = (images.as_slice(), &args.files_from) {
        // nothing else to measure: the only photograph's error is the tool's
        let sample = setup.sample(only, first)?;
        notes.iter().for_each(|line| cli::say("vextract", line));
        out.scene(&scene)?;
        return out.sample(&sample);
    }
    notes.iter().for_each(|line| cli::say("vextract", line));
    out.expect(images.len());
    out.scene(&scene)?;
    let kept = out.kept()?;
    batch::measure(&setup, &images, first, kept, |sample| out.sample(&sample))
}

fn read_scene(path: &str) -> Result<Scene> {
    match Reader::open(path)?.read()? {
        Some(Record::Scene(scene)) => Ok(scene),
        _ => Err(Error::Record {
            path: path.to_owned(),
            line: 1,
            problem: "no scene".to_owned(),
            remedy: "pipe vkernel into vextract, or give --scene FILE".to_owned(),
        }),
    }
}
