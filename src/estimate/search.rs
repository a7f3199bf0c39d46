//! The most probable spectrum over all hypotheses and all classes of spectra: one search for everything with
//! a prior.
//!
//! Each hypothesis is tried under all spectra as one Gaussian; the model linearised there gives the evidence
//! of every class of spectra ([`linear`](super::linear)). Those of most evidence are searched to their own
//! modes, and the estimate is the mean of these, weighted by evidence ([`mixture`](super::mixture)).

use std::cmp::Ordering;

use nalgebra::DVector;

use super::family::{Family, SpectrumModel};
use super::linear::{Candidate, Linear, Start, candidates, worth_a_search};
use super::mixture::{LocalMode, Mixture, Unsearched};
use super::prior::Prior;
use super::starts::{between_means, from_means};
use crate::solve::posterior::{Iteration, Limits, Model, Solution, find_mode, first_tempering};
use crate::solve::{Termination, ln_sum};

/// A mode needed only for sorting counts as found within this many standard deviations, and one at which
/// classes are distinguished within this many times the [tolerance](Family::tolerance).
const SORTING_TOLERANCE: f64 = 0.3;
const TELLING_TOLERANCE: f64 = 10.0;
const SORTING_LIMIT: usize = 500;
/// Each of many hypotheses starts near its mode, from that of a similar one: with this share of the usual
/// initial noise, and only until data are to change by no more than this share of the brightest, over which
/// a linear model holds.
const SHARE_OF_MANY: f64 = 0.2;
const FORESEEABLE: f64 = 0.03;
/// Classes are distinguished at these noise levels, relative to the brightest datum, or at the true one if
/// that is larger. At the coarse level the search under all spectra leads to a point where the model is
/// nearly linear; at the fine level the search under the most probable class does.
const SORTING_NOISE: f64 = 1e-3;
const FINE_NOISE: f64 = 1e-5;
/// That search ends this close to its mode, in standard deviations, or after this many iterations.
const FINE_TOLERANCE: f64 = 0.01;
const FINE_LIMIT: usize = 30;
/// Least log evidence relative to the first for a candidate that counts without a search, how many of them
/// count, and how many among many hypotheses.
const UNSEARCHED_LN_EVIDENCE_LEAST: f64 = -4.0;
const UNSEARCHED: usize = 15;
const UNSEARCHED_OF_MANY: usize = 100;
/// Hypotheses whose most probable class has a log evidence this close to the best are followed to the fine
/// noise, up to this number.
const FOLLOWED_LN_EVIDENCE_LEAST: f64 = -8.0;
const FOLLOWED: usize = 8;
/// Maximum number of iterations of all searches: more than all but a few spectra take and, for noisy data,
/// which may belong to another scene than stated, far more than any search that explains them takes.
const LIMIT: usize = 90;
const NOISY_LIMIT: usize = 600;
/// For precise data a mode may be false if its distance exceeds chance by this many standard deviations, or
/// if its search took more than [`LONG`] iterations. A mode from another start then counts by its evidence if
/// it explains the data.
const SURPRISE: f64 = 0.0;
const LONG: usize = 10;
/// Maximum number of iterations of each such search, if the data distinguish classes.
const ANOTHER_LIMIT: usize = 20;
/// Additional iterations of the best search if none has explained the data.
const CARRIED_ON: usize = 40;
/// A mode explains the data if its reduced chi is below this; beyond, the scene is not the one photographed,
/// and the evidence is meaningless.
const REDUCED_CHI_MOST: f64 = 1.1;

/// A hypothesis under all spectra as one Gaussian.
pub struct Sorted<H, S> {
    pub hypothesis: H,
    /// Logarithm of its prior probability.
    pub ln_share: f64,
    /// Logarithm of its evidence at the tempered noise.
    pub ln_evidence: f64,
    pub solution: Solution<S>,
}

impl<H, S> Sorted<H, S> {
    /// The same, relabelled as another hypothesis.
    pub fn for_hypothesis<T>(self, hypothesis: T) -> Sorted<T, S> {
        let Self { ln_share, ln_evidence, solution, .. } = self;
        Sorted { hypothesis, ln_share, ln_evidence, solution }
    }

