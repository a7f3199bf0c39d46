//! The V-shaped fold, whose exchange has its own formulas.

use std::path::Path;

use vfold::cli::{self, refuse};
use vfold::geometry::{FacetGrid, Fold, Light, Spacing};
use vfold::kernel::mesh::{Accuracy, Mesh, TOLERANCE};
use vfold::kernel::skipped::skipped;
use vfold::paper::check::check;
use vfold::paper::monte_carlo::{MonteCarlo, Sampling};
use vfold::paper::{FoldKernel, Method, form_factors, respond};
use vfold::plot::surface::draw;
use vfold::scene::FoldSetting;
use vfold::stream::{Output, Scene, write_matrix};
use vfold::{Error, Result};

use super::{Args, MethodName, SamplingName, SpacingName, regions, say_work};

/// Facet means with a larger error are useless.
const USELESS: f64 = 0.05;
/// Up to this angle light bounces more often between undivided panels than the Lanczos method can resolve,
/// whatever their sides: facet means would be entirely wrong.
const TOO_NARROW_DEG: f64 = 0.2;
/// Samples of a Monte Carlo estimate.
const SAMPLES: u32 = 10_000;

/// Writes the scene of a fold, or the test of its kernel against the laws of light.
pub fn write(args: &Args, out: &mut Output) -> Result<()> {
    let Opened { fold, angle_sd_deg } = fold(args)?;
    let method = method(args)?;
    if args.check {
        report(args, &fold, method, out)
    } else {
        scene(args, (&fold, angle_sd_deg), method, out)
    }
}

/// Solves the bounces and writes the scene.
fn scene(
    args: &Args,
    (fold, angle_sd_deg): (&Fold, Option<f64>),
    method: Method,
    out: &mut Output,
) -> Result<()> {
    let light = light(args, fold)?;
    let tolerance = args.tolerance.unwrap_or(TOLERANCE);
    let default = if method == Method::Exact { Mesh::Auto } else { Mesh::Facets };
    let mesh = args.mesh.unwrap_or(default);
    if mesh == Mesh::Auto && fold.angle_deg() <= TOO_NARROW_DEG {
        let problem = format!("at {}° light bounces too often for --mesh auto", fold.angle_deg());
        let remedy = format!("give more than {TOO_NARROW_DEG}°, or --mesh facets");
        return Err(Error::usage("--angle-deg", problem, remedy));
    }
    let (response, accuracy) = respond(method, fold, mesh, tolerance)?;
    say_accuracy(args, method, fold, &accuracy)?;
    let skipped = skipped(fold, &light, &accuracy, response.poles().len());
    say_work(args, &accuracy, response.poles().len(), &skipped);
    let mut scene = Scene::new(&args.id, fold, &light, &response)?;
    angle_sd_deg.map_or(Ok(()), |sd_deg| scene.set_angle_sd_deg(sd_deg))?;
    scene.set_accuracy(&mesh.to_string(), tolerance, &accuracy)?;
    skipped.iter().try_for_each(|skip| scene.set_skipped(skip.what, skip.count, skip.why))?;
    if let Some(path) = out.saves.take("kernel") {
        FoldKernel::check_room(fold)?;
        save(&path, &method.form_factors(fold).0)?;
    }
    args.plot.as_ref().map_or(Ok(()), |path| draw(path, &FoldSetting::of(&scene)?.facet_light()))?;
    if !args.common.no_history {
        scene.fields.add_history("vkernel")?;
    }
    out.scene(&scene)
}

/// The sun in the direction stated by flags, and the sky.
pub fn light(args: &Args, fold: &Fold) -> Result<Light> {
    if args.sky.is_infinite() {
        let flags = [("--tilt-deg", args.tilt_deg != 0.0), ("--slant-deg", args.slant_deg != 0.0)];
        refuse(flags, "with --sky only there is no sun", "leave it out, or give --sky a number")?;
    }
    Light::new(fold, args.tilt_deg, args.slant_deg, args.sky)
}

/// Prints the test of a kernel against the laws of light.
fn report(args: &Args, fold: &Fold, method: Method, out: &mut Output) -> Result<()> {
    let fold = match args.mesh {
        Some(Mesh::Patches(patches)) => fold.with_facets(patches)?,
        _ => *fold,
    };
    FoldKernel::check_room(&fold)?;
    let (kernel, entry_sd) = method.form_factors(&fold);
    warn_of_spread(args, method, entry_sd);
    if let Some(path) = out.saves.take("kernel") {
        save(&path, &kernel)?;
    }
    let laws = match method {
        Method::Exact => check(&kernel, &kernel),
        _ => check(&kernel, &form_factors(&fold)),
    };
    laws.iter().try_for_each(|law| out.text(&law.to_string()))?;
    let broken: Vec<_> = laws.iter().filter(|law| !law.holds()).map(|law| law.name).collect();
    if broken.is_empty() { Ok(()) } else { Err(Error::BrokenLaw(broken.join("; "))) }
}

