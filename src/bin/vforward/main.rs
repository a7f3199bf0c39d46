//! `vforward`: facet RGB of a folded sheet, as seen by a camera.

mod fluorescence;
mod nonuniform;
mod photograph;
mod render;
mod setup;
mod sheet;
mod subject;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use fluorescence::Emission;
use render::RenderArgs;
use setup::Setup;
use sheet::SheetArgs;
use subject::Subject;
use vfold::cli::{self, Common, KernelArgs, MaterialArgs, OpticsArgs};
use vfold::forward::noise::Noise;
use vfold::paper::bounces::Bounces;
use vfold::scene::Setting;
use vfold::stream::{Output, Reader, Record, Scene};
use vfold::{Error, Result};

const ILLUMINANT: &str = "\
Illuminant: a built-in name, daylight:CCT, a black body such as 2856K, the sun of a cloudless day at an \
angle from the zenith (sun:40deg) or at a place and time (sun:LAT,LON,TIME), or a file. \
Repeated: a picture under each, or, for a shape under several lights, one picture with an illuminant per \
light in their order, skies not counted [default: D65]";

/// Compute the facet RGB of folded sheets of known reflectance
#[derive(Parser)]
#[command(
    name = "vforward",
    version,
    override_usage = "vforward [SCENE] --reflectance <SPEC>... [OPTIONS]\n       \
                      vforward [SCENE] --panel-reflectance 0=<SPEC> --panel-reflectance 1=<SPEC> \
                      [OPTIONS]\n       \
                      vforward [SCENE] --facet-reflectance <FILE.npy>... [OPTIONS]",
    after_help = "Examples:\n  vkernel | vforward --reflectance cc24 --camera sigma-sd-merrill \
                  | vestimate | vscore --table\n  \
                  vkernel --angle-deg 50 | vforward --reflectance cc24:red --render photo.exr > sample.json",
    mut_arg("illuminant", |arg| arg.help(ILLUMINANT))
)]
struct Args {
    /// Scene from vkernel [default: standard input]
    #[arg(value_name = "SCENE", default_value = "-", hide_default_value = true, conflicts_with = "kernel")]
    scene: String,
    /// Reflectances: set, set:member, number from 0 to 1, or file (CSV, CGATS, TM-27, rawtoaces)
    #[arg(long, value_name = "SPEC", num_args = 1..,
        required_unless_present_any =
            ["panel_reflectance", "facet_reflectance", "donaldson", "generate", "list"])]
    reflectance: Vec<String>,
    /// Reflectance of panel P (0 or 1), the other panel being the sheet; if both are stated, panel 0 is
    /// the sheet
    #[arg(long, value_name = "P=SPEC", value_parser = subject::panel_and_spec)]
    panel_reflectance: Vec<(usize, String)>,
    /// Reflectance of every facet, one sample per file: facets (panel, row, column) x wavebands, float64; one
    /// flat patch per facet, no truth in the samples
    #[arg(long, value_name = "FILE.npy", num_args = 1..,
        conflicts_with_all = ["reflectance", "panel_reflectance", "reference_panel", "material", "bounces",
            "render", "sheet"])]
    facet_reflectance: Vec<PathBuf>,
    /// The sheet fluoresces: it emits this fraction of white's light, named as for --reflectance,
    /// wherever the light of --illuminant falls directly
    #[arg(long, value_name = "SPEC",
        conflicts_with_all = ["panel_reflectance", "facet_reflectance", "reference_panel", "material",
            "sheet"])]
    fluorescence: Option<String>,
    /// Donaldson matrices instead of reflectances: all light that falls on a sheet excites it,
    /// ultraviolet and bounced light included. A file has emission wavelengths in the first column and
    /// excitation wavelengths in the header (CSV), or is the export of a Labsphere BFC-450
    #[arg(long, value_name = "FILE", num_args = 1..,
        conflicts_with_all = ["reflectance", "fluorescence", "panel_reflectance", "facet_reflectance",
            "reference_panel", "material", "sheet"])]
    donaldson: Vec<String>,
    /// Camera: built-in name, or a file (CSV, CGATS, rawtoaces JSON)
    #[arg(long, value_name = "SPEC", default_value = "canon-5d-mark-ii")]
    camera: String,
    #[command(flatten)]
    optics: OpticsArgs,
    /// Panel 1 is a card of this reflectance: --panel-reflectance 1=SPEC
    #[arg(long, value_name = "SPEC")]
    reference_panel: Option<String>,
    /// Bounces of light that count: all, the first N (0: direct light only), or as many as the scene's
    /// tolerance requires
    #[arg(long, value_name = "inf|N|auto", default_value = "inf", value_parser = bounces,
        conflicts_with_all = ["material", "sheet"])]
    bounces: BouncesArg,
    /// Value of a perfect white diffuser facing the sun, in its strongest channel, above 0
    #[arg(long, value_name = "X", default_value_t = 1.0)]
    exposure: f64,
    /// Standard deviation of the noise of every facet, on the scale of its value (with --render: of every
    /// pixel of the picture only)
    #[arg(long, value_name = "X", default_value_t = 0.0)]
    noise_sd: f64,
    /// Standard deviation of photon noise at value 1; it grows with the square root of the value
    #[arg(long, value_name = "X", default_value_t = 0.0)]
    photon_noise: f64,
    /// Seed of the noise
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    sheet: SheetArgs,
    #[command(flatten)]
    render: RenderArgs,
    #[command(flatten)]
    materials: MaterialArgs,
    #[command(flatten)]
    kernel: KernelArgs,
    #[command(flatten)]
    common: Common,
}

