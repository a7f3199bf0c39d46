//! The default: the expected spectrum, given the facets and what is known of reflectances.
//!
//! `z = logit r` is Gaussian in each class of spectra before the picture is taken; the facets are Gaussian about the model.
//! Newton's method finds the maximum in whitened z under each class that the facets may belong to (`likely`, `starts`). The estimate is
//! the mean of the maxima by their evidence, and the curvature gives error bars (Laplace's approximation), wider where classes disagree or
//! facets are further from the model than their noise.

use nalgebra::DVector;

use super::Estimate;
use super::data::FacetData;
use super::facets::Facets;
use super::found::{Beside, Found, mean};
use super::likely::{Likely, Start};
use super::prior::Prior;
use super::starts::{ITERATION_LIMIT, SORTING_TOLERANCE, between_means, from_means};
use crate::solve::Termination;
use crate::solve::posterior::{Iteration, Model, first_inflation, maximise};

/// The maximum counts as found within this many standard deviations of it.
const TOLERANCE: f64 = 1e-3;
/// Classes are told apart at these noises, relative to the brightest facet, or at the true one if that is larger: at the coarse one all spectra
/// lead to where the model is nearly linear, at the fine one the likeliest class of these does.
const SORTING_NOISE: f64 = 1e-3;
const FINE_NOISE: f64 = 1e-5;
/// The search that leads there ends so near to its maximum, in standard deviations, or after so many iterations.
const FINE_TOLERANCE: f64 = 0.01;
const FINE_LIMIT: usize = 30;
/// Most iterations of the searches under all classes that are tried: more than all but a few spectra take and, where facets have noise, which
/// may be of another scene than was told, so many that no search that explains them comes near to that.
const CLASSES_LIMIT: usize = 90;
const NOISY_CLASSES_LIMIT: usize = 600;
/// Maxima so many standard deviations from what chance has may be false, of precise facets those beyond [`PRECISE_SURPRISE`] and those that a
/// search took more than `LONG` iterations to: one from another start counts by its evidence if it explains the facets.
const SURPRISE: f64 = 3.0;
const PRECISE_SURPRISE: f64 = 0.0;
const LONG: usize = 10;
/// Most iterations of each of these searches, where facets are precise.
const ANOTHER_LIMIT: usize = 20;
/// The best search is carried on for so many iterations where none has come to the facets.
const CARRIED_ON: usize = 40;
/// The most probable reflectance and, with it, the scene's unknowns. `start` is a reflectance to set out from instead of the
/// prior's mean; at a maximum of more evidence than all others it makes no difference.
///
/// # Source
/// Objective: Deeb et al., eq. (36), with the prior in place of its smoothness term.
#[must_use]
pub fn estimate(data: &FacetData, prior: &Prior, start: Option<&[f64]>) -> Estimate {
    let found = most_probable(data, prior, start);
    match found.impossible(data) {
        None => found.into_estimate(data),
        // The maximum lies on the bound; how far off it may be is told from what lies on both of its sides.
        Some((unknown, bound)) => {
            let on_bound = most_probable(&data.with_known(unknown, bound), prior, start);
            let Found { spread, prior_sd, mut trace, .. } = found;
            trace.extend(on_bound.trace);
            Found { spread, prior_sd, trace, ..on_bound }.into_estimate(data)
        }
    }
}

