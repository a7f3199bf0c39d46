//! The most probable spectrum under all hypotheses on photographs of a sheet: usual ones with each sheet
//! model, or an ideal fold.

use std::iter;

use nalgebra::DVector;

use super::conditions::StatedScene;
use super::corners;
use super::day::{Day, DayEstimate};
use super::family::{Photographs, Seen};
use super::findings::{of_day, of_unknowns};
use super::hypotheses::{Hypothesis, Mistake, dull_days, ideal_hypotheses};
use super::parts::Parts;
use super::sorting::{LN_EVIDENCE_HOPELESS, LN_EVIDENCE_NEAR, Tried, sorted};
use super::whitened::Photograph;
use crate::error::{Error, Result};
use crate::estimate::emission::{Origin, SIZES};
use crate::estimate::family::Family;
use crate::estimate::fluorescence::Fluorescence;
use crate::estimate::fluorescence_search::{self, is_hopeful, nearest_size};
use crate::estimate::mixture::Mixture;
use crate::estimate::prior::Prior;
use crate::estimate::search::Search;
use crate::estimate::searched::Trace;
use crate::estimate::{Estimate, Fitted};
use crate::kernel::skipped::Skipped;
use crate::solve::dense::rms;
use crate::solve::forecast::ScoreTest;
use crate::solve::ln_sum;
use crate::solve::posterior::{Iteration, Model};

/// Photographs of a sheet, with hypotheses on them weighed under all spectra as one: what the estimate, and
/// searches in another light or of another camera, start from.
pub struct Weighed<'a> {
    /// The photographs, with errors relative to predicted values.
    pub photographs: Photographs<'a>,
    /// The most probable kind of day; `None` if the light is not daylight.
    pub day: Option<DayEstimate>,
    /// The mode of a sheet of the [family](super::sheet_models::SheetModel::Family) on that kind of day; if
    /// the light is not daylight, on the first that was tried.
    pub of_family: Option<(Day, DVector<f64>)>,
    /// Logarithm of how many times as probable the facets of a usual photograph are if the sheet may emit
    /// light: other lights and cameras, in which it is assumed not to, must be ahead by more.
    pub ln_by_emission: f64,
    /// The hypotheses that the evidence does not rule out, in order of evidence.
    sorted: Vec<Tried>,
    /// Iterations by run.
    trace: Trace,
}

/// A sheet as inferred from its photographs.
pub struct SheetEstimate {
    /// One estimate per photograph: spectrum and error bars are common to all, the rest is individual.
    pub photographs: Vec<Estimate>,
    /// Log evidence of all facets, up to a term that depends on each photograph alone: the difference between
    /// one sheet and several decides between the two.
    pub ln_evidence: f64,
}

/// Weighs all hypotheses on photographs of one sheet, one or more.
///
/// # Errors
/// [`Error::Numeric`] if the facets are not finite.
pub fn weigh<'a>(parts: &'a [Parts], prior: &Prior) -> Result<Weighed<'a>> {
    Weighed::of(parts, prior, false).ok_or_else(not_finite)
}

/// The estimate from photographs of one sheet, one or more.
///
/// # Errors
/// As [`weigh`].
pub fn estimate(parts: &[Parts], prior: &Prior) -> Result<SheetEstimate> {
    weigh(parts, prior)?.estimate(prior)
}

/// The estimate from photographs assumed to be usual ones on a clear day, however ideal their facets: those
/// of planned photographs are ideal.
///
/// # Errors
/// As [`estimate`]; [`Error::Field`] if the stated scene has no sun, which is required here.
pub fn estimate_usual(parts: &[Parts], prior: &Prior) -> Result<SheetEstimate> {
    if parts.iter().any(|one| one.stated.sun <= 0.0) {
        let problem = "photographs are joined and planned only in sunlight; \
                       estimate one lit by the sky alone by itself";
        return Err(Error::field("light.sun", problem));
    }
    Weighed::of(parts, prior, true).ok_or_else(not_finite)?.estimate(prior)
}

fn not_finite() -> Error {
    Error::Numeric("the facets of the photograph are not finite".to_owned())
}