/// The value of `--bounces`.
#[derive(Clone, Copy)]
enum BouncesArg {
    All,
    First(u32),
    Auto,
}

fn main() -> ExitCode {
    cli::run(|args: &Args| &args.common, tool)
}

fn tool(args: &Args, out: &mut Output) -> Result<()> {
    let noise = noise(args)?;
    args.render.check(args.sheet.shape()?.is_some())?;
    args.optics.known_illuminants("vforward computes what a camera sees in a known light: name it")?;
    let optics = args.optics.resolve(&args.common.camera(&args.camera)?, &args.common)?;
    let emission = Emission::of(args, &optics.grid)?;
    let subject = Subject::of(args, &optics.grid, &emission)?;
    let materials = args.materials.on(&optics.grid, &args.common)?;
    let external = args.kernel.external()?;
    let mut reader = match &external {
        Some(kernel) => Reader::of(kernel.scene()?),
        None => Reader::open(&args.scene)?,
    };
    while let Some(record) = reader.read()? {
        match record {
            Record::Scene(mut scene) => {
                scene.set_optics(&optics)?;
                if !args.common.no_history {
                    scene.fields.add_history("vforward")?;
                }
                skip_unseen(args, &mut scene).map_err(|e| reader.at(e))?;
                subject.card().map_or(Ok(()), |card| scene.set_reference_panel(card))?;
                if !materials.is_empty() {
                    scene.set_materials(&materials)?;
                }
                let setup = Setup::new(args, noise, &scene, external.as_ref(), &emission);
                let setup = setup.map_err(|e| reader.at(e))?;
                let seen = setup.photograph(&subject)?;
                out.scene(&scene)?;
                setup.samples(&subject, &seen, out)?;
                args.render.say_corners(&seen, &args.common);
            }
            other => out.record(&other)?,
        }
    }
    Ok(())
}

fn bounces(text: &str) -> std::result::Result<BouncesArg, String> {
    match text {
        "inf" => Ok(BouncesArg::All),
        "auto" => Ok(BouncesArg::Auto),
        _ => text.parse().map(BouncesArg::First).map_err(|_| "write inf, auto or a whole number".to_owned()),
    }
}

impl BouncesArg {
    /// The bounces included in `scene`.
    fn of(self, scene: &Scene) -> Result<Bounces> {
        Ok(match self {
            Self::All => Bounces::All,
            Self::First(count) => Bounces::First(count),
            Self::Auto => Bounces::Within(scene.tolerance()?),
        })
    }
}

/// Records the wavebands to which no sensor responds: the models omit them.
fn skip_unseen(args: &Args, scene: &mut Scene) -> Result<()> {
    let bands = scene.grid()?.len();
    let unseen = bands - Setting::of(scene)?.open_light()?.seen_bands().len();
    if unseen > 0 && args.common.verbose {
        cli::say("vforward", &format!("skipped {unseen} of {bands} wavebands: no channel sees them"));
    }
    scene.set_skipped("wavebands", unseen, "no sensor sees them")
}

fn noise(args: &Args) -> Result<Noise> {
    for (flag, value) in [("--noise-sd", args.noise_sd), ("--photon-noise", args.photon_noise)] {
        if !(value >= 0.0 && value.is_finite()) {
            return Err(Error::usage(flag, format!("{value} is not a standard deviation"), "give 0 or more"));
        }
    }
    if !(args.exposure > 0.0 && args.exposure.is_finite()) {
        return Err(Error::usage(
            "--exposure",
            format!("{} is out of range", args.exposure),
            "give a number above 0",
        ));
    }
    Ok(Noise { sd: args.noise_sd, photon: args.photon_noise })
}
