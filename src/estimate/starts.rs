//! Other starting points for the search of the most probable spectrum: the means of classes.
//!
//! With one or two channels, spectra of every class can have the same effect (in light of one colour a red
//! sheet may be a blue one), and many channels that are nearly alike mislead. Precise facets have several
//! modes, and the one to which all spectra as one Gaussian lead may be false.

use nalgebra::DVector;

use super::family::Family;
use super::gaussian::logistic;
use super::linear::{Linear, Start, candidates, worth_a_search};
use super::mixture::APART;
use super::prior::{Class, Prior};
use crate::solve::Termination;
use crate::solve::posterior::{Iteration, Limits, Model, find_mode, first_tempering};

/// Tolerance of modes searched from the means of classes, in standard deviations.
const TOLERANCE_FROM_MEANS: f64 = 0.3;
/// Maximum number of iterations of a search from a mean.
const ITERATION_LIMIT: usize = 500;
/// Searches start from this many means that are closest to the data, at noise this many times that at which
/// the searches end; starting from all of them leads to no fewer false modes.
const MEANS: usize = 24;
const NEAREST_TEMPERING: f64 = 10.0;
/// A quick search starts with noise this many times that at which it ends, stops after this many iterations,
/// and moves this many coordinates of a class.
const QUICK_TEMPERING: f64 = 10.0;
const QUICK_LIMIT: usize = 6;
const QUICK_COORDINATES: usize = 10;
/// This many quick searches are continued to noise this many times the fine one, to this tolerance of the
/// mode there, within this number of iterations.
const FOLLOWED: usize = 14;
const FOLLOWED_TEMPERING: f64 = 2.0;
const FOLLOWED_TOLERANCE: f64 = 0.1;
const FOLLOWED_LIMIT: usize = 20;
/// They are continued as long as an estimate has taken fewer iterations than this, but at least one is: where
/// none converges, no class resembles the spectrum.
const ESTIMATE_LIMIT: usize = 260;
/// Maximum number of modes at which classes are distinguished; number of candidates searched, and their log
/// evidence relative to the best.
const PLACES: usize = 5;
const SEARCHED: usize = 4;
const LN_EVIDENCE_NEAR: f64 = -10.0;

/// The classes at the modes reached from all means, with the noise scaled by `tempering`, in order of
/// evidence: for too few channels to separate the classes.
pub fn from_means<F: Family>(
    family: &F,
    hypothesis: F::Hypothesis,
    prior: &Prior,
    tempering: f64,
) -> Vec<Start<F::Hypothesis>> {
    let (means, noise) = (usize::MAX, (f64::INFINITY, tempering));
    let search = FromMeans { hypothesis, means, noise, limit: ITERATION_LIMIT, coordinates: usize::MAX };
    search.starts(family, prior)
}

/// The classes of most evidence at the modes reached from the means: by quick searches at `coarse` times the
/// noise, continued to near `fine` times the noise, after an estimate has taken this many `iterations`.
pub fn between_means<F: Family>(
    family: &F,
    hypothesis: F::Hypothesis,
    prior: &Prior,
    [coarse, fine]: [f64; 2],
    iterations: usize,
    trace: &mut Vec<Vec<Iteration>>,
) -> Vec<Start<F::Hypothesis>> {
    let noise = (QUICK_TEMPERING * coarse, coarse);
    let quick =
        FromMeans { hypothesis, means: MEANS, noise, limit: QUICK_LIMIT, coordinates: QUICK_COORDINATES };
    let fine = FOLLOWED_TEMPERING * fine;
    let mut left = ESTIMATE_LIMIT.saturating_sub(iterations).max(FOLLOWED_LIMIT);
    let mut places: Vec<Start<F::Hypothesis>> = Vec::new();
    for start in quick.starts(family, prior).into_iter().take(FOLLOWED) {
        let Some(model) = family.model(hypothesis, &start.gaussian) else { continue };
        // a place that will not be among those looked at is abandoned
        let least = places.get(PLACES - 1).map_or(f64::NEG_INFINITY, |place| place.ln_evidence);
        let limits = Limits { iterations: FOLLOWED_LIMIT.min(left), ln_evidence: least - start.ln_share };
        let found = find_mode(&model, start.w, (start.tempering, fine), FOLLOWED_TOLERANCE, limits);
        drop(model);
        left -= found.trace.len();
        let ln_evidence = found.ln_evidence(fine).map(|of_facets| start.ln_share + of_facets);
        trace.push(found.trace);
        if let (Some(ln_evidence), Termination::Converged { .. }) = (ln_evidence, found.termination) {
            places.push(Start { ln_evidence, tempering: fine, w: found.w, ..start });
            places = distinct(places);
        }
    }
    let classes = |start: Start<F::Hypothesis>| {
        let model = family.model(hypothesis, &start.gaussian)?;
        let linear =
            Linear::laplace(&model, (&start.w, &model.linearise(&start.w)), fine, (hypothesis, 0.0))?;
        let is_telling = linear.is_telling(&start.gaussian);
        let candidates = candidates(family, vec![linear], prior);
        let ranked = worth_a_search(&candidates, is_telling);
        Some(ranked.iter().filter_map(|one| one.start(family, prior)).collect::<Vec<_>>())
    };
    let mut found = distinct(places.into_iter().take(PLACES).filter_map(classes).flatten().collect());
    let least = found.first().map_or(0.0, |most| most.ln_evidence + LN_EVIDENCE_NEAR);
    found.retain(|start| start.ln_evidence >= least);
    found.truncate(SEARCHED);
    found
}

