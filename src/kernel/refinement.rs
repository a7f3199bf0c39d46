//! Undivided panels, refined until the facet means are accurate.

use crate::error::{Error, Result};
use crate::geometry::Fold;
use crate::kernel::continuum::{Continuum, Resolution};
use crate::response::{ModeLight, Modes, Response};
use crate::room;

/// Maximum number of unknowns of a solution: its matrix takes 800 MB if no entry is negligible.
const UNKNOWNS_MAX: usize = 10_000;
/// Maximum number of multiplications of a solution, one in six of which is performed: a few seconds. A 1°
/// fold takes hundreds of products with its matrix.
const PRODUCTS_MAX: f64 = 4e10;
/// Target error relative to the tolerance, low enough for a solution to meet the tolerance more often than
/// not.
const AIM: f64 = 0.2;
/// Safety factor on the error of a solution extrapolated from that of the coarser one.
const SAFETY: f64 = 3.0;
/// Lower bound of the error estimate, relative to the target: if the coarser solution has as many strips,
/// both share the same error.
const LEAST: f64 = 2.0;
/// Ratio of the target errors of the coarser and the finer solution.
const STEP: f64 = 100.0;
/// Least such ratio if the coarser solution is the coarsest.
const LEAST_STEP: f64 = 20.0;
/// Largest initial target error: coarser solutions do not show what refinement gains.
const COARSEST: f64 = 0.005;
/// Reflectances at which two solutions are compared; the last is the most demanding.
const PROBES: [f64; 3] = [0.5, 0.9, 1.0];

/// A solution with its estimated error.
pub struct Refined {
    /// Poles and residues.
    pub response: Response,
    /// Unknowns per panel.
    pub unknowns: usize,
    /// Estimated largest relative error of a facet mean for any reflectance in [0, 1].
    pub error: f64,
    /// Residual of Lanczos' method, relative to the light.
    pub residual: f64,
}

struct Solution {
    aim: f64,
    response: Response,
    unknowns: usize,
    residual: f64,
}

/// Solves interreflections on `fold` with increasing resolution until the estimated error is within
/// `tolerance`, or the next solution would take too long.
///
/// The difference between two solutions is the error of the coarser one. The error of the finer one is
/// smaller by the ratio of their targets; `SAFETY` allows for folds unlike the one for which resolutions were
/// tuned.
///
/// # Errors
/// [`Error::Usage`] if not even the first solutions fit.
pub fn refine(fold: &Fold, tolerance: f64) -> Result<Refined> {
    // Runs on a thread of the pool, which then need not be woken up for every product.
    rayon::scope(|_| refine_here(fold, tolerance))
}

fn refine_here(fold: &Fold, tolerance: f64) -> Result<Refined> {
    let Some((coarse, mut fine)) = first_two(fold, AIM * tolerance)? else {
        return Err(Error::usage(
            "--tolerance",
            format!("{tolerance:e} needs more than {UNKNOWNS_MAX} unknowns at {}°", fold.angle_deg()),
            "give a larger tolerance or --mesh facets",
        ));
    };
    let mut error = estimated_error(&coarse, &fine);
    while error > tolerance
        && let Some(finer) = solve(fold, 0.9 * tolerance / error * fine.aim, fine.response.poles().len())?
    {
        // Compared with the coarse one again: two almost equal solutions reveal nothing.
        error = estimated_error(&coarse, &finer);
        fine = finer;
    }
    // Lanczos' solution lacks light, but at most all of it.
    let error = error.max((fine.residual / loss(fold)).min(1.0));
    Ok(Refined { response: fine.response, unknowns: fine.unknowns, error, residual: fine.residual })
}

/// A coarse solution and a finer one, whose target is `aim` or, if that would take too long, as close to it
/// as possible; if no finer solution is feasible, a still coarser one and the coarse one.
fn first_two(fold: &Fold, aim: f64) -> Result<Option<(Solution, Solution)>> {
    let start = COARSEST.min(STEP * aim);
    let Some(first) = solve(fold, start, 1)? else { return Ok(None) };
    let mut finer = aim.min(start / LEAST_STEP);
    while finer < 0.5 * start {
        if let Some(second) = solve(fold, finer, first.response.poles().len())? {
            return Ok(Some((first, second)));
        }
        finer *= 2.0;
    }
    Ok(solve(fold, LEAST_STEP * start, 1)?.map(|coarser| (coarser, first)))
}

fn estimated_error(coarse: &Solution, fine: &Solution) -> f64 {
    let of_difference = SAFETY * fine.aim / coarse.aim * difference(&coarse.response, &fine.response);
    of_difference.max(LEAST * fine.aim)
}

/// The solution with this target error; `None` if it would take too long. `poles` is the number of poles of
/// the previous solution.
fn solve(fold: &Fold, aim: f64, poles: usize) -> Result<Option<Solution>> {
    let resolution = Resolution::reaching(aim, fold);
    let unknowns = resolution.unknowns(fold);
    if unknowns > UNKNOWNS_MAX || (unknowns as f64).powi(2) * poles as f64 > PRODUCTS_MAX {
        return Ok(None);
    }
    let numbers = unknowns as u64 * (unknowns + resolution.readings(fold)) as u64;
    room::ask(8 * numbers, "the exchange between undivided panels", "use fewer facets")?;
    let (response, residual) = Response::solve(&Continuum::new(fold, &resolution), 0.1 * aim * loss(fold))?;
    Ok(Some(Solution { aim, response, unknowns, residual }))
}

/// Approximate minimum share of light lost per bounce: a residual grows by at most its inverse.
fn loss(fold: &Fold) -> f64 {
    (0.5 * fold.angle_rad()).sin()
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
