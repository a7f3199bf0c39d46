//! Undivided panels, resolved ever finer until the facet means are right.

use crate::error::{Error, Result};
use crate::geometry::Fold;
use crate::kernel::continuum::{Continuum, Resolution};
use crate::response::{ModeLight, Modes, Response};
use crate::room;

/// Most unknowns of one solution: its matrix then has 800 MB, if nothing in it is negligible.
const UNKNOWNS_MAX: usize = 10_000;
/// Most multiplications of one solution, of which one in six is done: a few seconds. A 1° fold takes hundreds
/// of products with its matrix.
const PRODUCTS_MAX: f64 = 4e10;
/// Error that is aimed at, relative to the tolerance, so that the solution meets it more often than not.
const AIM: f64 = 0.2;
/// The estimated error, relative to the one that the solution should have from its forerunner's.
const SAFETY: f64 = 3.0;
/// The least error estimate, relative to the target: where a coarser one has as many strips, both lack the
/// same.
const LEAST: f64 = 2.0;
/// How much finer a solution is than the coarser one that tells its error.
const STEP: f64 = 100.0;
/// The same where the coarser one is the coarsest.
const LEAST_STEP: f64 = 20.0;
/// The largest error to begin with: still coarser solutions do not tell what finer ones gain.
const COARSEST: f64 = 0.005;
/// Reflectances at which two solutions are compared; the last is the hardest.
const PROBES: [f64; 3] = [0.5, 0.9, 1.0];

/// A solution with its estimated error.
pub struct Refined {
    /// Poles and residues.
    pub response: Response,
    /// Unknowns of a panel.
    pub unknowns: usize,
    /// Estimated largest relative error of a facet mean, for any reflectance in [0, 1].
    pub error: f64,
    /// Residual that Lanczos' method left, relative to the light.
    pub residual: f64,
}

struct Solution {
    aim: f64,
    response: Response,
    unknowns: usize,
    residual: f64,
}

/// Solves the bounces on `fold` ever finer until the estimated error is within `tolerance`; it stays above
/// where the next solution would take too long.
///
/// The difference of two solutions is the error of the coarser one. The finer one's is smaller by as much as
/// its resolution aims at less; `SAFETY` allows for folds that differ from the one by which resolutions were
/// chosen.
///
/// # Errors
/// [`Error::Usage`] if not even the first solutions fit.
pub fn refine(fold: &Fold, tolerance: f64) -> Result<Refined> {
    // On one of the pool's threads, which need not be woken up for every product.
    rayon::scope(|_| refine_here(fold, tolerance))
}

fn refine_here(fold: &Fold, tolerance: f64) -> Result<Refined> {
    let Some((coarse, mut fine)) = first_two(fold, AIM * tolerance)? else {
        return Err(Error::usage(
            "--tolerance",
            format!("{tolerance:e} takes more than {UNKNOWNS_MAX} unknowns at {}°", fold.angle_deg()),
            "give a larger tolerance or --mesh facets",
        ));
    };
    let mut error = estimated_error(&coarse, &fine);
    while error > tolerance
        && let Some(finer) = solve(fold, 0.9 * tolerance / error * fine.aim, fine.response.poles().len())?
    {
        // Against the coarse one again: two solutions that are nearly the same would tell nothing.
        error = estimated_error(&coarse, &finer);
        fine = finer;
    }
    // Lanczos' solution is short of light, so that no more than all of it can be missing.
    let error = error.max((fine.residual / loss(fold)).min(1.0));
    Ok(Refined { response: fine.response, unknowns: fine.unknowns, error, residual: fine.residual })
}

/// A coarse solution, and a finer one that aims at this error or, if that would take too long, at one as near
/// as it may be; the coarse one and a still coarser one if nothing finer can be had.
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

/// The solution that aims at this error; none if it would take too long, `poles` being those of the one
/// before.
fn solve(fold: &Fold, aim: f64, poles: usize) -> Result<Option<Solution>> {
    let resolution = Resolution::reaching(aim, fold);
    let unknowns = resolution.unknowns(fold);
    if unknowns > UNKNOWNS_MAX || (unknowns as f64).powi(2) * poles as f64 > PRODUCTS_MAX {
        return Ok(None);
    }
    let numbers = unknowns as u64 * (unknowns + resolution.readings(fold)) as u64;
    room::ask(8 * numbers, "the exchange between undivided panels", "take fewer facets")?;
    let (response, residual) = Response::solve(&Continuum::new(fold, &resolution), 0.1 * aim * loss(fold))?;
    Ok(Some(Solution { aim, response, unknowns, residual }))
}

/// Roughly the smallest share of light that a bounce loses: a residual grows by at most its inverse.
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