    /// Logarithm of evidence times probability.
    pub fn ln_weight(&self) -> f64 {
        self.ln_share + self.ln_evidence
    }

    /// Order in which the more probable comes first.
    pub fn order(&self, other: &Self) -> Ordering {
        other.ln_weight().total_cmp(&self.ln_weight())
    }
}

/// A search within a family of models.
pub struct Search<'a, F: Family> {
    pub family: &'a F,
    pub prior: &'a Prior,
    /// Factors by which the noise is tempered while hypotheses and classes are distinguished.
    coarse: f64,
    fine: f64,
    /// Iterations by run.
    pub trace: Vec<Vec<Iteration>>,
    /// Number of candidates that were not searched, as the evidence is against them.
    pub skipped: usize,
}

type LocalModes<F> = Vec<LocalMode<<F as Family>::Hypothesis, <F as Family>::Second>>;

impl<'a, F: Family> Search<'a, F> {
    pub fn new(family: &'a F, prior: &'a Prior) -> Self {
        let [coarse, fine] = [SORTING_NOISE, FINE_NOISE].map(|noise| (noise * family.peak()).max(1.0));
        Self { family, prior, coarse, fine, trace: Vec::new(), skipped: 0 }
    }

    /// Searches a hypothesis, given with the logarithm of its probability, starting from `start` or from the
    /// mean; `None` if there is no mode. The search is abandoned when the logarithm of evidence times
    /// probability cannot reach `ln_least`.
    pub fn sort(
        &mut self,
        (hypothesis, ln_share): (F::Hypothesis, f64),
        start: Option<DVector<f64>>,
        ln_least: f64,
    ) -> Option<Sorted<F::Hypothesis, F::Second>> {
        let model = self.family.model(hypothesis, self.prior.broad())?;
        let start = start.unwrap_or_else(|| DVector::zeros(model.unknowns()));
        let is_one_of_many = self.family.has_many_hypotheses();
        let (share, tolerance) = if is_one_of_many {
            (SHARE_OF_MANY, (FORESEEABLE * self.family.peak() / self.coarse).max(SORTING_TOLERANCE))
        } else {
            (1.0, SORTING_TOLERANCE)
        };
        let first = (share * first_tempering(&model, &start, self.coarse)).max(self.coarse);
        let ln_evidence = ln_least - ln_share - model.ln_whitening();
        let limits = Limits { iterations: SORTING_LIMIT, ln_evidence };
        let found = find_mode(&model, start, (first, self.coarse), tolerance, limits);
        let solution = if is_one_of_many { found.foreseen(self.coarse)? } else { found };
        self.trace.push(solution.trace.clone());
        let ln_evidence = solution.ln_evidence(self.coarse)? + model.ln_whitening();
        ln_evidence.is_finite().then_some(Sorted { hypothesis, ln_share, ln_evidence, solution })
    }

    /// Factor by which the noise is tempered while hypotheses are sorted.
    pub fn tempering(&self) -> f64 {
        self.coarse
    }

    /// Factor by which the noise of precise facets is tempered while classes are distinguished; 1 if they are
    /// not precise.
    pub fn fine_tempering(&self) -> f64 {
        self.fine
    }

