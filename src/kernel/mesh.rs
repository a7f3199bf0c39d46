//! How finely the bounces are solved, which is not how finely colour is measured.

use std::fmt;

use crate::error::{Error, Result};
use crate::geometry::{FacetGrid, Fold};
use crate::kernel::check::spectral_radius;
use crate::kernel::continuum::{Continuum, Resolution};
use crate::kernel::facets::FacetOperator;
use crate::kernel::method::Method;
use crate::response::{ModeLight, Response};

/// Most unknowns of one solution: its matrix then takes 200 MB.
const UNKNOWNS_MAX: usize = 5000;
/// How much the error is asked to fall from one solution to the next.
const STEP: f64 = 10.0;
/// Reflectances at which two solutions are compared; the last is the hardest.
const PROBES: [f64; 3] = [0.5, 0.9, 1.0];

/// The mesh on which the bounces of light are solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mesh {
    /// As fine as the tolerance asks for, where the scene needs it: facet means of the continuous solution.
    Auto,
    /// One flat patch a facet, as in the paper.
    Facets,
    /// Flat patches finer than the facets, then averaged.
    Patches(FacetGrid),
}

impl fmt::Display for Mesh {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Facets => f.write_str("facets"),
            Self::Patches(grid) => write!(f, "{}x{}", grid.rows, grid.cols),
        }
    }
}

/// What the solution of a scene's bounces is worth.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// Unknowns of the last solution.
    pub unknowns: usize,
    /// Estimated largest relative error of a facet's mean radiance for any reflectance in [0, 1]; none where the mesh was
    /// given and no second solution made.
    pub facet_mean_error: Option<f64>,
    /// The form factors between flat patches; none where the panels were not divided.
    pub kernel: Option<KernelSource>,
}

/// Where form factors come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KernelSource {
    /// How they were found.
    pub method: Method,
    /// Largest standard error of one, if they are estimates.
    pub entry_sd: Option<f64>,
}

/// Solves the bounces on `fold` under even light, for every reflectance, on `mesh`, to `tolerance`.
///
/// The error stays above the tolerance, and says so, where 5000 unknowns do not reach it.
///
/// # Errors
/// A mesh that does not divide into the facets, or a fold so narrow that no solution fits.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold};
/// use vfold::kernel::mesh::{Mesh, respond};
/// let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
/// let (response, accuracy) = respond(&fold, Mesh::Auto, 1e-3)?;
/// assert_eq!(response.facets(), 100);
/// assert!(accuracy.facet_mean_error.unwrap() <= 1e-3);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn respond(fold: &Fold, mesh: Mesh, tolerance: f64) -> Result<(Response, Accuracy)> {
    respond_by(Method::Exact, fold, mesh, tolerance)
}

/// The same with form factors found by `method`.
///
/// # Errors
/// As [`respond`]; a method other than exact on undivided panels, or one whose kernel makes the bounces diverge.
pub fn respond_by(method: Method, fold: &Fold, mesh: Mesh, tolerance: f64) -> Result<(Response, Accuracy)> {
    match mesh {
        Mesh::Auto if method != Method::Exact => Err(Error::usage(
            "--mesh",
            format!("auto divides the panels into no facets whose form factors could be {method}"),
            "give --mesh facets, patches such as 40x40, or --method exact",
        )),
        Mesh::Auto => respond_auto(fold, tolerance),
        Mesh::Facets => respond_patches(method, fold, fold.facets(), tolerance),
        Mesh::Patches(patches) => respond_patches(method, fold, patches, tolerance),
    }
}

fn respond_patches(
    method: Method,
    fold: &Fold,
    patches: FacetGrid,
    tolerance: f64,
) -> Result<(Response, Accuracy)> {
    let facets = fold.facets();
    if !(patches.rows.is_multiple_of(facets.rows) && patches.cols.is_multiple_of(facets.cols)) {
        return Err(Error::usage(
            "--mesh",
            format!(
                "{}x{} patches do not divide into {}x{} facets",
                patches.rows, patches.cols, facets.rows, facets.cols
            ),
            "give multiples of the facets, or auto",
        ));
    }
    let (kernel, entry_sd) = method.form_factors(&fold.with_facets(patches)?);
    let operator = FacetOperator::new(&kernel, facets);
    if method != Method::Exact {
        check_convergence(method, &operator)?;
    }
    let response = Response::solve(&operator, 0.1 * tolerance)?.0;
    let unknowns = patches.rows * patches.cols.div_ceil(2);
    let kernel = Some(KernelSource { method, entry_sd });
    Ok((response, Accuracy { unknowns, facet_mean_error: None, kernel }))
}

