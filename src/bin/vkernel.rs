//! `vkernel`: the geometry of a fold and its light, as one scene record.

use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use vfold::cli::{self, Common, ToolArgs};
use vfold::geometry::{FacetGrid, Fold, Light, Spacing};
use vfold::kernel::exact::form_factors;
use vfold::kernel::mesh::{Mesh, respond};
use vfold::stream::{Output, Scene, write_matrix};
use vfold::{Error, Result};

/// Relative error of facet means: below what a camera sees.
const TOLERANCE: f64 = 1e-5;

/// Solve the bounces of light in a V-shaped fold, for every reflectance at once
#[derive(Parser)]
#[command(
    name = "vkernel",
    version,
    after_help = "Examples:\n  vkernel --angle-deg 45 | vforward --reflectance cc24 | vestimate | vscore --table\n  \
                  vkernel --angle-deg 60 --facets 16x16 --save kernel=K.npy > scene.json"
)]
struct Args {
    /// Angle between the two panels, degrees
    #[arg(long, value_name = "DEG", default_value_t = 45.0, allow_negative_numbers = true)]
    angle_deg: f64,
    /// Panel along the crease x away from it; only the ratio matters
    #[arg(long, value_name = "WIDTHxDEPTH", default_value = "1x1", value_parser = cli::pair::<f64>)]
    panel: (f64, f64),
    /// Depth of panel 1, in the unit of --panel, if it is not that of panel 0
    #[arg(long, value_name = "DEPTH", allow_negative_numbers = true)]
    panel1_depth: Option<f64>,
    /// Facets of a panel, rows away from the crease x columns along it: where colour is measured
    #[arg(long, value_name = "ROWSxCOLS", default_value = "10x10", value_parser = cli::pair::<usize>)]
    facets: (usize, usize),
    /// Rows of equal depth, or graded: narrow at the crease, where colour varies
    #[arg(long, value_name = "SPACING", default_value = "uniform")]
    spacing: SpacingName,
    /// Where the bounces are solved: as fine as needed, one flat patch a facet (the paper's model), or given patches
    #[arg(long, value_name = "auto|facets|ROWSxCOLS", default_value = "auto", value_parser = mesh)]
    mesh: Mesh,
    /// Relative error of facet means that --mesh auto may leave, for any reflectance up to 1 [default: 1e-5, or as near as it
    /// gets on a narrow fold]
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// Angle of the sun off the plane that halves the fold, degrees; positive lights panel 0 more
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true)]
    tilt_deg: f64,
    /// Angle of the sun along the crease, degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true)]
    slant_deg: f64,
    /// Uniform sky: its irradiance on an open plane facing the sun, relative to the sun's
    #[arg(long, value_name = "F", default_value_t = 0.0, allow_negative_numbers = true)]
    sky: f64,
    /// Name of the scene
    #[arg(long, default_value = "fold")]
    id: String,
    #[command(flatten)]
    common: Common,
}

/// What `--spacing` takes.
#[derive(Clone, Copy, ValueEnum)]
enum SpacingName {
    /// Rows of equal depth.
    Uniform,
    /// Row n ends at (n/rows)² of the depth.
    Graded,
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
    if let Some(tolerance) = args.tolerance.filter(|tolerance| !(1e-12..=0.1).contains(tolerance)) {
        return Err(Error::usage("--tolerance", format!("{tolerance} is out of range"), "give 1e-12 to 0.1"));
    }
    let fold = fold(args)?;
    let light = Light::new(&fold, args.tilt_deg, args.slant_deg, args.sky)?;
    let tolerance = args.tolerance.unwrap_or(TOLERANCE);
    let (response, accuracy) = respond(&fold, args.mesh, tolerance)?;
    if let Some(error) = accuracy.facet_mean_error.filter(|error| *error > tolerance) {
        let problem = format!(
            "{error:.1e} is the least error of the facet means that is reached at {}°",
            fold.angle_deg()
        );
        if args.tolerance.is_some() {
            return Err(Error::usage("--tolerance", problem, "give a larger tolerance or --mesh facets"));
        }
        if !args.common.quiet {
            cli::say("vkernel", &problem);
        }
    }
    let mut scene = Scene::new(&args.id, &fold, &light, &response)?;
    scene.set_accuracy(&args.mesh.to_string(), tolerance, &accuracy)?;
    if args.common.verbose {
        let error =
            accuracy.facet_mean_error.map_or("not estimated".to_owned(), |error| format!("{error:.1e}"));
        let poles = response.poles().len();
        cli::say(
            "vkernel",
            &format!("{} unknowns, {poles} poles, facet means' error {error}", accuracy.unknowns),
        );
    }
    if let Some(path) = out.saves.take("kernel") {
        let (kernel, facets) = (form_factors(&fold), 2 * fold.facets().len());
        write_matrix(&path, facets, facets, |facet| kernel.matrix_row(facet))?;
    }
    if !args.common.no_history {
        scene.fields.add_history("vkernel")?;
    }
    out.scene(&scene)
}

fn fold(args: &Args) -> Result<Fold> {
    let facets = FacetGrid { rows: args.facets.0, cols: args.facets.1 };
    let fold = Fold::new(args.angle_deg, args.panel.0, args.panel.1, facets)?;
    let fold = args.panel1_depth.map_or(Ok(fold), |depth| fold.with_panel1_depth(depth))?;
    Ok(fold.with_spacing(match args.spacing {
        SpacingName::Uniform => Spacing::Uniform,
        SpacingName::Graded => Spacing::Graded,
    }))
}

fn mesh(text: &str) -> std::result::Result<Mesh, String> {
    match text {
        "auto" => Ok(Mesh::Auto),
        "facets" => Ok(Mesh::Facets),
        _ => cli::pair(text)
            .map(|(rows, cols)| Mesh::Patches(FacetGrid { rows, cols }))
            .map_err(|_| "write auto, facets, or patches such as 40x40".to_owned()),
    }
}
