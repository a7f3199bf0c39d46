//! `vkernel`: the geometry of a fold or any other surface and its light, as one scene record.

mod fold;
mod light;
mod regions;
mod shape;
mod sky;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use light::LightArgs;
use shape::ShapeArgs;
use vfold::cli::{self, Common};
use vfold::error::counted;
use vfold::geometry::FacetGrid;
use vfold::kernel::mesh::{Accuracy, Mesh};
use vfold::kernel::skipped::Skipped;
use vfold::stream::Output;
use vfold::{Error, Result};

/// Solve the bounces of light in a V-shaped fold or on any other surface, for every reflectance at once
#[derive(Parser)]
#[command(
    name = "vkernel",
    version,
    after_help = "Examples:\n  \
                  vkernel --angle-deg 45 | vforward --reflectance cc24 | vestimate | vscore --table\n  \
                  vkernel --angle-deg 60 --facets 16x16 --save kernel=K.npy > scene.json\n  \
                  vkernel --angle-deg 1 --check\n  \
                  vextract --find photo.exr | vkernel --regions - -o scene.json\n  \
                  vkernel --shape corner.obj --light 1,1,2 | vforward --reflectance cc24 | vestimate\n  \
                  vkernel --sky only --sky-type overcast | vforward --reflectance cc24 | vestimate\n  \
                  vkernel --light point:0,1,3 | vforward --reflectance cc24 | vestimate\n  \
                  vkernel --folds 3 --angle-deg 60 --ridge-deg 100 --facets 6x6"
)]
struct Args {
    /// Angle between the two panels, degrees, above 0 to 180 (flat) [default: that of --regions, or 45]
    #[arg(long, value_name = "DEG")]
    angle_deg: Option<f64>,
    /// Panel size: WIDTH along the crease, DEPTH away from it; only the ratio matters [default: that of
    /// --regions, or 1x1]
    #[arg(long, value_name = "WIDTHxDEPTH", value_parser = cli::pair::<f64>)]
    panel: Option<(f64, f64)>,
    /// Take angle and panels from the output of vextract --find, - for standard input; other files need
    /// the corners of both panels and the picture's size
    #[arg(long, value_name = "FILE", conflicts_with_all = ["shape", "folds", "ridge_deg", "bow_deg"])]
    regions: Option<PathBuf>,
    /// Depth of panel 1, in the unit of --panel, if it differs from panel 0's
    #[arg(long, value_name = "DEPTH")]
    panel1_depth: Option<f64>,
    /// Facets per panel, over which colour is averaged: ROWS away from the crease, COLS along it
    #[arg(long, value_name = "ROWSxCOLS", default_value = "10x10", value_parser = cli::pair::<usize>)]
    facets: (usize, usize),
    /// Rows of equal depth, or graded: narrow at the crease, where colour varies
    #[arg(long, value_name = "SPACING", default_value = "uniform")]
    spacing: SpacingName,
    /// Method for the form factors: exact to rounding, Monte Carlo as in the paper, or eq. (2) at facet
    /// centres, which is far off at the crease; the last two are for comparison
    #[arg(long, value_name = "METHOD", default_value = "exact")]
    method: MethodName,
    /// Monte Carlo from pairs of points spread evenly over two facets (the paper's method; its variance
    /// is infinite where facets meet at the crease), or from rays with the cosine law [default: area]
    #[arg(long, value_name = "SAMPLING")]
    sampling: Option<SamplingName>,
    /// Samples per form factor (point pairs), or per facet row (rays), 2 or more [default: 10000]
    #[arg(long, value_name = "N")]
    samples: Option<u32>,
    /// Seed of the samples [default: 0]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Instead of a scene, report how well the form factors of the facets (or of the patches of --mesh)
    /// satisfy reciprocity and energy conservation; exit status 1 if one is violated
    #[arg(long)]
    check: bool,
    /// Mesh on which interreflections are solved: auto, as fine as needed; facets, one flat patch per facet
    /// (the paper's model); ROWS times COLS patches per panel; on a shape, CELLS along each side of a facet
    /// [default: auto; facets unless --method is exact]
    #[arg(long, value_name = "auto|facets|ROWSxCOLS|CELLS", value_parser = mesh)]
    mesh: Option<Mesh>,
    /// Relative error of facet means that --mesh auto may leave, for reflectances up to 1, 1e-12 to 0.1; on
    /// shapes and with --light 1e-6 to 0.1, for reflectances up to 0.9, relative to a tenth of the mean for
    /// dark facets [default: 1e-5, or the least that a narrow fold allows; on shapes 5e-3, or the least
    /// possible]
    #[arg(long, value_name = "X")]
    tolerance: Option<f64>,
    /// Angle of the sun off the bisecting plane of the fold, degrees, less than half of --angle-deg;
    /// positive lights panel 0 more
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    tilt_deg: f64,
    /// Angle by which the sun leans along the crease, degrees, between -90 and 90
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    slant_deg: f64,
    /// Diffuse-to-direct ratio: irradiance by the sky, uniform or of --sky-type, relative to the sun's;
    /// on an open plane facing the sun, or, for a sky with a horizon, on an open horizontal plane.
    /// sun:40deg or sun:LAT,LON,TIME: that of a cloudless sky with the sun there; only: no sun, and a sky
    /// of irradiance 1
    #[arg(long, value_name = "F|sun:WHERE|only", default_value_t = 0.0,
        value_parser = sky::share)]
    sky: f64,
    /// Name of the scene
    #[arg(long, default_value = "fold")]
    id: String,
    /// Draw maps of the light exchanged between facets and of the direct light on them
    #[arg(long, value_name = "FILE.svg|.png", value_parser = cli::drawing, conflicts_with = "check")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    shape: ShapeArgs,
    #[command(flatten)]
    light: LightArgs,
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