/// The maximum, whether or not all unknowns of the scene can be so.
fn most_probable(data: &FacetData, prior: &Prior, start: Option<&[f64]>) -> Found {
    let all = Facets { data, gaussian: prior.broad() };
    let start = start.map_or_else(|| DVector::zeros(all.unknowns()), |start| all.set_out_from(start));
    let [coarse, fine] = [SORTING_NOISE, FINE_NOISE].map(|noise| (noise * data.peak()).max(1.0));
    let first = first_inflation(&all, &start, coarse);
    let sorted = maximise(&all, start, (first, coarse), SORTING_TOLERANCE, ITERATION_LIMIT);
    let mut trace = vec![sorted.trace.clone()];
    let mut likely = Likely::new(&all, &sorted.w, prior, coarse);
    if fine < coarse
        && let Some(first) = likely.as_ref().and_then(Likely::first_start)
    {
        likely = nearer(data, prior, first, fine, &mut trace).or(likely);
    }
    let starts = likely.as_ref().map_or_else(Vec::new, Likely::starts);
    // Evidence at a larger noise than the facets have is not to be weighed with.
    let are_noisy = coarse.min(fine) <= 1.0;
    let minor = likely.iter().filter(|_| are_noisy).flat_map(|likely| likely.minor(&starts));
    let minor: Vec<_> = minor.collect();
    let limit = if are_noisy { NOISY_CLASSES_LIMIT } else { CLASSES_LIMIT };
    let mut likeliest = maxima(data, starts, limit);
    let mut found = Vec::new();
    for one in likeliest.by_ref() {
        let explains = one.explains();
        found.push(one);
        // the others set out beside it: more is likely to be found from elsewhere
        if !are_noisy && !explains {
            break;
        }
    }
    if found.is_empty() || is_doubtful(&found, !are_noisy) {
        let (starts, limit) = if are_noisy || likely.is_none() {
            (from_means(data, prior, coarse), NOISY_CLASSES_LIMIT)
        } else {
            let taken = trace.iter().map(Vec::len).chain(found.iter().map(Found::iterations)).sum();
            let starts = between_means(data, prior, [coarse, fine], taken, &mut trace);
            let limit = ANOTHER_LIMIT * starts.len();
            (starts, limit)
        };
        add(&mut found, data, maxima(data, starts, limit));
    }
    let is_explained = |found: &[Found]| are_noisy || found.iter().any(Found::explains);
    if !is_explained(&found) {
        found.extend(likeliest);
    }
    if !is_explained(&found) {
        carry_on(&mut found, data);
    }
    trace.extend(found.iter().flat_map(|found| found.trace.clone()));
    let counts = found.iter().any(Found::explains);
    let beside: Vec<_> = minor.iter().filter(|_| counts).map(|minor| Beside::new(data, minor)).collect();
    let best = mean(found, &beside).unwrap_or_else(|| Found::new(&all, &sorted, 0.0));
    Found { trace, ..best }
}

/// Adds maxima that the facets allow, each once; all of them if there are no others.
fn add(found: &mut Vec<Found>, data: &FacetData, more: impl Iterator<Item = Found>) {
    let all_count = found.is_empty();
    for one in more {
        if (all_count || one.explains()) && !found.iter().any(|other| one.is_again(other, data)) {
            found.push(one);
        }
    }
}

/// Carries on the search of most evidence.
fn carry_on(found: &mut Vec<Found>, data: &FacetData) {
    let most = (0..found.len()).max_by(|a, b| found[*a].ln_evidence.total_cmp(&found[*b].ln_evidence));
    if let Some(Found { end: Some(end), trace, .. }) = most.map(|most| found.swap_remove(most)) {
        let further = maxima(data, vec![end], CARRIED_ON);
        found.extend(
            further.map(|further| Found { trace: [trace.clone(), further.trace].concat(), ..further }),
        );
    }
}

/// Classes about the maximum under one of them at a finer noise; none if the search does not come to its end.
fn nearer<'a>(
    data: &FacetData,
    prior: &'a Prior,
    start: Start,
    fine: f64,
    trace: &mut Vec<Vec<Iteration>>,
) -> Option<Likely<'a>> {
    let facets = Facets { data, gaussian: &start.gaussian };
    let found = maximise(&facets, start.w, (start.inflation, fine), FINE_TOLERANCE, FINE_LIMIT);
    trace.push(found.trace);
    match found.termination {
        Termination::Converged { .. } => Likely::new(&facets, &found.w, prior, fine),
        Termination::NoProgress { .. } | Termination::IterationLimit => None,
    }
}

/// Whether another maximum may have more evidence than those that were found: facets that are precise show it already where the search was
/// long.
fn is_doubtful(found: &[Found], is_precise: bool) -> bool {
    if !is_precise {
        return found.iter().all(|found| found.surprise > SURPRISE);
    }
    let most = found.iter().max_by(|a, b| a.ln_evidence.total_cmp(&b.ln_evidence));
    most.is_none_or(|most| most.surprise > PRECISE_SURPRISE || most.iterations() > LONG)
}

/// The maxima under classes, all in at most `limit` iterations, each as it is asked for.
fn maxima(data: &FacetData, starts: Vec<Start>, limit: usize) -> impl Iterator<Item = Found> {
    let limit = limit / starts.len().max(1);
    starts.into_iter().map(move |start| {
        let facets = Facets { data, gaussian: &start.gaussian };
        let solution = maximise(&facets, start.w.clone(), (start.inflation, 1.0), TOLERANCE, limit);
        let evidence = solution.ln_evidence(1.0).map_or(f64::NEG_INFINITY, |ln| ln + start.ln_share);
        let found = Found::new(&facets, &solution, evidence);
        Found { end: Some(Start { w: solution.w, inflation: 1.0, ..start }), ..found }
    })
}
