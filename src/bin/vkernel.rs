//! `vkernel`: the geometry of a fold and its light, as one scene record.

use std::path::Path;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use vfold::cli::{self, Common, ToolArgs};
use vfold::geometry::{FacetGrid, Fold, Light, Spacing};
use vfold::kernel::check::check;
use vfold::kernel::mesh::{Accuracy, Mesh, respond_by};
use vfold::kernel::monte_carlo::{MonteCarlo, Sampling};
use vfold::kernel::skipped::{Skipped, skipped};
use vfold::kernel::{FoldKernel, Method, exact};
use vfold::stream::{Output, Scene, write_matrix};
use vfold::{Error, Result};

/// Relative error of facet means: below what a camera sees.
const TOLERANCE: f64 = 1e-5;
/// Samples of a Monte Carlo estimate.
const SAMPLES: u32 = 10_000;

/// Solve the bounces of light in a V-shaped fold, for every reflectance at once
#[derive(Parser)]
#[command(
    name = "vkernel",
    version,
    after_help = "Examples:\n  vkernel --angle-deg 45 | vforward --reflectance cc24 | vestimate | vscore --table\n  \
                  vkernel --angle-deg 60 --facets 16x16 --save kernel=K.npy > scene.json\n  \
                  vkernel --angle-deg 1 --check"
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
    /// How form factors are found: right to rounding, estimated from samples as in the paper, or eq. (2) at the facets' centres,
    /// which is far off at the crease; the last two are for comparison
    #[arg(long, value_name = "METHOD", default_value = "exact")]
    method: MethodName,
    /// Monte Carlo from pairs of points even over two facets (the paper's way; its variance is infinite where facets meet at
    /// the crease), or from rays with the cosine law [default: area]
    #[arg(long, value_name = "SAMPLING")]
    sampling: Option<SamplingName>,
    /// Pairs of points a distinct entry, or rays a row of facets [default: 10000]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    samples: Option<u32>,
    /// Seed of the samples [default: 0]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Instead of a scene, print what the form factors of the facets (or of the patches of --mesh) make of the laws of light; exit
    /// status 1 if one is broken
    #[arg(long)]
    check: bool,
    /// Where the bounces are solved: as fine as needed, one flat patch a facet (the paper's model), or given patches [default:
    /// auto; facets unless --method is exact]
    #[arg(long, value_name = "auto|facets|ROWSxCOLS", value_parser = mesh)]
    mesh: Option<Mesh>,
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
    let (fold, method) = (fold(args)?, method(args)?);
    if args.check { report(args, &fold, method, out) } else { scene(args, &fold, method, out) }
}

/// Solves the bounces and writes the scene.
fn scene(args: &Args, fold: &Fold, method: Method, out: &mut Output) -> Result<()> {
    let light = Light::new(fold, args.tilt_deg, args.slant_deg, args.sky)?;
    let tolerance = args.tolerance.unwrap_or(TOLERANCE);
    let default = if method == Method::Exact { Mesh::Auto } else { Mesh::Facets };
    let mesh = args.mesh.unwrap_or(default);
    let (response, accuracy) = respond_by(method, fold, mesh, tolerance)?;
    say_accuracy(args, fold, &accuracy)?;
    let skipped = skipped(fold, &light, &accuracy, response.poles().len());
    if args.common.verbose {
        let error =
            accuracy.facet_mean_error.map_or("not estimated".to_owned(), |error| format!("{error:.1e}"));
        let (unknowns, poles) = (accuracy.unknowns, response.poles().len());
        cli::say("vkernel", &format!("{unknowns} unknowns, {poles} poles, facet means' error {error}"));
        for Skipped { what, count, why } in &skipped {
            cli::say("vkernel", &format!("skipped {count} {what}: {why}"));
        }
    }
    let mut scene = Scene::new(&args.id, fold, &light, &response)?;
    scene.set_accuracy(&mesh.to_string(), tolerance, &accuracy)?;
    skipped.iter().try_for_each(|skip| scene.set_skipped(skip.what, skip.count, skip.why))?;
    if let Some(path) = out.saves.take("kernel") {
        save(&path, &method.form_factors(fold).0)?;
    }
    if !args.common.no_history {
        scene.fields.add_history("vkernel")?;
    }
    out.scene(&scene)
}

