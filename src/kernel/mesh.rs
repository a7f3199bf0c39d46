//! How finely the bounces are solved, which is not how finely colour is measured.

use std::fmt;

use crate::error::{Error, Result};
use crate::geometry::{FacetGrid, Fold};
use crate::kernel::continuum::{Continuum, Resolution};
use crate::kernel::exact::form_factors;
use crate::kernel::facets::FacetOperator;
use crate::response::{ModeLight, Modes, Response};

/// Most unknowns of one solution: its matrix then takes 800 MB.
const UNKNOWNS_MAX: usize = 10_000;
/// How much the error is asked to fall from one solution to the next.
const STEP: f64 = 20.0;
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
}

/// Solves the bounces on `fold` under even light, for every reflectance, on `mesh`, to `tolerance`.
///
/// The error stays above the tolerance, and says so, where 10000 unknowns do not reach it.
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
    match mesh {
        Mesh::Auto => respond_auto(fold, tolerance),
        Mesh::Facets => respond_patches(fold, fold.facets(), tolerance),
        Mesh::Patches(patches) => respond_patches(fold, patches, tolerance),
    }
}

fn respond_patches(fold: &Fold, patches: FacetGrid, tolerance: f64) -> Result<(Response, Accuracy)> {
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
    let kernel = form_factors(&fold.with_facets(patches)?);
    let response = Response::solve(&FacetOperator::new(&kernel, facets), 0.1 * tolerance)?.0;
    Ok((response, Accuracy { unknowns: patches.rows * patches.cols.div_ceil(2), facet_mean_error: None }))
}

/// Refines until the error, extrapolated from the last three solutions, is within the tolerance, or the next solution would
/// take too many unknowns.
fn respond_auto(fold: &Fold, tolerance: f64) -> Result<(Response, Accuracy)> {
    if fold.is_flat() {
        return respond_patches(fold, fold.facets(), tolerance);
    }
    // Half the tolerance is asked for, so that the first fine solution meets it more often than not.
    let aims = std::iter::successors(Some(0.5 * tolerance * STEP * STEP), |aim| Some(aim / STEP));
    let mut solutions = aims
        .map(|aim| (aim, Resolution::reaching(aim, fold)))
        .take_while(|(_, r)| r.unknowns(fold) <= UNKNOWNS_MAX);
    let mut solve = || -> Result<Option<(Response, usize)>> {
        let Some((aim, resolution)) = solutions.next() else { return Ok(None) };
        let (response, _) = Response::solve(&Continuum::new(fold, &resolution), residual(fold, aim))?;
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
    Ok((response, Accuracy { unknowns, facet_mean_error: Some(error) }))
}

/// The residual that leaves a tenth of `aim`: bounces enlarge it by at most about `1/sin(θ/2)`, the least share of light that
/// a bounce loses.
fn residual(fold: &Fold, aim: f64) -> f64 {
    0.1 * aim * (0.5 * fold.angle_rad()).sin()
}

/// Largest relative difference of the facets' irradiances between two responses, over [`PROBES`].
fn difference(a: &Response, b: &Response) -> f64 {
    let even = ModeLight::Sun([1.0, 1.0]);
    let relative = |panel: usize, facet: usize, r: f64| {
        let [a, b] = [a, b].map(|response| response.irradiance(panel, facet, even, [r; 2]));
        (a / b - 1.0).abs()
    };
    let panels = 0..if matches!(a.modes(), Modes::Shared(_)) { 1 } else { 2 };
    let facets = panels.flat_map(|panel| (0..a.facets()).map(move |facet| (panel, facet)));
    facets.flat_map(|(panel, facet)| PROBES.map(|r| relative(panel, facet, r))).fold(0.0, f64::max)
}
