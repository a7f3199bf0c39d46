//! Where else to look for the most probable spectrum: from the means of classes.
//!
//! Of one channel or two, spectra of every kind make the same (in light of one colour a red sheet may be a
//! blue one), and many channels that are nearly alike mislead. Precise facets have several maxima, and the
//! one that all spectra as one Gaussian lead to may be false.

use nalgebra::DVector;

use super::family::Family;
use super::gaussian::logistic;
use super::linear::{Linear, Start, candidates};
use super::most_evidence::{APART, of_most_evidence};
use super::prior::{Class, Prior};
use crate::solve::Termination;
use crate::solve::posterior::{Iteration, Model, find_mode, first_tempering};

/// Maxima from the means of classes are distinguished this near to them.
const TOLERANCE_FROM_MEANS: f64 = 0.3;
/// Most iterations of a search from a mean.
const ITERATION_LIMIT: usize = 500;
/// Searches are from so many means that come nearest to the data, the noise being so many times that at which
/// the searches end: from all of them no fewer maxima are false.
const MEANS: usize = 24;
const NEAREST_TEMPERING: f64 = 10.0;
/// A quick search sets out from noise so many times that at which it ends, ends after so many iterations, and
/// moves so many coordinates of a class.
const QUICK_TEMPERING: f64 = 10.0;
const QUICK_LIMIT: usize = 6;
const QUICK_COORDINATES: usize = 10;
/// So many quick searches are followed to noise so many times the fine one, as near to the maximum there as
/// that, in so many iterations at most.
const FOLLOWED: usize = 14;
const FOLLOWED_TEMPERING: f64 = 2.0;
const FOLLOWED_TOLERANCE: f64 = 0.1;
const FOLLOWED_LIMIT: usize = 20;
/// All of them are followed while an estimate has taken fewer iterations, at least one is: where nothing
/// comes to an end, no class is like the spectrum.
const ESTIMATE_LIMIT: usize = 260;
/// Classes are distinguished at so many maxima, and so many are searched of those that come near to the best,
/// as the logarithm of a share of its evidence.
const PLACES: usize = 5;
const SEARCHED: usize = 4;
const LN_EVIDENCE_NEAR: f64 = -10.0;

/// The classes of most evidence at the maxima that the means nearest to the data lead to, the noise
/// `tempering` times its size; all of them none if there are too few channels to separate the classes.
pub fn from_means<F: Family>(
    family: &F,
    hypothesis: F::Hypothesis,
    prior: &Prior,
    tempering: f64,
) -> Vec<Start<F::Hypothesis>> {
    let tell_apart = family.tells_classes();
    let means = if tell_apart { MEANS } else { usize::MAX };
    let noise = (f64::INFINITY, tempering);
    let search = FromMeans { hypothesis, means, noise, limit: ITERATION_LIMIT, coordinates: usize::MAX };
    let mut found = search.starts(family, prior);
    if tell_apart {
        found.truncate(of_most_evidence(&found, |start| start.ln_evidence, true).len());
    }
    found
}

/// The classes of most evidence at the maxima that the means lead to: quickly where the noise is `coarse`
/// times its size, then to the end near `fine` times, after an estimate has taken so many iterations.
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
    let follow = |start: Start<F::Hypothesis>| {
        let model = family.model(hypothesis, &start.gaussian)?;
        let noise = (start.tempering, fine);
        let found = find_mode(&model, start.w, noise, FOLLOWED_TOLERANCE, FOLLOWED_LIMIT.min(left));
        left -= found.trace.len();
        let ln_evidence = start.ln_share + found.ln_evidence(fine)?;
        let has_converged = matches!(found.termination, Termination::Converged { .. });
        trace.push(found.trace);
        drop(model);
        has_converged.then_some(Start { ln_evidence, tempering: fine, w: found.w, ..start })
    };
    let quick = quick.starts(family, prior).into_iter();
    let places = distinct(quick.take(FOLLOWED).filter_map(follow).collect());
    let classes = |start: Start<F::Hypothesis>| {
        let model = family.model(hypothesis, &start.gaussian)?;
        let linear =
            Linear::laplace(&model, (&start.w, &model.linearise(&start.w)), fine, (hypothesis, 0.0))?;
        let is_telling = linear.is_telling(&start.gaussian);
        let candidates = candidates(family, vec![linear], prior);
        let ranked = of_most_evidence(&candidates, |one| one.ln_evidence, is_telling);
        Some(ranked.iter().filter_map(|one| one.start(family, prior)).collect::<Vec<_>>())
    };
    let mut found = distinct(places.into_iter().take(PLACES).filter_map(classes).flatten().collect());
    let least = found.first().map_or(0.0, |most| most.ln_evidence + LN_EVIDENCE_NEAR);
    found.retain(|start| start.ln_evidence >= least);
    found.truncate(SEARCHED);
    found
}

/// Searches from the means of classes.
struct FromMeans<H> {
    hypothesis: H,
    /// From so many that are nearest to the facets.
    means: usize,
    /// How many times its size the noise is at first, if not less, and at last.
    noise: (f64, f64),
    /// Most iterations of each.
    limit: usize,
    /// Coordinates of a class that are moved.
    coordinates: usize,
}

impl<H: Copy> FromMeans<H> {
    /// Classes by their evidence where the searches end.
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

/// Classes by how near their means come to the data, the noise `tempering` times its size, and by their
/// shares.
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

/// By their evidence, most first, and none that is another one again.
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
