//! Any surface: read from a file, a fold with several creases or curved panels, or a plain fold in light
//! other than the sun and a uniform sky.

use std::path::{Path, PathBuf};

use clap::Args as ClapArgs;
use vfold::kernel::mesh::Mesh;
use vfold::plot::surface::draw;
use vfold::scene::SurfaceSetting;
use vfold::stream::{Output, Scene, Surface, read_shape, write_matrix};
use vfold::surfaces::kernel::SurfaceKernel;
use vfold::surfaces::kernel::patches::{Division, patches};
use vfold::surfaces::kernel::refinement::{Solved, solve};
use vfold::surfaces::{Accordion, Shape};
use vfold::{Error, Result, cli};

use super::fold::{self, Opened};
use super::light::UP;
use super::{Args, MethodName, say_work};

/// Relative error of facet means.
const TOLERANCE: f64 = 5e-3;
/// Least tolerance: the exchange is stored in single precision.
const TOLERANCE_MIN: f64 = 1e-6;

/// Number of facets of curved panels from which the default tolerance takes half a minute or more.
const SLOW: usize = 100;
/// A tolerance that curved panels reach on meshes with a sixteenth of the pairs.
const FAST_TOLERANCE: f64 = 0.01;

/// Surfaces other than a V of flat panels.
#[derive(ClapArgs)]
#[command(next_help_heading = "Shapes")]
pub struct ShapeArgs {
    /// Surface of triangles and flat quadrilaterals, in any unit: one facet each, in the file's order;
    /// corners counter-clockwise seen from the reflecting side. At most 100000, and at most a gigabyte for
    /// pairs that are near or partly hidden
    #[arg(long, value_name = "FILE.obj|.ply|.json",
        conflicts_with_all = ["angle_deg", "panel", "panel1_depth", "facets", "spacing", "folds", "ridge_deg",
            "bow_deg"])]
    shape: Option<PathBuf>,
    /// The surface of --shape reflects on both sides: its backs are as many facets again
    #[arg(long, requires = "shape")]
    two_sided: bool,
    /// Number of creases, 1 to 1000: valleys of --angle-deg and ridges in turn, starting with a valley;
    /// there is one panel more than creases
    #[arg(long, value_name = "N", default_value_t = 1)]
    folds: usize,
    /// Angle between the two panels of a ridge, on its back, degrees [default: that of the valleys]
    #[arg(long, value_name = "DEG")]
    ridge_deg: Option<f64>,
    /// Angle by which each panel curves away from the other between the crease, where they meet at
    /// --angle-deg, and its end, like the pages of an open book; degrees, between -180 and 180; negative:
    /// towards the other, as in a trough
    #[arg(long, visible_alias = "bow", value_name = "DEG", default_value_t = 0.0)]
    bow_deg: f64,
}

impl ShapeArgs {
    /// Whether the surface is other than a V of flat panels.
    pub fn is_shape(&self) -> bool {
        self.shape.is_some() || self.folds != 1 || self.bow_deg != 0.0 || self.ridge_deg.is_some()
    }
}

/// Writes the scene of a surface.
pub fn write(args: &Args, out: &mut Output) -> Result<()> {
    check(args)?;
    let Lit { surface, shape, angle_sd_deg, sun } = lit(args)?;
    if args.plot.is_some() && shape.panels().is_empty() {
        let problem = "the facets of this shape form no rows and columns";
        return Err(Error::usage("--plot", problem, "leave it out, or name groups of facets that do"));
    }
    let sources = args.light.sources(&shape, args.sky, sun)?;
    let (tolerance, mesh) = (args.tolerance.unwrap_or(TOLERANCE), args.mesh.unwrap_or(Mesh::Auto));
    if args.shape.bow_deg != 0.0
        && (mesh, shape.len() >= SLOW, tolerance < FAST_TOLERANCE) == (Mesh::Auto, true, true)
        && !args.common.quiet
    {
        let long = format!("curved panels take about a minute; --tolerance {FAST_TOLERANCE} takes seconds");
        cli::say("vkernel", &long);
    }
    let solved = solve(&shape, &sources, mesh, tolerance)?;
    say_accuracy(args, &solved)?;
    let skipped = solved.kernel.census().skipped();
    let poles = solved.responses.iter().map(|response| response.modes().poles.len()).sum();
    say_work(args, &solved.accuracy, poles, &skipped);
    if let Some(path) = out.saves.take("kernel") {
        save(&path, &shape, &solved, mesh, tolerance)?;
    }
    let mut scene = Scene::of_surface(&args.id, &surface, &sources, &solved.responses)?;
    angle_sd_deg.map_or(Ok(()), |sd_deg| scene.set_angle_sd_deg(sd_deg))?;
    scene.set_accuracy(&mesh.to_string(), tolerance, &solved.accuracy)?;
    skipped.iter().try_for_each(|skip| scene.set_skipped(skip.what, skip.count, skip.why))?;
    if let Some(path) = &args.plot {
        draw(path, &SurfaceSetting { scene: &scene }.facet_light(solved.kernel.facet_row_sums())?)?;
    }
    if !args.common.no_history {
        scene.fields.add_history("vkernel")?;
    }
    out.scene(&scene)
}