/// Prints what a kernel makes of the laws of light.
fn report(args: &Args, fold: &Fold, method: Method, out: &mut Output) -> Result<()> {
    let fold = match args.mesh {
        Some(Mesh::Patches(patches)) => fold.with_facets(patches)?,
        _ => *fold,
    };
    let (kernel, entry_sd) = method.form_factors(&fold);
    warn_of_spread(args, method, entry_sd);
    if let Some(path) = out.saves.take("kernel") {
        save(&path, &kernel)?;
    }
    let laws = match method {
        Method::Exact => check(&kernel, &kernel),
        _ => check(&kernel, &exact::form_factors(&fold)),
    };
    laws.iter().try_for_each(|law| out.text(&law.to_string()))?;
    let broken: Vec<_> = laws.iter().filter(|law| !law.holds()).map(|law| law.name).collect();
    if broken.is_empty() { Ok(()) } else { Err(Error::BrokenLaw(broken.join("; "))) }
}

/// Warns of an accuracy below what was expected, and refuses one below what was asked for.
fn say_accuracy(args: &Args, fold: &Fold, accuracy: &Accuracy) -> Result<()> {
    if let Some(source) = accuracy.kernel {
        warn_of_spread(args, source.method, source.entry_sd);
    }
    let tolerance = args.tolerance.unwrap_or(TOLERANCE);
    if accuracy.residual > tolerance && !args.common.quiet {
        let left =
            format!("Lanczos' method stopped at a residual of {:.1e}: too many bounces", accuracy.residual);
        cli::say("vkernel", &left);
    }
    let Some(error) = accuracy.facet_mean_error.filter(|error| *error > tolerance) else { return Ok(()) };
    let problem =
        format!("{error:.1e} is the least error of the facet means that is reached at {}°", fold.angle_deg());
    if args.tolerance.is_some() {
        return Err(Error::usage("--tolerance", problem, "give a larger tolerance or --mesh facets"));
    }
    if !args.common.quiet {
        cli::say("vkernel", &problem);
    }
    Ok(())
}

/// The standard error of pairs of points misleads, and says so.
fn warn_of_spread(args: &Args, method: Method, entry_sd: Option<f64>) {
    if let (Method::MonteCarlo(estimate), Some(sd), false) = (method, entry_sd, args.common.quiet)
        && estimate.sampling() == Sampling::Area
    {
        let warning = format!(
            "form factors have standard errors of up to {sd:.1e}, likely more: the variance of pairs of points is infinite \
             at the crease; --sampling cosine has a finite one"
        );
        cli::say("vkernel", &warning);
    }
}

fn save(path: &Path, kernel: &FoldKernel) -> Result<()> {
    let facets = 2 * kernel.facets().len();
    write_matrix(path, facets, facets, |facet| kernel.matrix_row(facet))
}

fn method(args: &Args) -> Result<Method> {
    let given = [
        ("--sampling", args.sampling.is_some()),
        ("--samples", args.samples.is_some()),
        ("--seed", args.seed.is_some()),
    ];
    let unused = given.into_iter().find(|(_, given)| *given);
    match (args.method, unused) {
        (MethodName::MonteCarlo, _) => {
            let sampling = match args.sampling {
                None | Some(SamplingName::Area) => Sampling::Area,
                Some(SamplingName::Cosine) => Sampling::Cosine,
            };
            let (samples, seed) = (args.samples.unwrap_or(SAMPLES), args.seed.unwrap_or_default());
            Ok(Method::MonteCarlo(MonteCarlo::new(sampling, samples, seed)?))
        }
        (_, Some((flag, _))) => {
            Err(Error::usage(flag, "there is nothing to sample", "add --method monte-carlo"))
        }
        (MethodName::Exact, None) => Ok(Method::Exact),
        (MethodName::Midpoint, None) => Ok(Method::Midpoint),
    }
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
