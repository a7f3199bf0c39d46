//! `vforward`: what a camera sees of a folded sheet.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use nalgebra::DMatrix;
use rayon::prelude::*;
use vfold::camera::CameraResponse;
use vfold::cli::{self, Common, OpticsArgs, ToolArgs};
use vfold::colorimetry::{Colorimeter, Observer};
use vfold::forward::noise::Noise;
use vfold::forward::render::{Picture, View};
use vfold::forward::{FacetModel, Lighting};
use vfold::spectrum::{self, Outside, Spectrum, WavelengthGrid};
use vfold::stream::{Output, Reader, Record, ReferencePanel, ReflectanceRecord, Sample, Scene};
use vfold::{Error, Result};

/// Samples computed before any is written.
const BATCH: usize = 64;

/// Compute the facet RGB of folded sheets of known reflectance
#[derive(Parser)]
#[command(
    name = "vforward",
    version,
    override_usage = "vforward [SCENE] --reflectance <SPEC>... [OPTIONS]",
    after_help = "Examples:\n  vkernel | vforward --reflectance cc24 --camera sigma-sd-merrill | vestimate | vscore --table\n  \
                  vkernel --angle-deg 50 | vforward --reflectance cc24:red --render photo.exr > sample.json"
)]
struct Args {
    /// Scene from vkernel [default: standard input]
    #[arg(value_name = "SCENE", default_value = "-", hide_default_value = true)]
    scene: String,
    /// Reflectances: set, set:member, number, or CSV file
    #[arg(long, value_name = "SPEC", num_args = 1.., required_unless_present_any = ["generate", "list"])]
    reflectance: Vec<String>,
    /// Camera: built-in name or CSV file
    #[arg(long, value_name = "SPEC", default_value = "canon-5d-mark-ii")]
    camera: String,
    #[command(flatten)]
    optics: OpticsArgs,
    /// Panel 1 is a card of this reflectance; panel 0 is the sheet
    #[arg(long, value_name = "SPEC")]
    reference_panel: Option<String>,
    /// Value of a perfect white diffuser facing the sun, in its strongest channel
    #[arg(long, value_name = "X", default_value_t = 1.0, allow_negative_numbers = true)]
    exposure: f64,
    /// Standard deviation of noise on every facet (with --render: on every pixel of the picture only)
    #[arg(long, value_name = "X", default_value_t = 0.0, allow_negative_numbers = true)]
    noise_sd: f64,
    /// Standard deviation of photon noise at value 1; it grows with the root of the signal
    #[arg(long, value_name = "X", default_value_t = 0.0, allow_negative_numbers = true)]
    photon_noise: f64,
    /// Seed of the noise
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Also take a photograph of the first sheet: camera RGB as .exr or 16-bit .tif, or for the eye as .png (sRGB)
    #[arg(long, value_name = "FILE")]
    render: Option<PathBuf>,
    /// Size of the photograph
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "640x480", value_parser = cli::pair::<usize>)]
    render_size: (usize, usize),
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
    let noise = noise(args)?;
    let sheets: Vec<Spectrum> = args
        .reflectance
        .iter()
        .map(|spec| spectrum::reflectances(spec))
        .collect::<Result<Vec<_>>>()?
        .concat();
    let optics = args.optics.resolve(&args.camera)?;
    let card = args.reference_panel.as_deref().map(|spec| card(spec, &optics.grid)).transpose()?;
    let mut reader = Reader::open(&args.scene)?;
    while let Some(record) = reader.read()? {
        match record {
            Record::Scene(mut scene) => {
                scene.set_optics(&optics)?;
                card.as_ref().map_or(Ok(()), |card| scene.set_reference_panel(card))?;
                if !args.common.no_history {
                    scene.fields.add_history("vforward")?;
                }
                let model = scene.model().map_err(|e| reader.at(e))?;
                photograph(args, &scene, &sheets, noise)?;
                out.scene(&scene)?;
                samples(args, &model, &scene.id()?, &sheets, noise, out)?;
            }
            other => out.record(&other)?,
        }
    }
    Ok(())
}