/// Searches that start from the means of classes.
struct FromMeans<H> {
    hypothesis: H,
    /// Number of means, those closest to the facets.
    means: usize,
    /// Multiples of the noise: the maximum at the start, and that at the end.
    noise: (f64, f64),
    /// Maximum number of iterations of each search.
    limit: usize,
    /// Number of coordinates of a class that are moved.
    coordinates: usize,
}

impl<H: Copy> FromMeans<H> {
    /// Classes in order of evidence where the searches end.
    fn starts<F: Family<Hypothesis = H>>(&self, family: &F, prior: &Prior) -> Vec<Start<H>> {
        let &Self { hypothesis, means, noise: (most, last), limit, coordinates } = self;
        let ln_shares = family.ln_class_shares(hypothesis, prior);
        let of_class = |class: usize| {
            let gaussian = prior.classes()[class].gaussian();
            let moved = gaussian.leading(coordinates);
            let model = family.model(hypothesis, &moved)?;
            let w = DVector::zeros(model.unknowns());
            let first = first_tempering(&model, &w, last).min(most);
            let found = find_mode(&model, w, (first, last), TOLERANCE_FROM_MEANS, limit);
            let ln_evidence = ln_shares[class] + found.ln_evidence(last)?;
            let moved = moved.basis().ncols();
            let w = found.w.insert_rows(moved, gaussian.basis().ncols() - moved, 0.0);
            ln_evidence.is_finite().then_some((ln_evidence, w))
        };
        let nearest = nearest_means(family, hypothesis, prior, NEAREST_TEMPERING * last);
        let found = nearest.into_iter().take(means).filter_map(|class| {
            let (ln_evidence, w) = of_class(class)?;
            let (ln_share, gaussian) = (ln_shares[class], prior.classes()[class].gaussian().clone());
            Some(Start { hypothesis, class, tempering: last, ln_evidence, ln_share, gaussian, w })
        });
        let mut found: Vec<_> = found.collect();
        found.sort_by(|a, b| b.ln_evidence.total_cmp(&a.ln_evidence));
        found
    }
}

/// Classes in order of the distance of their means from the data, with the noise scaled by `tempering`, and
/// of their probabilities.
fn nearest_means<F: Family>(
    family: &F,
    hypothesis: F::Hypothesis,
    prior: &Prior,
    tempering: f64,
) -> Vec<usize> {
    let ln_shares = family.ln_class_shares(hypothesis, prior);
    let near = |(class, of_prior): (usize, &Class)| {
        let model = family.model(hypothesis, of_prior.gaussian())?;
        let distance = model.residuals(&DVector::zeros(model.unknowns())) / tempering;
        Some((ln_shares[class] - 0.5 * distance.norm_squared(), class))
    };
    let mut nearest: Vec<_> = prior.classes().iter().enumerate().filter_map(near).collect();
    nearest.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    nearest.into_iter().map(|(_, class)| class).collect()
}

/// Sorts by decreasing evidence and drops duplicates.
fn distinct<H>(mut starts: Vec<Start<H>>) -> Vec<Start<H>> {
    starts.sort_by(|a, b| b.ln_evidence.total_cmp(&a.ln_evidence));
    let mut kept: Vec<(Start<H>, DVector<f64>)> = Vec::new();
    for start in starts {
        let coordinates = start.w.rows(0, start.gaussian.basis().ncols()).into_owned();
        let reflectance = start.gaussian.logit_at(&coordinates).map(logistic);
        let near = APART * (reflectance.len() as f64).sqrt();
        let is_again = |(other, of_other): &(Start<H>, DVector<f64>)| {
            other.class == start.class && of_other.metric_distance(&reflectance) < near
        };
        if !kept.iter().any(is_again) {
            kept.push((start, reflectance));
        }
    }
    kept.into_iter().map(|(start, _)| start).collect()
}