    /// The mean of all modes of most evidence under the `sorted` hypotheses.
    pub fn mixture(
        &mut self,
        sorted: &[Sorted<F::Hypothesis, F::Second>],
    ) -> Option<Mixture<F::Hypothesis, F::Second>> {
        let Self { family, prior, coarse, fine, .. } = *self;
        let are_precise = coarse.min(fine) > 1.0;
        let (mut ranked, mut is_telling) = (Vec::new(), false);
        if family.tells_classes() {
            let linears: Vec<_> = sorted.iter().filter_map(|one| self.laplace(one)).collect();
            is_telling = linears.first().is_some_and(|linear| linear.is_telling(prior.broad()));
            ranked = candidates(family, linears, prior);
        }
        if fine < coarse {
            ranked = self.nearer(&ranked).unwrap_or(ranked);
        }
        let tried = worth_a_search(&ranked, is_telling).len();
        self.skipped = ranked.len() - tried;
        let starts: Vec<_> = ranked[..tried].iter().filter_map(|one| one.start(family, prior)).collect();
        let limit = if are_precise { LIMIT } else { NOISY_LIMIT } / starts.len().max(1);
        let mut starts = starts.into_iter();
        let mut found = Vec::new();
        for start in starts.by_ref() {
            found.extend(self.maximum(start, limit));
            // the others start near it: other starts are more promising
            if are_precise && !found.iter().any(explains) {
                break;
            }
        }
        let more = if found.is_empty() && !family.tells_classes() {
            from_means(family, sorted.first()?.hypothesis, prior, coarse)
        } else if !found.iter().any(explains) || (are_precise && is_doubtful(&found)) {
            let taken = self.trace.iter().chain(found.iter().map(|one| &one.trace)).map(Vec::len).sum();
            let hypothesis = sorted.first()?.hypothesis;
            between_means(family, hypothesis, prior, [coarse, fine], taken, &mut self.trace)
        } else {
            Vec::new()
        };
        let another_limit =
            if family.tells_classes() { ANOTHER_LIMIT } else { NOISY_LIMIT / more.len().max(1) };
        let more: Vec<_> = more.into_iter().filter_map(|start| self.maximum(start, another_limit)).collect();
        add(&mut found, more);
        let is_explained = |found: &LocalModes<F>| !are_precise || found.iter().any(explains);
        if !is_explained(&found) {
            found.extend(starts.filter_map(|start| self.maximum(start, limit)));
        }
        if !is_explained(&found) {
            self.carry_on(&mut found);
        }
        if found.is_empty() {
            let Sorted { hypothesis, ln_share, ln_evidence, solution } = sorted.first()?;
            let (gaussian, w) = (prior.broad().clone(), solution.w.clone());
            let all = Start {
                hypothesis: *hypothesis,
                class: usize::MAX,
                tempering: coarse,
                ln_evidence: *ln_evidence,
                ln_share: *ln_share,
                gaussian,
                w,
            };
            found.extend(self.maximum(all, 0));
        }
        self.trace.extend(found.iter().map(|one| one.trace.clone()));
        // evidence at more noise than the data have does not serve for weighing, nor does that of a scene
        // which does not explain them
        let count = match family.has_many_hypotheses() {
            _ if are_precise => 0,
            true => UNSEARCHED_OF_MANY,
            false => UNSEARCHED,
        };
        let least = ranked.first().map_or(0.0, |first| first.ln_evidence + UNSEARCHED_LN_EVIDENCE_LEAST);
        let unsearched = ranked[tried..].iter().take_while(|one| one.ln_evidence >= least).take(count);
        let unsearched: Vec<_> = unsearched.filter_map(|one| Unsearched::of(family, one, prior)).collect();
        Mixture::of(found, &unsearched)
    }

    /// The model linearised about the mode of a hypothesis.
    fn laplace(&self, one: &Sorted<F::Hypothesis, F::Second>) -> Option<Linear<F::Hypothesis>> {
        let model = self.family.model(one.hypothesis, self.prior.broad())?;
        let of = (one.hypothesis, one.ln_share);
        let tolerance = TELLING_TOLERANCE * self.family.tolerance();
        if tolerance >= SORTING_TOLERANCE || self.family.has_many_hypotheses() {
            return Linear::laplace(&model, (&one.solution.w, &one.solution.at), self.coarse, of);
        }
        let Solution { w, at, .. } =
            find_mode(&model, one.solution.w.clone(), (self.coarse, self.coarse), tolerance, SORTING_LIMIT);
        Linear::laplace(&model, (&w, &at), self.coarse, of)
    }

