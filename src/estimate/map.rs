//! The default: the posterior mean of the spectrum, given the facets and a prior on reflectances.
//!
//! `z = logit r` is a priori Gaussian in each class of spectra; the facets are Gaussian about the model.
//! Newton's method finds the mode in whitened z under each candidate class (`search`). The estimate is the
//! mean of the modes, weighted by evidence. The curvature gives error bars (Laplace approximation), which
//! widen where classes disagree or facets are further from the model than their noise.

use std::iter;

use super::Estimate;
use super::data::FacetData;
use super::facets::{Facets, Second};
use super::fluorescence_search::{self, Fluorescing, PRECISE};
use super::light::{Others, rival};
use super::mixture::Mixture;
use super::prior::Prior;
use super::rival::Rival;
use super::search::{Search, Sorted};
use super::searched::{Searched, Trace};
use super::unknowns::Expected;
use super::verdict::EXPLAINED;
use crate::error::{Error, Result};

/// The most probable reflectance, together with the scene's unknowns. `start` is an initial reflectance in
/// place of the prior's mean; if one mode has more evidence than all others it makes no difference.
///
/// # Source
/// Objective: Deeb et al., eq. (36), with the prior in place of its smoothness term.
///
/// # Errors
/// [`Error::Numeric`] if the facets are not finite.
pub fn estimate(data: &FacetData, prior: &Prior, start: Option<&[f64]>) -> Result<Estimate> {
    Ok(estimate_in_stated_light(data, prior, start, None)?.0)
}

/// The same, and any light among `others` that is more probable than the stated one.
///
/// # Errors
/// As [`estimate`].
pub fn estimate_in_stated_light(
    data: &FacetData,
    prior: &Prior,
    start: Option<&[f64]>,
    others: Option<&Others>,
) -> Result<(Estimate, Option<Rival>)> {
    let not_finite = || Error::Numeric("the facets are not finite".to_owned());
    let sorted = Sortings::of(data, prior, start).ok_or_else(not_finite)?;
    let rival = others.and_then(|others| rival(data, (&sorted.plain, &sorted.fluorescing), others, prior));
    let (found, trace) = sorted.most_probable(data, prior).ok_or_else(not_finite)?;
    let Some((unknown, bound)) = impossible(data, &found.mixture) else {
        return Ok((found.estimate(data, &found.mixture, trace), rival));
    };
    // The mode lies on the bound; its error bars are those of the unconstrained mode, to both sides.
    let mut known = data.with_known(unknown, bound);
    let mut all = trace;
    let on_bound = loop {
        let sorted = Sortings::of(&known, prior, start).ok_or_else(not_finite)?;
        let (on_bound, more) = sorted.most_probable(&known, prior).ok_or_else(not_finite)?;
        all.extend(more);
        match impossible(&known, &on_bound.mixture) {
            Some((unknown, bound)) => known = known.with_known(unknown, bound),
            None => break on_bound,
        }
    };
    Ok((on_bound.estimate(data, &found.mixture, all), rival))
}

/// The facets under all spectra as one Gaussian: for a sheet without emission, then with each possible
/// emission.
struct Sortings<'a> {
    plain: Sorted<(), Second>,
    fluorescing: Vec<Fluorescing<'a>>,
    trace: Trace,
}

impl<'a> Sortings<'a> {
    fn of(data: &FacetData<'a>, prior: &Prior, start: Option<&[f64]>) -> Option<Self> {
        let all = Facets { data, gaussian: prior.broad() };
        let mut search = Search::new(data, prior);
        let start = start.map(|start| all.set_out_from(start));
        let plain = search.sort(((), 0.0), start, f64::NEG_INFINITY)?;
        // precise facets are either explained by a sheet without emission or not: emission is considered only
        // in the latter case
        let is_asked = search.tempering() <= PRECISE;
        let fluorescing =
            if is_asked { fluorescence_search::may_be(data, &plain, prior) } else { Vec::new() };
        Some(Self { plain, fluorescing, trace: search.trace })
    }

    /// The mean of all modes, unconstrained by the ranges of the unknowns, and the trace.
    fn most_probable(self, data: &FacetData<'a>, prior: &Prior) -> Option<(Searched<'a>, Trace)> {
        let Self { plain, fluorescing, trace } = self;
        let asked = !fluorescing.is_empty();
        let (found, more) = Searched::among(with_plain(data, plain, fluorescing)?, prior)?;
        let trace = [trace, more].concat();
        let (rms, tempering) = (found.mixture.best.rms, Search::new(data, prior).tempering());
        // precise facets whose residuals reach a noise at which emission is considered may belong to a
        // fluorescent sheet
        let is_open = tempering > PRECISE && rms > tempering;
        if rms < EXPLAINED || !(asked || is_open) {
            return Some((found, trace));
        }
        // the evidence of sheets that do not explain the facets is meaningless
        let plain = Search::new(data, prior).sort(((), 0.0), None, f64::NEG_INFINITY)?;
        let fluorescing = if asked { Vec::new() } else { fluorescence_search::may_be(data, &plain, prior) };
        let (other, more) = Searched::among(with_plain(data, plain, fluorescing)?, prior)?;
        let explains = asked || other.mixture.best.rms < EXPLAINED;
        Some((if explains { other } else { found }, [trace, more].concat()))
    }
}

/// The facets of a sheet without emission, then those of fluorescent ones.
fn with_plain<'a>(
    data: &FacetData<'a>,
    plain: Sorted<(), Second>,
    fluorescing: Vec<Fluorescing<'a>>,
) -> Option<Vec<Fluorescing<'a>>> {
    let nothing = data.scene().emissions().first().filter(|_| !fluorescing.is_empty());
    let of_plain = nothing.map_or_else(|| Some(data.clone()), |nothing| data.emitting(nothing))?;
    Some(iter::once((of_plain, plain)).chain(fluorescing).collect())
}

/// An unknown of the scene outside its range, and the bound that it exceeds.
fn impossible(data: &FacetData, found: &Mixture<usize, Second>) -> Option<(usize, f64)> {
    let scene = data.scene();
    let values = &found.values[scene.facets().bands()..];
    let beyond = |(n, expected): (usize, &Expected)| Some((n, expected.bound_of(values[n])?));
    scene.unknowns().iter().enumerate().find_map(beyond)
}