/// Writes the form factors between the facets: those of the solution, if it is on facets.
fn save(path: &Path, shape: &Shape, solved: &Solved, mesh: Mesh, tolerance: f64) -> Result<()> {
    let made = match mesh {
        Mesh::Facets => None,
        _ => Some(SurfaceKernel::new(shape, &patches(shape, Division::NONE), tolerance)?),
    };
    let kernel = made.as_ref().unwrap_or(&solved.kernel);
    write_matrix(path, shape.len(), shape.len(), |facet| kernel.matrix_row(facet))
}

/// Refuses flags that apply only to a V of flat panels under the sun and a uniform sky.
fn check(args: &Args) -> Result<()> {
    let (sun_is_elsewhere, remedy) =
        (args.shape.is_shape() || args.light.states_lights(), "give --light X,Y,Z towards the sun");
    let flags = [
        (
            "--method",
            !matches!(args.method, MethodName::Exact),
            "leave it out: shapes have exact form factors",
        ),
        ("--check", args.check, "leave it out: the kernel of a shape is checked as it is made"),
        ("--tilt-deg", sun_is_elsewhere && args.tilt_deg != 0.0, remedy),
        ("--slant-deg", sun_is_elsewhere && args.slant_deg != 0.0, remedy),
    ];
    let (problem, with) = if args.shape.is_shape() {
        ("not for shapes", "on shapes")
    } else {
        ("not with --light, --sky-type or --zenith", "with --light, --sky-type or --zenith")
    };
    if let Some(tolerance) = args.tolerance.filter(|tolerance| *tolerance < TOLERANCE_MIN) {
        let why = "form factors are then stored in single precision";
        let problem = format!("{tolerance:e} cannot be kept {with}: {why}");
        return Err(Error::usage("--tolerance", problem, format!("give {TOLERANCE_MIN:e} to 0.1")));
    }
    flags.into_iter().try_for_each(|(flag, flags, remedy)| cli::refuse([(flag, flags)], problem, remedy))
}

/// A surface among light sources.
struct Lit {
    surface: Surface,
    shape: Shape,
    /// Standard deviation of a fold's angle, degrees, if derived from a photograph.
    angle_sd_deg: Option<f64>,
    /// Direction of the sun if no light is stated.
    sun: [f64; 3],
}

/// The surface described by flags; remarks on it go to standard error.
fn lit(args: &Args) -> Result<Lit> {
    let ShapeArgs { shape: file, two_sided, folds, ridge_deg, bow_deg } = &args.shape;
    if !args.shape.is_shape() {
        let Opened { fold, angle_sd_deg } = fold::fold(args)?;
        let sun = fold::light(args, &fold)?.towards().into();
        return Ok(Lit { surface: Surface::Fold(fold), shape: fold.shape()?, angle_sd_deg, sun });
    }
    let shape = match file {
        None => {
            let valley = fold::fold(args)?.fold;
            let ridge_deg = ridge_deg.unwrap_or(valley.angle_deg());
            Accordion { valley, creases: *folds, ridge_deg, bow_deg: *bow_deg }.shape()?
        }
        Some(path) => {
            let (shape, remarks) = read_shape(path)?;
            if !args.common.quiet {
                remarks
                    .iter()
                    .for_each(|remark| cli::say("vkernel", &format!("{}: {remark}", path.display())));
            }
            if *two_sided && !shape.is_two_sided() { shape.with_backs()? } else { shape }
        }
    };
    Ok(Lit { surface: Surface::Mesh(shape.clone()), shape, angle_sd_deg: None, sun: UP })
}

/// Warns of an accuracy below the expected one, and refuses one below the requested one.
fn say_accuracy(args: &Args, solved: &Solved) -> Result<()> {
    if solved.direct_error > 0.0 && !args.common.quiet {
        let sampled = format!("skylight is sampled: its standard error is up to {:.1e}", solved.direct_error);
        cli::say("vkernel", &sampled);
    }
    let error = solved.accuracy.facet_mean_error;
    let Some(error) = error.filter(|error| *error > args.tolerance.unwrap_or(TOLERANCE)) else {
        return Ok(());
    };
    let problem = format!("on this shape the error of facet means stayed at {error:.1e}");
    if args.tolerance.is_some() {
        return Err(Error::usage("--tolerance", problem, "give a larger tolerance or --mesh facets"));
    }
    if !args.common.quiet {
        cli::say("vkernel", &problem);
    }
    Ok(())
}