fn card(spec: &str, grid: &WavelengthGrid) -> Result<ReferencePanel> {
    let card = cli::one_reflectance("--reference-panel", spec)?;
    Ok(ReferencePanel { name: card.name().to_owned(), reflectance: card.on(grid, Outside::Refuse)? })
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
            format!("{} gives no picture", args.exposure),
            "give a number above 0",
        ));
    }
    Ok(Noise { sd: args.noise_sd, photon: args.photon_noise })
}

fn samples(
    args: &Args,
    model: &FacetModel,
    scene: &str,
    sheets: &[Spectrum],
    noise: Noise,
    out: &mut Output,
) -> Result<()> {
    // A photograph has its own noise, pixel by pixel.
    let noise = if args.render.is_some() { Noise::default() } else { noise };
    let numbered: Vec<_> = sheets.iter().enumerate().collect();
    for batch in numbered.chunks(BATCH) {
        let made: Vec<Result<Sample>> =
            batch.par_iter().map(|(n, sheet)| sample(args, model, scene, sheet, noise, *n as u64)).collect();
        made.into_iter().try_for_each(|sample| out.sample(&sample?))?;
    }
    Ok(())
}

fn sample(
    args: &Args,
    model: &FacetModel,
    scene: &str,
    sheet: &Spectrum,
    noise: Noise,
    stream: u64,
) -> Result<Sample> {
    let grid = &args.optics.wavelengths_nm;
    let reflectance = sheet.on(grid, Outside::Refuse)?;
    let clean = args.exposure * model.facet_rgb(&reflectance);
    let mut values = clean.transpose().as_slice().to_vec();
    noise.add(&mut values, args.seed, stream);
    let rows = |values: &[f64]| values.chunks(clean.ncols()).map(|rgb| Some(rgb.to_vec())).collect();
    let mut sample = Sample::new(scene, sheet.name())?;
    let sd: Vec<f64> = clean.transpose().iter().map(|signal| noise.sd_at(*signal)).collect();
    sample.set_facets(&rows(&values), (!noise.is_none()).then(|| rows(&sd)).as_ref())?;
    sample.fields.set("exposure", args.exposure)?;
    sample.set_truth(&ReflectanceRecord { wavelengths_nm: grid.wavelengths_nm().to_vec(), reflectance })?;
    Ok(sample)
}

/// Takes the photograph that `--render` asks for, and says where the panels are in it.
fn photograph(args: &Args, scene: &Scene, sheets: &[Spectrum], noise: Noise) -> Result<()> {
    let (Some(path), Some(sheet)) = (&args.render, sheets.first()) else { return Ok(()) };
    let view = View::of(&scene.fold()?, args.render_size.0, args.render_size.1)?;
    let for_screen = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
    let lighting = if for_screen { screen(args, scene)? } else { scene.lighting()? };
    let reflectance = sheet.on(&args.optics.wavelengths_nm, Outside::Refuse)?;
    let light: DMatrix<f64> =
        args.exposure * scene.fine_model(view.grid(), &lighting)?.facet_rgb(&reflectance);
    let mut picture = Picture::take(&view, &light);
    noise.add(picture.pixels_mut(), args.seed, u64::MAX);
    if for_screen {
        picture.save_for_screen(path)?;
    } else {
        picture.save(path)?;
    }
    if !args.common.quiet {
        let [panel0, panel1] = view
            .corners()
            .map(|corners| corners.map(|corner| format!("{:.2},{:.2}", corner.x, corner.y)).join(" "));
        cli::say(
            "vforward",
            &format!("{} has its corners at --panel0 \"{panel0}\" --panel1 \"{panel1}\"", path.display()),
        );
    }
    Ok(())
}

/// The scene as an eye sees it that is adapted to the light.
fn screen(args: &Args, scene: &Scene) -> Result<Lighting> {
    let illuminant = spectrum::illuminant(&args.optics.illuminant)?;
    let eye = Colorimeter::new(&args.optics.wavelengths_nm, &illuminant, Observer::Cie1931_2deg)?;
    let response = CameraResponse::from_weights(eye.screen_weights());
    Ok(Lighting { light: scene.light()?, sun: response.clone(), sky: response })
}