impl<'a> Weighed<'a> {
    /// `None` if the facets are not finite.
    fn of(parts: &'a [Parts], prior: &Prior, are_usual: bool) -> Option<Self> {
        let (photographs, start) = Photographs::of(parts, prior)?;
        let (ideal, dull_days) = match are_usual {
            true => (Vec::new(), Vec::new()),
            false => (ideal_hypotheses(&photographs.0), dull_days(&photographs.0)),
        };
        let (mut sorted, mut trace) = sorted(&photographs, prior, (ideal, start), &dull_days)?;
        let mut search = Search::new(&photographs, prior);
        let ln_by_emission = add_emitting(&mut search, &mut sorted).unwrap_or(0.0);
        sorted.sort_by(Tried::order);
        trace.extend(search.trace);
        let day = day(&sorted, &photographs.0);
        let of_family = sorted.iter().find(|Tried { hypothesis, .. }| {
            let Hypothesis { day: own, emission, .. } = *hypothesis;
            *hypothesis == Hypothesis { emission, ..Hypothesis::of_family(own) }
                && day.is_none_or(|found| found.day == own)
        });
        let of_family = of_family.map(|one| (one.hypothesis.day, one.solution.w.clone()));
        let least = sorted.first()?.ln_weight() + LN_EVIDENCE_NEAR;
        sorted.retain(|one| one.ln_weight() >= least);
        Some(Self { photographs, day, of_family, ln_by_emission, sorted, trace })
    }

    /// The estimate under all hypotheses that remain possible.
    ///
    /// # Errors
    /// [`Error::Numeric`] if the facets are not finite.
    pub fn estimate(&self, prior: &Prior) -> Result<SheetEstimate> {
        self.mixture(prior).ok_or_else(not_finite)
    }

    fn mixture(&self, prior: &Prior) -> Option<SheetEstimate> {
        let Self { photographs, day, .. } = self;
        let mut search = Search::new(photographs, prior);
        search.trace.clone_from(&self.trace);
        let found = search.mixture(&self.sorted)?;
        let seen = photographs.seen(&found.best)?;
        let without = found.shares.iter().filter(|(hypothesis, _)| !hypothesis.has_bounces());
        // shares may add up to slightly more than 1 by rounding
        let without_bounces = without.map(|(_, share)| share).sum::<f64>().min(1.0);
        let of = |(photograph, seen): (&Photograph, Seen)| {
            let (findings, skipped) =
                (all_findings(photograph, &found, &seen, *day), skipped(&seen.fitted, search.skipped));
            let fluorescence = fluorescence(photograph, &found);
            let estimate = of_photograph(&found, seen, &search.trace);
            Estimate { findings, day: *day, without_bounces, skipped, fluorescence, ..estimate }
        };
        let estimates = photographs.0.iter().zip(seen).map(of).collect();
        Some(SheetEstimate { photographs: estimates, ln_evidence: found.ln_evidence })
    }
}

/// Adds to the real fold of most evidence the same fold of a sheet that fluoresces and, where the exposure is
/// known and cannot take that up, of a thin one, as far as the score test leaves them hope. The other folds
/// are then of sheets that emit nothing. Ideal folds are not tried: to their precision another light looks
/// like a dye, and the rounding of a JPEG like a faint brightener. Joined photographs share the emission, as
/// a fraction of white in the light of each, and are tried if the sheet was backed alike in all.
///
/// Returns the logarithm of how many times as probable emission makes the facets; `None` if it is not tried.
fn add_emitting(search: &mut Search<Photographs>, all: &mut Vec<Tried>) -> Option<f64> {
    let (family, broad) = (search.family, search.prior.broad());
    let first = family.0.first()?;
    if family.0.iter().any(|one| one.parts.stated.backing != first.parts.stated.backing) {
        return None;
    }
    let least = all.first()?.ln_weight() + LN_EVIDENCE_NEAR;
    let is_real = |one: &&Tried| one.hypothesis.has_bounces() && !one.hypothesis.imperfection.is_ideal();
    let best = all.iter().find(is_real).filter(|one| one.ln_weight() >= least)?;
    let (of_best, w, ln_best, ln_share) =
        (best.hypothesis, best.solution.w.clone(), best.ln_weight(), best.ln_share);
    let test = ScoreTest::at(&best.solution, search.tempering())?;
    let residuals = best.solution.at.residuals.clone();
    let logit = broad.logit_at(&w.rows(0, broad.basis().ncols()).into_owned());
    let is_exposure_known = family.0.iter().all(|one| one.parts.stated.exposure.is_some());
    let plain = family.model(of_best, broad)?;
    let (mut found, mut ln_gains) = (Vec::new(), vec![0.0]);
    for (place, emission) in first.emissions().iter().enumerate() {
        let is_tried = match emission.origin() {
            Some(Origin::Ultraviolet | Origin::Visible) => emission.is_excited(),
            Some(Origin::Behind) => is_exposure_known,
            None => false,
        };
        if !is_tried {
            continue;
        }
        let hypothesis = Hypothesis { emission: Some(place), ..of_best };
        let model = family.model(hypothesis, broad)?;
        let mut start = model.carried(&plain, &w);
        let [.., of_emission, _] = model.first().model.layout();
        let size = *model.first().places.get(of_emission)?;
        let changes = SIZES.map(|(probability, number)| {
            let mut at = start.clone();
            at[size] = number;
            (probability, &residuals - model.residuals(&at))
        });
        drop(model);
        if is_hopeful(&test, &changes, emission, &logit) {
            start[size] = nearest_size(&residuals, &changes, search.tempering());
            let tried = search.sort((hypothesis, ln_share), Some(start), ln_best + LN_EVIDENCE_HOPELESS);
            ln_gains.extend(tried.iter().map(|one| one.ln_weight() - ln_best + emission.ln_share(&logit)));
            found.extend(tried);
        }
    }
    if found.is_empty() {
        return Some(0.0);
    }
    let folds = all.iter_mut().filter(|one| one.hypothesis.has_bounces());
    folds.for_each(|one| one.hypothesis.emission = Some(0));
    all.append(&mut found);
    Some(ln_sum(&ln_gains))
}

