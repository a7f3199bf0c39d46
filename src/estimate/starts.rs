//! Where else to look for the most probable spectrum: from the means of classes.
//!
//! Of one channel or two, spectra of every kind make the same (in light of one colour a red sheet may be a blue one), and many channels that are
//! nearly alike mislead. Precise facets have several maxima, and the one that all spectra as one Gaussian lead to may be false.

use nalgebra::DVector;

use super::data::FacetData;
use super::facets::Facets;
use super::gaussian::logistic;
use super::likely::{Likely, Start, of_most_evidence, tell_classes};
use super::prior::{Class, Prior};
use crate::solve::Termination;
use crate::solve::posterior::{Iteration, Model, first_inflation, maximise};

/// So near to the maximum under all spectra, in standard deviations, that what is tried does not depend on the start.
pub const SORTING_TOLERANCE: f64 = 0.01;
/// Maxima from the means of classes are told apart this near to them.
const TOLERANCE_FROM_MEANS: f64 = 0.3;
/// Most iterations of a search that sorts.
pub const ITERATION_LIMIT: usize = 500;
/// Searches are from so many means that come nearest to the facets, the noise being so many times that at which the searches end: from all
/// of them no fewer maxima are false.
const MEANS: usize = 24;
const NEAREST_INFLATION: f64 = 10.0;
/// A quick search sets out from noise so many times that at which it ends, and ends after so many iterations.
const QUICK_INFLATION: f64 = 10.0;
const QUICK_LIMIT: usize = 6;
/// So many quick searches are followed to a finer noise, as near to the maximum there as that, in most so many iterations each and all
/// together: where nothing comes to an end, no class is like the spectrum.
const FOLLOWED: usize = 12;
const FOLLOWED_TOLERANCE: f64 = 0.1;
const FOLLOWED_LIMIT: usize = 30;
const ALL_FOLLOWED_LIMIT: usize = 180;
/// Classes are told apart at so many maxima, and so many are searched of those that come near to the best, as the logarithm of a share of its
/// evidence.
const PLACES: usize = 4;
const SEARCHED: usize = 5;
const LN_EVIDENCE_NEAR: f64 = -10.0;
/// Spectra of a class are one if their root mean square difference is less.
pub const APART: f64 = 0.005;

/// The classes of most evidence at the maxima that the means nearest to the facets lead to, the noise `inflation` times its size; all of them
/// if so few channels do not tell classes apart.
pub fn from_means(data: &FacetData, prior: &Prior, inflation: f64) -> Vec<Start> {
    let tell_apart = tell_classes(data);
    let means = if tell_apart { MEANS } else { usize::MAX };
    let mut found = at_maxima(data, prior, means, (f64::INFINITY, inflation), ITERATION_LIMIT);
    if tell_apart {
        found.truncate(of_most_evidence(&found, |start| start.ln_evidence, true).len());
    }
    found
}

/// The classes of most evidence at the maxima that the means lead to: quickly where the noise is `coarse` times its size, then to the end
/// where it is `fine` times.
pub fn between_means(
    data: &FacetData,
    prior: &Prior,
    [coarse, fine]: [f64; 2],
    trace: &mut Vec<Vec<Iteration>>,
) -> Vec<Start> {
    let quick = at_maxima(data, prior, MEANS, (QUICK_INFLATION * coarse, coarse), QUICK_LIMIT);
    let mut left = ALL_FOLLOWED_LIMIT;
    let follow = |start: Start| {
        let facets = Facets { data, gaussian: &start.gaussian };
        let noise = (start.inflation, fine);
        let found = maximise(&facets, start.w, noise, FOLLOWED_TOLERANCE, FOLLOWED_LIMIT.min(left));
        left -= found.trace.len();
        let ln_evidence = start.ln_share + found.ln_evidence(fine)?;
        let is_found = matches!(found.termination, Termination::Converged { .. });
        trace.push(found.trace);
        is_found.then_some(Start { ln_evidence, inflation: fine, w: found.w, ..start })
    };
    let places = distinct(quick.into_iter().take(FOLLOWED).filter_map(follow).collect());
    let classes = |start: Start| {
        let facets = Facets { data, gaussian: &start.gaussian };
        Likely::new(&facets, &start.w, prior, fine).map_or_else(Vec::new, |likely| likely.starts())
    };
    let mut found = distinct(places.into_iter().take(PLACES).flat_map(classes).collect());
    let least = found.first().map_or(0.0, |most| most.ln_evidence + LN_EVIDENCE_NEAR);
    found.retain(|start| start.ln_evidence >= least);
    found.truncate(SEARCHED);
    found
}

/// Classes by their evidence where searches from the `means` nearest to the facets end, the noise `inflation.0` times its size at first, if not
/// less, and `inflation.1` times at last.
fn at_maxima(
    data: &FacetData,
    prior: &Prior,
    means: usize,
    inflation: (f64, f64),
    limit: usize,
) -> Vec<Start> {
    let (most, last) = inflation;
    let off = |(class, of_prior): (usize, &Class)| {
        let facets = Facets { data, gaussian: of_prior.gaussian() };
        let misfit = facets.residuals(&DVector::zeros(facets.unknowns())) / (NEAREST_INFLATION * last);
        (of_prior.ln_share - 0.5 * misfit.norm_squared(), class)
    };
    let mut nearest: Vec<_> = prior.classes().iter().enumerate().map(off).collect();
    nearest.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let of_class = |(_, class): (f64, usize)| {
        let of_prior = &prior.classes()[class];
        let facets = Facets { data, gaussian: of_prior.gaussian() };
        let w = DVector::zeros(facets.unknowns());
        let first = first_inflation(&facets, &w, last).min(most);
        let found = maximise(&facets, w, (first, last), TOLERANCE_FROM_MEANS, limit);
        let ln_share = of_prior.ln_share;
        let ln_evidence = ln_share + found.ln_evidence(last)?;
        let gaussian = of_prior.gaussian().clone();
        let start = Start { class, inflation: last, ln_evidence, ln_share, gaussian, w: found.w };
        ln_evidence.is_finite().then_some(start)
    };
    let mut found: Vec<_> = nearest.into_iter().take(means).filter_map(of_class).collect();
    found.sort_by(|a, b| b.ln_evidence.total_cmp(&a.ln_evidence));
    found
}

/// By their evidence, most first, and none that is another one again.
fn distinct(mut starts: Vec<Start>) -> Vec<Start> {
    starts.sort_by(|a, b| b.ln_evidence.total_cmp(&a.ln_evidence));
    let mut kept: Vec<(Start, DVector<f64>)> = Vec::new();
    for start in starts {
        let coordinates = start.w.rows(0, start.gaussian.basis().ncols()).into_owned();
        let reflectance = start.gaussian.logit_at(&coordinates).map(logistic);
        let near = APART * (reflectance.len() as f64).sqrt();
        let is_again = |(other, of_other): &(Start, DVector<f64>)| {
            other.class == start.class && of_other.metric_distance(&reflectance) < near
        };
        if !kept.iter().any(is_again) {
            kept.push((start, reflectance));
        }
    }
    kept.into_iter().map(|(start, _)| start).collect()
}