/// Refuses a kernel with which white sheets would shine.
fn check_convergence(method: Method, operator: &FacetOperator) -> Result<()> {
    let radius = spectral_radius(operator);
    if radius < 1.0 {
        return Ok(());
    }
    Err(Error::usage(
        "--method",
        format!(
            "the {method} kernel has spectral radius {radius:.2}: bounces diverge at reflectances from {:.2}",
            1.0 / radius
        ),
        "give --method exact, or --save kernel=FILE.npy --check to study it",
    ))
}

/// Refines until the error, extrapolated from the last three solutions, is within the tolerance, or the next solution would
/// take too many unknowns.
fn respond_auto(fold: &Fold, tolerance: f64) -> Result<(Response, Accuracy)> {
    if flat(fold) {
        return respond_patches(Method::Exact, fold, fold.facets(), tolerance);
    }
    // Half the tolerance is asked for, so that the first fine solution meets it more often than not.
    let aims = std::iter::successors(Some(0.5 * tolerance * STEP * STEP), |aim| Some(aim / STEP));
    let mut solutions =
        aims.map(|aim| (aim, resolution(aim))).take_while(|(_, r)| r.unknowns(fold) <= UNKNOWNS_MAX);
    let mut solve = || -> Result<Option<(Response, usize)>> {
        let Some((aim, resolution)) = solutions.next() else { return Ok(None) };
        let response = Response::solve(&Continuum::new(fold, &resolution), 0.1 * aim)?.0;
        Ok(Some((response, resolution.unknowns(fold))))
    };
    let (Some((coarse, _)), Some((mut response, mut unknowns))) = (solve()?, solve()?) else {
        return Err(Error::usage(
            "--tolerance",
            format!("{tolerance:e} takes more than {UNKNOWNS_MAX} unknowns at {}°", fold.angle_deg()),
            "give a larger tolerance or --mesh facets",
        ));
    };
    let mut before = difference(&coarse, &response);
    let mut error = before;
    while error > tolerance
        && let Some(finer) = solve()?
    {
        let last = difference(&response, &finer.0);
        // A difference is the error of the coarser solution. The finer one gains as much again as the one before did, but
        // is not believed to gain more than it was asked to.
        error = last * (last / before).clamp(1.0 / STEP, 1.0);
        before = last;
        (response, unknowns) = finer;
    }
    Ok((response, Accuracy { unknowns, facet_mean_error: Some(error), kernel: None }))
}

fn flat(fold: &Fold) -> bool {
    (fold.angle_deg() - 180.0).abs() < f64::EPSILON
}

/// The resolution that reaches about `aim` on a 45° fold of square panels at reflectance 1, found by trying.
fn resolution(aim: f64) -> Resolution {
    let order = |base: f64, at: f64, gain: f64| (base + (at / aim).ln() / gain.ln()).ceil().max(2.0) as usize;
    Resolution {
        crease_strip: (1e-3 * (aim / 8e-5).powf(0.6)).min(0.2),
        row_panel: 1.75,
        row_order: order(6.0, 1.7e-4, 2.6),
        end_strip: (0.1 * (aim / 1e-4).powf(0.35)).min(0.25),
        strip_growth: 5.0,
        strip_order: order(4.0, 4e-4, 5.0),
    }
}

/// Largest relative difference of the facets' irradiances between two responses, over [`PROBES`].
fn difference(a: &Response, b: &Response) -> f64 {
    let even = ModeLight::Sun([1.0, 1.0]);
    let relative = |facet: usize, r: f64| {
        (a.irradiance(0, facet, even, [r; 2]) / b.irradiance(0, facet, even, [r; 2]) - 1.0).abs()
    };
    (0..a.facets()).flat_map(|facet| PROBES.map(|r| relative(facet, r))).fold(0.0, f64::max)
}