/// The emission of the sheet of a photograph, if it probably has any.
fn fluorescence(photograph: &Photograph, found: &Mixture<Hypothesis, ()>) -> Option<Fluorescence> {
    let origin = |hypothesis: &Hypothesis| photograph.emissions().get(hypothesis.emission?)?.origin();
    let shares = found.shares.iter().map(|(hypothesis, share)| (origin(hypothesis), *share));
    let nothing = photograph.emissions().first()?;
    let first = 2 * nothing.wavelengths_nm().len();
    fluorescence_search::found(shares, (&found.values, found.spread.as_ref()), nothing, first)
}

/// The most probable kind of day among hypotheses sorted by evidence; `None` if the light is not daylight.
/// Sheets without a fold are assumed to be in the sun, and reveal nothing about the day.
fn day(sorted: &[Tried], photographs: &[Photograph]) -> Option<DayEstimate> {
    photographs.iter().all(|one| one.parts.stated.daylight.is_some()).then_some(())?;
    let folds = || sorted.iter().filter(|one| one.hypothesis.has_bounces());
    let ln_most = folds().next()?.ln_weight();
    let mut probabilities = [0.0; Day::ALL.len()];
    for one in folds() {
        probabilities[one.hypothesis.day as usize] += (one.ln_weight() - ln_most).exp();
    }
    let sum: f64 = probabilities.iter().sum();
    let found = iter::zip(Day::ALL, probabilities.map(|odds| odds / sum));
    let (day, probability) = found.max_by(|(_, a), (_, b)| a.total_cmp(b))?;
    Some(DayEstimate { day, probability })
}

/// Deviations of a photograph from the ideal: unknowns of its scene, and corners that are not where they were
/// marked.
fn all_findings(
    Photograph { parts, .. }: &Photograph,
    found: &Mixture<Hypothesis, ()>,
    seen: &Seen,
    day: Option<DayEstimate>,
) -> Vec<super::Finding> {
    let hypothesis = found.best.start.hypothesis;
    // an ideal fold under another sky is one of a white sky, whose amount is a finding of its own
    let day = day.filter(|_| hypothesis.mistake != Some(Mistake::Sky));
    let mut findings: Vec<_> = day.and_then(of_day).into_iter().collect();
    let stated = StatedScene { day: hypothesis.day, ..parts.stated };
    findings.extend(of_unknowns(&seen.fitted, &stated, hypothesis));
    if !hypothesis.imperfection.is_ideal() {
        findings.extend(corners::findings(&seen.shifts, &seen.residuals, parts.stated.priors.corner));
    }
    findings
}

/// Quantities about which the facets say nothing.
fn skipped(fitted: &[Fitted], searches: usize) -> Vec<Skipped> {
    let searches = Skipped {
        what: "searches with one sheet model and one class of spectra",
        count: searches,
        why: "the evidence is against them",
    };
    let unknowns = Skipped {
        what: "unknowns of the scene",
        count: fitted.iter().filter(|one| !one.supported).count(),
        why: "the facets hardly constrain them: their values are mostly the priors'",
    };
    [searches, unknowns].into_iter().filter(|one| one.count > 0).collect()
}

/// The mean of all modes as the estimate of a photograph.
fn of_photograph(found: &Mixture<Hypothesis, ()>, seen: Seen, trace: &[Vec<Iteration>]) -> Estimate {
    let bands = found.values.len() / 3;
    let is_ideal = found.best.start.hypothesis.imperfection.is_ideal();
    // weights may add up to slightly more than 1 by rounding
    let within = |values: &[f64]| values.iter().map(|value| value.min(1.0)).collect::<Vec<_>>();
    let (reflectance, albedo) = found.values[..2 * bands].split_at(bands);
    let left = (rms(&seen.residuals), seen.unexplained);
    Estimate {
        albedo: (!is_ideal).then(|| within(albedo)),
        spread: found.spread.as_ref().map(|spread| spread.columns(0, bands).into_owned()),
        fitted: seen.fitted,
        ..Estimate::searched(
            within(reflectance),
            seen.exposure,
            left,
            (trace.to_vec(), found.best.termination),
        )
    }
}