    /// Log evidence of a hypothesis, summed over all classes of spectra, or under all spectra as one Gaussian
    /// if data do not distinguish classes.
    pub fn ln_evidence_by_classes(&self, one: &Sorted<F::Hypothesis, F::Second>) -> Option<f64> {
        if !self.family.tells_classes() {
            return Some(one.ln_evidence);
        }
        let all = candidates(self.family, vec![self.laplace(one)?], self.prior);
        Some(ln_sum(&all.iter().map(|class| class.ln_evidence).collect::<Vec<_>>()))
    }

    fn maximum(
        &self,
        start: Start<F::Hypothesis>,
        limit: usize,
    ) -> Option<LocalMode<F::Hypothesis, F::Second>> {
        let gaussian = start.gaussian.clone();
        let model = self.family.model(start.hypothesis, &gaussian)?;
        let found =
            find_mode(&model, start.w.clone(), (start.tempering, 1.0), self.family.tolerance(), limit);
        Some(LocalMode::of(&model, found, start))
    }

    /// Candidates from linearisation at the fine noise, about the mode under the most probable class of each
    /// hypothesis that is close to the best; `None` if no search converges.
    fn nearer(&mut self, ranked: &[Candidate<F::Hypothesis>]) -> Option<Vec<Candidate<F::Hypothesis>>> {
        let least = ranked.first()?.ln_evidence + FOLLOWED_LN_EVIDENCE_LEAST;
        let mut firsts: Vec<&Candidate<F::Hypothesis>> = Vec::new();
        for one in ranked.iter().take_while(|one| one.ln_evidence >= least) {
            if firsts.len() < FOLLOWED
                && firsts.iter().all(|first| first.linear.hypothesis != one.linear.hypothesis)
            {
                firsts.push(one);
            }
        }
        let linears = firsts.into_iter().filter_map(|first| self.laplace_fine(first)).collect();
        Some(candidates(self.family, linears, self.prior)).filter(|found| !found.is_empty())
    }

    /// The model linearised about the mode under a candidate at the fine noise; `None` if the search does not
    /// converge.
    fn laplace_fine(&mut self, candidate: &Candidate<F::Hypothesis>) -> Option<Linear<F::Hypothesis>> {
        let start = candidate.start(self.family, self.prior)?;
        let model = self.family.model(start.hypothesis, &start.gaussian)?;
        let found = find_mode(&model, start.w, (start.tempering, self.fine), FINE_TOLERANCE, FINE_LIMIT);
        self.trace.push(found.trace);
        match found.termination {
            Termination::Converged { .. } => {
                let of = (start.hypothesis, candidate.linear.ln_share);
                Linear::laplace(&model, (&found.w, &found.at), self.fine, of)
            }
            Termination::NoProgress { .. } | Termination::IterationLimit => None,
        }
    }

    /// Continues the search of most evidence.
    fn carry_on(&self, found: &mut LocalModes<F>) {
        let most = (0..found.len()).max_by(|a, b| found[*a].ln_evidence.total_cmp(&found[*b].ln_evidence));
        if let Some(LocalMode { start, trace, .. }) = most.map(|most| found.swap_remove(most))
            && let Some(mut further) = self.maximum(start, CARRIED_ON)
        {
            further.trace = [trace, further.trace].concat();
            found.push(further);
        }
    }
}

/// True if the data are as close as their noise permits.
fn explains<H, S>(one: &LocalMode<H, S>) -> bool {
    one.rms < REDUCED_CHI_MOST
}

/// Adds modes that explain the data, each once; all of them if there are no others.
fn add<H: Copy, S>(found: &mut Vec<LocalMode<H, S>>, more: Vec<LocalMode<H, S>>) {
    let all_count = found.is_empty();
    for one in more {
        if (all_count || explains(&one)) && !found.iter().any(|other| one.is_again(other)) {
            found.push(one);
        }
    }
}

/// True if another mode may have more evidence than those found, which precise data show by a poor fit or a
/// long search.
fn is_doubtful<H, S>(found: &[LocalMode<H, S>]) -> bool {
    let most = found.iter().max_by(|a, b| a.ln_evidence.total_cmp(&b.ln_evidence));
    most.is_none_or(|most| most.surprise > SURPRISE || most.trace.len() > LONG)
}