/// Warns of an accuracy below the expected one, and refuses one below the requested one.
fn say_accuracy(args: &Args, method: Method, fold: &Fold, accuracy: &Accuracy) -> Result<()> {
    if let Some(source) = accuracy.kernel {
        warn_of_spread(args, method, source.entry_sd);
    }
    let tolerance = args.tolerance.unwrap_or(TOLERANCE);
    let too_large = accuracy.facet_mean_error.filter(|error| *error > tolerance).map(|error| {
        let angle_deg = fold.angle_deg();
        (error, format!("at {angle_deg}° the error of facet means stayed at {error:.1e}"))
    });
    match &too_large {
        Some((_, problem)) if args.tolerance.is_some() => {
            return Err(Error::usage("--tolerance", problem, "give a larger tolerance or --mesh facets"));
        }
        Some((error, problem)) if *error > USELESS => {
            return Err(Error::usage("--angle-deg", problem, "give a wider angle or --mesh facets"));
        }
        _ if args.common.quiet => return Ok(()),
        _ => {}
    }
    if accuracy.residual > tolerance {
        let left =
            format!("Lanczos iteration stopped at a residual of {:.1e}: too many bounces", accuracy.residual);
        cli::say("vkernel", &left);
    }
    if let Some((_, problem)) = too_large {
        cli::say("vkernel", &problem);
    }
    Ok(())
}

/// Warns that the standard error of pairs of points is misleading.
fn warn_of_spread(args: &Args, method: Method, entry_sd: Option<f64>) {
    if let (Method::MonteCarlo(estimate), Some(sd), false) = (method, entry_sd, args.common.quiet)
        && estimate.sampling() == Sampling::Area
    {
        let warning = format!(
            "form factors have standard errors of up to {sd:.1e}, probably more: \
             point pairs have infinite variance at the crease; --sampling cosine avoids that"
        );
        cli::say("vkernel", &warning);
    }
}

fn save(path: &Path, kernel: &FoldKernel) -> Result<()> {
    let facets = 2 * kernel.facets().len();
    write_matrix(path, facets, facets, |facet| kernel.matrix_row(facet))
}

fn method(args: &Args) -> Result<Method> {
    let flags = [
        ("--sampling", args.sampling.is_some()),
        ("--samples", args.samples.is_some()),
        ("--seed", args.seed.is_some()),
    ];
    let refuse_samples = || refuse(flags, "there is nothing to sample", "add --method monte-carlo");
    match args.method {
        MethodName::MonteCarlo => {
            let sampling = match args.sampling {
                None | Some(SamplingName::Area) => Sampling::Area,
                Some(SamplingName::Cosine) => Sampling::Cosine,
            };
            let (samples, seed) = (args.samples.unwrap_or(SAMPLES), args.seed.unwrap_or_default());
            Ok(Method::MonteCarlo(MonteCarlo::new(sampling, samples, seed)?))
        }
        MethodName::Exact => refuse_samples().map(|()| Method::Exact),
        MethodName::Midpoint => refuse_samples().map(|()| Method::Midpoint),
    }
}

/// Default angle of a fold, degrees.
const ANGLE_DEG: f64 = 45.0;

/// A fold, and the accuracy of its angle.
pub struct Opened {
    pub fold: Fold,
    /// Standard deviation of the angle, degrees, if derived from a photograph.
    pub angle_sd_deg: Option<f64>,
}

/// The fold described by flags and regions.
pub fn fold(args: &Args) -> Result<Opened> {
    let seen = args.regions.as_deref().map(|path| regions::seen(args, path)).transpose()?;
    let angle_deg = args.angle_deg.or(seen.map(|seen| seen.angle_deg)).unwrap_or(ANGLE_DEG);
    let panel = args.panel.or(seen.map(|seen| seen.panel)).unwrap_or(regions::PANEL);
    let facets = FacetGrid { rows: args.facets.0, cols: args.facets.1 };
    let fold = Fold::new(angle_deg, panel.0, panel.1, facets)?;
    let fold = args.panel1_depth.map_or(Ok(fold), |depth| fold.with_panel1_depth(depth))?;
    let fold = fold.with_spacing(match args.spacing {
        SpacingName::Uniform => Spacing::Uniform,
        SpacingName::Graded => Spacing::Graded,
    });
    let of_photograph = seen.filter(|_| args.angle_deg.is_none());
    Ok(Opened { fold, angle_sd_deg: of_photograph.and_then(|seen| seen.angle_sd_deg) })
}
