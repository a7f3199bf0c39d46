//! `vextract`: the mean colour of every facet in photographs of a fold.

mod calibration;
mod camera;
mod reading;
mod regions;
mod sample;

use std::path::PathBuf;
use std::process::ExitCode;

use calibration::CalibrationArgs;
use clap::Parser;
use reading::ReadingArgs;
use regions::RegionArgs;
use vfold::cli::{self, Common, OpticsArgs, ToolArgs};
use vfold::image::Photograph;
use vfold::stream::{Output, Reader, Record};
use vfold::{Error, Result};

/// Measure the facets of a folded sheet in photographs
#[derive(Parser)]
#[command(
    name = "vextract",
    version,
    after_help = "Example:\n  vkernel --angle-deg 50 | vextract photo.exr --camera canon-5d-mark-ii \\\n    \
                  --panel0 \"332,462 345,77 122,12 104,442\" --panel1 \"332,462 345,77 485,17 472,446\" | vestimate\n\n\
                  Corners of a panel: crease end 0, crease end 1, outer end 1, outer end 0, as x,y in pixels from the top left\n\
                  corner of the upright picture; the centre of the first pixel is at 0.5,0.5."
)]
struct Args {
    /// Photographs: PNG, TIFF, OpenEXR or JPEG; RAW if built with the feature raw
    #[arg(value_name = "IMAGE", required_unless_present_any = ["generate", "list"])]
    images: Vec<PathBuf>,
    /// Scene from vkernel [default: standard input]
    #[arg(long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    scene: String,
    /// Camera: built-in name, CSV file or rawtoaces JSON [default: by the photograph's EXIF]
    #[arg(long, value_name = "SPEC")]
    camera: Option<String>,
    #[command(flatten)]
    optics: OpticsArgs,
    #[command(flatten)]
    regions: RegionArgs,
    #[command(flatten)]
    reading: ReadingArgs,
    #[command(flatten)]
    calibration: CalibrationArgs,
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
    let panels = args.regions.panels()?;
    args.calibration.check()?;
    let options = args.reading.options()?;
    let open = |path: &PathBuf| Photograph::open(path, &options);
    let mut reader = Reader::open(&args.scene)?;
    let Some(Record::Scene(mut scene)) = reader.read()? else {
        return Err(Error::Record {
            path: args.scene.clone(),
            line: 1,
            problem: "no scene".to_owned(),
            remedy: "pipe vkernel into vextract, or give --scene FILE".to_owned(),
        });
    };
    let first = open(&args.images[0]);
    if let Some(camera) = camera::camera(args.camera.as_deref(), first.as_ref().ok())? {
        scene.set_optics(&args.optics.resolve(camera)?)?;
    }
    if !args.common.no_history {
        scene.fields.add_history("vextract")?;
    }
    let fold = scene.fold()?;
    let id = scene.id()?;
    let samples = std::iter::once(first).chain(args.images[1..].iter().map(open));
    let mut made = samples
        .zip(&args.images)
        .map(|(photograph, path)| sample::sample(args, &id, &fold, &panels, path, photograph));
    if let [_] = args.images.as_slice()
        && let Some(only) = made.next()
    {
        // Nothing to go on with: the one photograph's error is the tool's.
        let only = only?;
        out.scene(&scene)?;
        return out.sample(&only);
    }
    out.scene(&scene)?;
    for (made, path) in made.zip(&args.images) {
        let sample = match made {
            Ok(sample) => sample,
            Err(error) => sample::failed(&id, path, &error)?,
        };
        out.sample(&sample)?;
    }
    Ok(())
}
