//! `vextract`: the mean colour of every facet in photographs of a fold.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use vfold::cli::{self, Common, OpticsArgs, ToolArgs};
use vfold::geometry::Fold;
use vfold::image::{Homography, PANEL_CORNERS, Photograph, ReadOptions, Transfer, measure, parse_corners};
use vfold::spectrum;
use vfold::stream::{ImageRecord, Output, Reader, Record, Sample};
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
    /// Photographs: PNG, TIFF, OpenEXR or JPEG
    #[arg(value_name = "IMAGE", required_unless_present_any = ["generate", "list"])]
    images: Vec<PathBuf>,
    /// Scene from vkernel [default: standard input]
    #[arg(long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    scene: String,
    /// Corners of panel 0
    #[arg(long, value_name = "x,y x,y x,y x,y", required_unless_present_any = ["generate", "list"], allow_hyphen_values = true)]
    panel0: Option<String>,
    /// Corners of panel 1 [default: only panel 0 is measured]
    #[arg(long, value_name = "x,y x,y x,y x,y", allow_hyphen_values = true)]
    panel1: Option<String>,
    /// Camera: built-in name or CSV file [default: by the photograph's EXIF]
    #[arg(long, value_name = "SPEC")]
    camera: Option<String>,
    #[command(flatten)]
    optics: OpticsArgs,
    /// Curve of the stored numbers; auto: sRGB for 8 bits, linear for the rest
    #[arg(long, value_name = "auto|linear|srgb", default_value = "auto", value_parser = transfer)]
    transfer: Transfer,
    /// Stored number that means no light
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    black_level: Option<f64>,
    /// Stored number that means 1, from which on pixels are clipped
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    white_level: Option<f64>,
    /// Stay this far from the panels' edges
    #[arg(long, value_name = "PX", default_value_t = 0.0, allow_negative_numbers = true)]
    margin: f64,
    /// Value of a perfect white diffuser facing the sun, in its strongest channel, if known
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    exposure: Option<f64>,
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
    let panels = panels(args)?;
    check(args)?;
    let mut reader = Reader::open(&args.scene)?;
    let Some(Record::Scene(mut scene)) = reader.read()? else {
        return Err(Error::Record {
            path: args.scene.clone(),
            line: 1,
            problem: "no scene".to_owned(),
            remedy: "pipe vkernel into vextract, or give --scene FILE".to_owned(),
        });
    };
    let first = open(args, &args.images[0]);
    if let Some(camera) = camera(args, first.as_ref().ok())? {
        scene.set_optics(&args.optics.resolve(camera)?)?;
    }
    if !args.common.no_history {
        scene.fields.add_history("vextract")?;
    }
    let fold = scene.fold()?;
    let id = scene.id()?;
    let samples = std::iter::once(first).chain(args.images[1..].iter().map(|path| open(args, path)));
    let mut made = samples
        .zip(&args.images)
        .map(|(photograph, path)| sample(args, &id, &fold, &panels, path, photograph));
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
            Err(error) => failed(&id, path, &error)?,
        };
        out.sample(&sample)?;
    }
    Ok(())
}

fn panels(args: &Args) -> Result<Vec<Homography>> {
    let given = [("--panel0", &args.panel0), ("--panel1", &args.panel1)];
    let panels: Vec<Homography> = given
        .into_iter()
        .filter_map(|(flag, text)| text.as_ref().map(|text| (flag, text)))
        .map(|(flag, text)| Homography::from_unit_square(parse_corners(flag, text, &PANEL_CORNERS)?))
        .collect::<Result<_>>()?;
    if let [panel0, panel1] = panels.as_slice() {
        let (u, v) = panel0.to_panel(panel1.to_image(0.5, 0.5));
        if (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v) {
            let problem = "the middle of panel 1 lies inside panel 0";
            return Err(Error::usage("--panel1", problem, "the panels meet at the crease and nowhere else"));
        }
    }
    Ok(panels)
}

fn check(args: &Args) -> Result<()> {
    if !(args.margin >= 0.0 && args.margin.is_finite()) {
        return Err(Error::usage(
            "--margin",
            format!("{} is not a distance", args.margin),
            "give pixels, 0 or more",
        ));
    }
    match args.exposure {
        Some(x) if !(x > 0.0 && x.is_finite()) => {
            Err(Error::usage("--exposure", format!("{x} gives no picture"), "give a number above 0"))
        }
        _ => Ok(()),
    }
}

fn open(args: &Args, path: &Path) -> Result<Photograph> {
    Photograph::open(
        path,
        &ReadOptions {
            transfer: args.transfer,
            black_level: args.black_level,
            white_level: args.white_level,
        },
    )
}

/// The camera that was named, or the one that the first photograph names; none only if that cannot be read.
fn camera<'a>(args: &'a Args, first: Option<&Photograph>) -> Result<Option<&'a str>> {
    if let Some(camera) = &args.camera {
        return Ok(Some(camera));
    }
    let Some(info) = first.map(Photograph::info) else { return Ok(None) };
    let (make, model) = (info.make.as_deref().unwrap_or(""), info.model.as_deref().unwrap_or(""));
    match spectrum::camera_by_exif(make, model) {
        Some(camera) => Ok(Some(camera)),
        None => Err(Error::usage(
            "--camera",
            match (make, model) {
                ("", "") => "the photograph names no camera".to_owned(),
                _ => format!("the photograph names '{make} {model}', whose sensitivities are not known"),
            },
            "name one (--list cameras) or give a CSV file",
        )),
    }
}

fn sample(
    args: &Args,
    scene: &str,
    fold: &Fold,
    panels: &[Homography],
    path: &Path,
    photograph: Result<Photograph>,
) -> Result<Sample> {
    let photograph = photograph?;
    let grid = fold.facets();
    let row_edges = fold.spacing().edges(grid.rows);
    let facets = measure(&photograph, panels, &row_edges, grid.cols, args.margin)?;
    if args.common.verbose {
        let clipped: usize = facets.iter().map(|facet| facet.clipped).sum();
        let not_finite: usize = facets.iter().map(|facet| facet.not_finite).sum();
        let transfer = photograph.info().transfer_used.name();
        let text = format!("{transfer} curve, {clipped} clipped and {not_finite} non-finite pixels left out");
        cli::say("vextract", &format!("{}: {text}", path.display()));
    }
    if facets.iter().all(|facet| facet.mean.is_none()) {
        let remedy = "check --panel0, --panel1, --margin and the white level";
        return Err(Error::picture(path, "no facet has a pixel that can be used", remedy));
    }
    let mut sample = Sample::new(scene, &name(path))?;
    sample.set_photograph(
        &ImageRecord::new(path, photograph.info(), panels, args.margin),
        &facets,
        2 * grid.len(),
    )?;
    if let Some(exposure) = args.exposure {
        sample.fields.set("exposure", exposure)?;
    }
    Ok(sample)
}

fn failed(scene: &str, path: &Path, error: &Error) -> Result<Sample> {
    let mut sample = Sample::new(scene, &name(path))?;
    sample.set_error(error)?;
    Ok(sample)
}

/// A sample is called after its photograph.
fn name(path: &Path) -> String {
    path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

fn transfer(text: &str) -> std::result::Result<Transfer, String> {
    text.parse().map_err(|e: Error| e.to_string())
}