/// What `--method` takes.
#[derive(Clone, Copy, ValueEnum)]
enum MethodName {
    /// Right to rounding.
    Exact,
    /// Estimated from samples.
    MonteCarlo,
    /// Eq. (2) at the facets' centres.
    Midpoint,
}

/// What `--sampling` takes.
#[derive(Clone, Copy, ValueEnum)]
enum SamplingName {
    /// Pairs of points.
    Area,
    /// Rays with the cosine law.
    Cosine,
}

fn main() -> ExitCode {
    cli::run(|args: &Args| &args.common, tool)
}

fn tool(args: &Args, out: &mut Output) -> Result<()> {
    if let Some(tolerance) = args.tolerance.filter(|tolerance| !(1e-12..=0.1).contains(tolerance)) {
        return Err(Error::usage("--tolerance", format!("{tolerance} is out of range"), "give 1e-12 to 0.1"));
    }
    let is_any = args.shape.is_shape() || args.light.is_present();
    if is_any { shape::write(args, out) } else { fold::write(args, out) }
}

/// With `--verbose`, reports the work done and skipped.
fn say_work(args: &Args, accuracy: &Accuracy, poles: usize, skipped: &[Skipped]) {
    if !args.common.verbose {
        return;
    }
    let error = accuracy.facet_mean_error.map_or("not estimated".to_owned(), |error| format!("{error:.1e}"));
    let (unknowns, poles) = (counted(accuracy.unknowns, "unknown"), counted(poles, "pole"));
    cli::say("vkernel", &format!("{unknowns}, {poles}, error of facet means {error}"));
    for Skipped { what, count, why } in skipped {
        cli::say("vkernel", &format!("skipped {what} ({count}): {why}"));
    }
}

fn mesh(text: &str) -> std::result::Result<Mesh, String> {
    match text {
        "auto" => Ok(Mesh::Auto),
        "facets" => Ok(Mesh::Facets),
        _ => match (text.parse(), cli::pair(text)) {
            (Ok(cells @ 1..=100), _) => Ok(Mesh::Cells(cells)),
            (_, Ok((rows, cols))) => Ok(Mesh::Patches(FacetGrid { rows, cols })),
            _ => Err("write auto, facets, patches such as 40x40, or cells such as 4".to_owned()),
        },
    }
}
