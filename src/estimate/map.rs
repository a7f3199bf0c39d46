//! The default: the posterior mean of the spectrum, given the facets and a prior on reflectances.
//!
//! `z = logit r` is a priori Gaussian in each class of spectra; the facets are Gaussian about the model.
//! Newton's method finds the mode in whitened z under each candidate class (`search`). The estimate is the
//! mean of the modes, weighted by evidence. The curvature gives error bars (Laplace approximation), which
//! widen where classes disagree or facets are further from the model than their noise.

use std::iter;

use super::alternatives::Alternatives;
use super::data::FacetData;
use super::facets::{Facets, Second};
use super::fluorescence_search::{self, Fluorescing};
use super::light::{Others, rival};
use super::mixture::Mixture;
use super::prior::Prior;
use super::rival::Rival;
use super::search::{Search, Sorted};
use super::unknowns::{EXPOSURE, Expected};
use super::verdict::EXPLAINED;
use super::{Estimate, Fitted};
use crate::error::{Error, Result};
use crate::solve::posterior::Iteration;

/// A fitted number is supported by the facets if its standard deviation is below this share of the prior one;
/// an exposure, which has no prior, if its standard deviation is below this share of its value.
const SUPPORTED: f64 = 0.8;
const EXPOSURE_SUPPORTED: f64 = 0.5;

/// Facets are precise if their noise is this many times smaller than that at which classes are distinguished.
const PRECISE: f64 = 10.0;

/// Iterations by run.
type Trace = Vec<Vec<Iteration>>;

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
    let known = data.with_known(unknown, bound);
    let on_bound = Sortings::of(&known, prior, start).and_then(|sorted| sorted.most_probable(&known, prior));
    let (on_bound, more) = on_bound.ok_or_else(not_finite)?;
    Ok((on_bound.estimate(data, &found.mixture, [trace, more].concat()), rival))
}

/// The facets under all spectra as one Gaussian: for a sheet without emission, then with each possible
/// emission.
struct Sortings<'a> {
    plain: Sorted<(), Second>,
    fluorescing: Vec<Fluorescing<'a>>,
    trace: Trace,
}

/// The mean of all modes, and the alternatives that it covers.
struct Searched<'a> {
    mixture: Mixture<usize, Second>,
    alternatives: Alternatives<'a>,
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

impl<'a> Searched<'a> {
    fn among(all: Vec<Fluorescing<'a>>, prior: &Prior) -> Option<(Self, Trace)> {
        let all = all.into_iter().enumerate();
        let (alternatives, mut sorted): (Vec<_>, Vec<_>) =
            all.map(|(n, (data, sorted))| (data, sorted.for_hypothesis(n))).unzip();
        sorted.sort_by(|a, b| b.ln_weight().total_cmp(&a.ln_weight()));
        let alternatives = Alternatives(alternatives);
        let mut search = Search::new(&alternatives, prior);
        let mixture = search.mixture(&sorted)?;
        let trace = search.trace;
        Some((Self { mixture, alternatives }, trace))
    }

    /// Converts to an estimate, with the errors of another mixture, `off`.
    fn estimate(&self, data: &FacetData, off: &Mixture<usize, Second>, trace: Trace) -> Estimate {
        let emission = |alternative: usize| self.alternatives.0[alternative].emission();
        let origin = |alternative| emission(alternative)?.origin();
        let Mixture { values, spread, shares, .. } = &self.mixture;
        let shares = shares.iter().map(|(alternative, share)| (origin(*alternative), *share));
        let first = data.scene().facets().bands() + data.scene().unknowns().len() + 1;
        let fluorescence = emission(0).and_then(|nothing| {
            fluorescence_search::found(shares, (values, spread.as_ref()), nothing, first)
        });
        Estimate { fluorescence, ..into_estimate(data, &self.mixture, off, trace) }
    }
}

/// An unknown of the scene outside its range, and the bound that it exceeds.
fn impossible(data: &FacetData, found: &Mixture<usize, Second>) -> Option<(usize, f64)> {
    let scene = data.scene();
    let values = &found.values[scene.facets().bands()..];
    let beyond = |(n, expected): (usize, &Expected)| Some((n, expected.bound_of(values[n])?));
    scene.unknowns().iter().enumerate().find_map(beyond)
}

/// Converts `found` to an estimate, with the errors of another mixture, `off`.
pub(super) fn into_estimate<H>(
    data: &FacetData,
    found: &Mixture<H, Second>,
    off: &Mixture<H, Second>,
    trace: Vec<Vec<Iteration>>,
) -> Estimate {
    let (bands, unknowns) = (data.scene().facets().bands(), data.scene().unknowns());
    let sd = |column: usize| off.spread.as_ref().map_or(f64::INFINITY, |all| all.column(column).norm());
    let w = &off.best.start.w;
    let first = off.best.start.gaussian.basis().ncols();
    let of_unknowns = unknowns.iter().enumerate().map(|(n, expected)| {
        let (sd, prior_sd) = (sd(bands + n), expected.at(w[first + n]).1.abs());
        Fitted {
            unknown: expected.unknown,
            value: found.values[bands + n],
            sd,
            supported: sd < SUPPORTED * prior_sd,
        }
    });
    let last = bands + unknowns.len();
    let exposure = found.values[last];
    let of_exposure = data.fits_exposure().then(|| Fitted {
        unknown: &EXPOSURE,
        value: exposure,
        sd: sd(last),
        supported: sd(last) < EXPOSURE_SUPPORTED * exposure,
    });
    Estimate {
        albedo: None,
        // weights of a mean may add up to slightly more than 1 by rounding
        reflectance: found.values[..bands].iter().map(|r| r.min(1.0)).collect(),
        fitted: of_exposure.into_iter().chain(of_unknowns).collect(),
        findings: Vec::new(),
        skipped: Vec::new(),
        spread: off.spread.as_ref().map(|all| all.columns(0, bands).into_owned()),
        exposure,
        residual_rms: found.best.rms,
        unexplained: data.unexplained(&found.best.at.residuals),
        day: None,
        fluorescence: None,
        light: None,
        without_bounces: 0.0,
        iterations: trace.iter().map(Vec::len).sum::<usize>() as u32,
        trace,
        termination: found.best.termination,
    }
}
