//! The most probable spectrum under all kinds of sheets and all classes of spectra.
//!
//! Every kind of sheet is tried under all spectra as one Gaussian; those of evidence are tried again under the classes that the
//! model, linearised there, leaves possible. What is reported is the mean over all of these, weighed by their evidence, and the error
//! bars hold how far they are apart.

use nalgebra::{DMatrix, DVector};

use super::corners;
use super::error::ModelError;
use super::findings::findings;
use super::joint::{JointModel, Member, Photograph};
use super::likely::{
    About, Likely, LinearMaximum, hypotheses, hypotheses_without_bounces, ln_all_shares, usual_hypotheses,
};
use super::model::{Hypothesis, Point};
use super::parts::Parts;
use crate::error::{Error, Result};
use crate::estimate::prior::Prior;
use crate::estimate::unknowns::EXPOSURE;
use crate::estimate::{Estimate, Fitted};
use crate::kernel::skipped::Skipped;
use crate::solve::Termination;
use crate::solve::posterior::{Iteration, Model, Solution, first_inflation, information, maximise};

/// Maxima are told apart this near to them, and counted as found, in standard deviations.
const SORTING_TOLERANCE: f64 = 0.3;
const TOLERANCE: f64 = 3e-2;
/// Most iterations of a search.
const SORTING_LIMIT: usize = 25;
const LIMIT: usize = 60;
/// Pairs of a kind of sheets and a class of spectra that are tried further, and the least evidence for one of them, or for a kind of sheets,
/// as the logarithm of its share of the first's.
const TRIED: usize = 5;
const LN_EVIDENCE_LEAST: f64 = -5.0;
/// Where a hypothesis has so little evidence, likewise, others like it are not tried.
const LN_EVIDENCE_HOPELESS: f64 = -60.0;
/// Most pairs that are weighed without a search beside those.
const BESIDE: usize = 15;
/// A number is told by the facets if its standard deviation is below that share of what it was before.
const SUPPORTED: f64 = 0.8;
/// Step of difference quotients, in standard deviations.
const STEP: f64 = 1e-3;

/// A maximum.
struct Maximum {
    hypothesis: Hypothesis,
    ln_evidence: f64,
    albedo: Vec<f64>,
    reflectance: DVector<f64>,
    /// The product of its transpose with it is the covariance of the reflectance.
    spread: DMatrix<f64>,
    /// Of each photograph.
    seen: Vec<Seen>,
    trace: Vec<Iteration>,
    termination: Termination,
}

/// A hypothesis under all spectra as one Gaussian.
struct Sorted {
    hypothesis: Hypothesis,
    /// Logarithm of how often it is true.
    ln_share: f64,
    ln_evidence: f64,
    solution: Solution<()>,
}

/// A pair of a kind of sheets and a class of spectra that was not searched.
struct Beside {
    ln_evidence: f64,
    albedo: Vec<f64>,
    reflectance: DVector<f64>,
}

/// A photograph at a maximum.
struct Seen {
    exposure: f64,
    fitted: Vec<Fitted>,
    /// What is left of the facets, whitened.
    residuals: DVector<f64>,
    unexplained: f64,
}

/// A sheet as its photographs show it.
pub struct SheetEstimate {
    /// One estimate for each photograph: spectrum and error bars are the same in all, the rest is the photograph's own.
    pub photographs: Vec<Estimate>,
    /// Logarithm of the probability of all facets under what is known of sheets and scenes, but for a term that depends on each
    /// photograph alone: the difference between one sheet and several tells which it is.
    pub ln_evidence: f64,
}

/// The estimate from photographs of one sheet, one or more.
///
/// # Errors
/// [`Error::Numeric`] if the facets are not finite.
pub fn estimate(parts: &[Parts], prior: &Prior, error: ModelError) -> Result<SheetEstimate> {
    under(parts, prior, error, hypotheses)
}

/// The estimate from photographs that are as people take them, however ideal their facets are, as those of photographs that are only planned.
///
/// # Errors
/// As [`estimate`].
pub fn estimate_usual(parts: &[Parts], prior: &Prior, error: ModelError) -> Result<SheetEstimate> {
    under(parts, prior, error, |_| usual_hypotheses())
}

fn under(
    parts: &[Parts],
    prior: &Prior,
    error: ModelError,
    hypotheses: impl Fn(&[Photograph]) -> Vec<Hypothesis>,
) -> Result<SheetEstimate> {
    let not_finite = || Error::Numeric("the facets of the photograph are not finite".to_owned());
    let photographs = relative_to_predictions(Photograph::all(parts, error), prior).ok_or_else(not_finite)?;
    let sorted = sorted(&photographs, prior, hypotheses(&photographs));
    let without_bounces = without_bounces(&photographs, prior, &sorted);
    let mut trace: Vec<Vec<Iteration>> = sorted.iter().map(|one| one.solution.trace.clone()).collect();
    let likely: Result<Vec<_>> = sorted
        .iter()
        .map(|one| {
            let about = About::new(prior.broad(), &one.solution).ok_or_else(not_finite)?;
            about.classes((one.hypothesis, one.ln_share), prior, one.ln_evidence).ok_or_else(not_finite)
        })
        .collect();
    let likely: Vec<Likely> = likely?.into_iter().flatten().collect();
    let searches = likely.len();
    let mut likely = most_evident(likely, TRIED + BESIDE, |one| one.ln_evidence);
    let minor = likely.split_off(TRIED.min(likely.len()));
    let skipped_searches = searches - likely.len();
    let mut maxima = Vec::new();
    for Likely { hypothesis, class, scale, ln_share, about, .. } in likely {
        let gaussian = class.gaussian().scaled(scale);
        let model = JointModel::new(&photographs, hypothesis, &gaussian).ok_or_else(not_finite)?;
        let start = about.start(&model, &gaussian).ok_or_else(not_finite)?;
        let found = search(&model, start, TOLERANCE, LIMIT);
        maxima.extend(Maximum::of(&model, &found, ln_share));
    }
    let beside: Vec<_> = minor.iter().filter_map(|pair| Beside::of(&photographs, pair)).collect();
    let maxima = most_evident(maxima, TRIED, |one| one.ln_evidence);
    trace.extend(maxima.iter().map(|one| one.trace.clone()));
    let best = maxima.first().ok_or_else(not_finite)?;
    let of_scene = photographs.iter().zip(&best.seen).map(|(photograph, seen)| {
        let Photograph { parts, .. } = photograph;
        let mut found = findings(&seen.fitted, &parts.told);
        let imperfection = best.hypothesis.imperfection;
        let whitening = photograph.whitening(imperfection.discrepancy).filter(|_| !imperfection.is_ideal());
        found.extend(whitening.into_iter().flat_map(|whitening| {
            let shifts = corners::shifts(&parts.places, &parts.values);
            let shifts: Vec<_> = shifts.iter().map(|shift| whitening.of(shift)).collect();
            corners::findings(&shifts, &seen.residuals, imperfection.scale * error.corner)
        }));
        (found, skipped(&seen.fitted, skipped_searches))
    });
    let of_scene: Vec<_> = of_scene.collect();
    let odds = odds(&maxima, &beside);
    let ln_evidence = best.ln_evidence + odds.iter().sum::<f64>().ln() - ln_all_shares(prior);
    let estimates = mean(maxima, &beside, &odds, &trace).ok_or_else(not_finite)?;
    let complete =
        |(estimate, (findings, skipped))| Estimate { findings, skipped, without_bounces, ..estimate };
    Ok(SheetEstimate {
        photographs: estimates.into_iter().zip(of_scene).map(complete).collect(),
        ln_evidence,
    })
}

/// Photographs with errors relative to the values that a model predicts, not to those that were measured.
fn relative_to_predictions<'a>(
    photographs: Vec<Photograph<'a>>,
    prior: &Prior,
) -> Option<Vec<Photograph<'a>>> {
    let model = JointModel::new(&photographs, *usual_hypotheses().first()?, prior.broad())?;
    let solution = search(&model, DVector::zeros(model.unknowns()), SORTING_TOLERANCE, SORTING_LIMIT);
    let predicted = model.members().iter().map(|member| member.model.values_at(&member.own(&solution.w)));
    let predicted: Vec<_> = predicted.collect();
    // a model that is far off predicts nothing
    let relative = |(one, predicted): (Photograph<'a>, DMatrix<f64>)| {
        let values = predicted.zip_map(&one.parts.values, |predicted, value| predicted.max(0.5 * value));
        one.relative_to(values)
    };
    Some(photographs.into_iter().zip(predicted).map(relative).collect())
}

impl Sorted {
    /// From `start` on; none if there is no maximum.
    fn of(
        photographs: &[Photograph],
        prior: &Prior,
        hypothesis: Hypothesis,
        start: Option<&Self>,
    ) -> Option<Self> {
        let model = JointModel::new(photographs, hypothesis, prior.broad())?;
        let start = start.map_or_else(|| DVector::zeros(model.unknowns()), |one| one.solution.w.clone());
        let solution = search(&model, start, SORTING_TOLERANCE, SORTING_LIMIT);
        let ln_evidence = solution.ln_evidence(1.0)? + model.ln_whitening();
        let ln_share = hypothesis.ln_share();
        ln_evidence.is_finite().then_some(Self { hypothesis, ln_share, ln_evidence, solution })
    }

    fn ln_weight(&self) -> f64 {
        self.ln_share + self.ln_evidence
    }

    fn is_ideal(&self) -> bool {
        self.hypothesis.imperfection.is_ideal()
    }

    /// Whether another hypothesis is this one with less unknown.
    fn has_case(&self, other: &Hypothesis) -> bool {
        let own = &self.hypothesis;
        own.kind == other.kind && other.imperfection.is_case_of(&own.imperfection)
    }
}

/// Hypotheses of evidence under all spectra, most evidence first; each from where another led. None is tried that is a case of one of next to no
/// evidence.
fn sorted(photographs: &[Photograph], prior: &Prior, hypotheses: Vec<Hypothesis>) -> Vec<Sorted> {
    let mut all: Vec<Sorted> = Vec::new();
    for hypothesis in hypotheses {
        let most = all.iter().map(|one| one.ln_evidence).fold(f64::NEG_INFINITY, f64::max);
        let wider = all.iter().rev().find(|one| one.has_case(&hypothesis));
        if wider.is_none_or(|one| one.ln_evidence >= most + LN_EVIDENCE_HOPELESS) {
            all.extend(Sorted::of(photographs, prior, hypothesis, wider.or(all.last())));
        }
    }
    weigh_against_ideal(photographs, prior, &mut all);
    most_evident(all, usize::MAX, Sorted::ln_weight)
}

/// Weighs real sheets against ideal folds of some evidence with as much left unexplained as has more evidence: of a picture taken with care the
/// usual discrepancy says too little to tell them apart. The estimates under them keep it, as residuals show only what unknowns do not take up.
fn weigh_against_ideal(photographs: &[Photograph], prior: &Prior, all: &mut [Sorted]) {
    let best = |is_ideal: bool| {
        let of = all.iter().filter(|one| one.is_ideal() == is_ideal);
        of.max_by(|a, b| a.ln_weight().total_cmp(&b.ln_weight()))
    };
    let (Some(ideal), Some(real)) = (best(true), best(false)) else { return };
    if ideal.ln_weight() < real.ln_weight() + LN_EVIDENCE_LEAST {
        return;
    }
    let less = real.hypothesis.imperfection.with_less_discrepancy().into_iter().filter_map(|imperfection| {
        Sorted::of(photographs, prior, Hypothesis { imperfection, ..real.hypothesis }, Some(real))
    });
    let more = less.map(|one| one.ln_evidence - real.ln_evidence).fold(0.0, f64::max);
    all.iter_mut().filter(|one| !one.is_ideal()).for_each(|one| one.ln_share += more);
}

/// Probability that no light bounces between the panels, which then are no fold.
fn without_bounces(photographs: &[Photograph], prior: &Prior, folds: &[Sorted]) -> f64 {
    let Some(first) = folds.first() else { return 0.0 };
    let weight = |one: &Sorted| (one.ln_weight() - first.ln_weight()).exp();
    let of_folds: f64 = folds.iter().map(weight).sum();
    let without = hypotheses_without_bounces()
        .filter_map(|hypothesis| Sorted::of(photographs, prior, hypothesis, Some(first)));
    let without: f64 = without.map(|one| weight(&one)).sum();
    if without.is_infinite() { 1.0 } else { without / (without + of_folds) }
}

/// What the facets do not speak of.
fn skipped(fitted: &[Fitted], searches: usize) -> Vec<Skipped> {
    let untold = fitted.iter().filter(|one| !one.supported).count();
    let all = [
        ("searches under a kind of sheets and a class of spectra", searches, "the evidence is against them"),
        ("unknowns of the scene", untold, "the facets do not tell them: they stay at what is usual"),
    ];
    let of = |(what, count, why)| Skipped { what, count, why };
    all.map(of).into_iter().filter(|one| one.count > 0).collect()
}

fn search(model: &JointModel, start: DVector<f64>, tolerance: f64, limit: usize) -> Solution<()> {
    let first = first_inflation(model, &start, 1.0);
    maximise(model, start, (first, 1.0), tolerance, limit)
}

/// Those of most evidence, most first.
fn most_evident<T>(mut all: Vec<T>, count: usize, ln_evidence: impl Fn(&T) -> f64) -> Vec<T> {
    all.retain(|one| ln_evidence(one).is_finite());
    all.sort_by(|a, b| ln_evidence(b).total_cmp(&ln_evidence(a)));
    all.truncate(count);
    let least = all.first().map_or(0.0, |first| ln_evidence(first) + LN_EVIDENCE_LEAST);
    all.retain(|one| ln_evidence(one) >= least);
    all
}

impl Maximum {
    fn of(model: &JointModel, found: &Solution<()>, ln_share: f64) -> Option<Self> {
        let ln_evidence = ln_share + found.ln_evidence(1.0)? + model.ln_whitening();
        // spectrum and sheet are the same in all photographs
        let first = model.members().first()?;
        let w = first.own(&found.w);
        let point = first.model.point(&w);
        let reflectance = reflectance(&point);
        let lower = information(&found.at.jacobian)?.l();
        let widened = rms(&found.at.residuals).max(1.0);
        let slopes = slopes(first, model.unknowns(), &w, &point);
        let of_facets = widened * lower.solve_lower_triangular(&slopes.transpose())?;
        let spread = match first.model.instrument_errors(&point.albedo) {
            Some(errors) => {
                DMatrix::from_rows(&of_facets.row_iter().chain(errors.row_iter()).collect::<Vec<_>>())
            }
            None => of_facets,
        };
        let own = lower.solve_lower_triangular(&DMatrix::identity(found.w.len(), found.w.len()))?;
        let sd = |place: usize| widened * own.column(place).norm();
        let seen = model.members().iter().zip(model.each(&found.at.residuals)).map(|(member, residuals)| {
            let w = member.own(&found.w);
            let exposure = member.model.point(&w).exposure;
            let [scene, ..] = member.model.layout();
            let numbers = member.model.scene_unknowns().iter().zip(scene..);
            let fitted = numbers.filter(|(number, _)| number.matters()).map(|(number, n)| {
                let (value, slope) = number.at(w[n]);
                let value = if number.unknown == &EXPOSURE { exposure } else { value };
                let sd = sd(member.place(n));
                Fitted { unknown: number.unknown, value, sd: sd * slope.abs(), supported: sd < SUPPORTED }
            });
            let values = member.model.values().norm().max(f64::MIN_POSITIVE);
            Seen {
                exposure,
                fitted: fitted.collect(),
                residuals,
                unexplained: member.model.left_over(&w).norm() / values,
            }
        });
        Some(Self {
            hypothesis: first.model.hypothesis(),
            ln_evidence,
            seen: seen.collect(),
            albedo: point.albedo,
            reflectance,
            spread,
            trace: found.trace.clone(),
            termination: found.termination,
        })
    }
}

impl Beside {
    /// Where the linear model has the maximum; the evidence is less than at the true one, by what that model is off.
    fn of(photographs: &[Photograph], pair: &Likely) -> Option<Self> {
        let gaussian = pair.class.gaussian().scaled(pair.scale);
        let model = JointModel::new(photographs, pair.hypothesis, &gaussian)?;
        let LinearMaximum { w, cost } = pair.about.maximum(&gaussian)?;
        let off = model.residuals(&w).norm_squared() + w.norm_squared() - cost;
        let first = model.members().first()?;
        let point = first.model.point(&first.own(&w));
        let ln_evidence = pair.ln_evidence - 0.5 * off;
        let reflectance = reflectance(&point);
        let albedo = point.albedo;
        ln_evidence.is_finite().then_some(Self { ln_evidence, albedo, reflectance })
    }
}

/// Derivatives of the reflectance in every waveband by all `unknowns` of photographs of a sheet, the numbers of the `first` being `w`.
fn slopes(first: &Member, unknowns: usize, w: &DVector<f64>, point: &Point) -> DMatrix<f64> {
    let [scene, sheet, camera, _] = first.model.layout();
    let basis = first.model.gaussian().basis();
    let mut slopes = DMatrix::zeros(point.albedo.len(), unknowns);
    for (band, albedo) in point.albedo.iter().enumerate() {
        let change = point.departure.reflectance[0] * albedo * (1.0 - albedo);
        for n in 0..scene {
            slopes[(band, first.place(n))] = change * basis[(band, n)];
        }
    }
    let numbers = first.model.scene_unknowns().iter().zip(scene..);
    let of_sheet = numbers.filter(|(number, _)| number.unknown.is_of_sheet()).map(|(_, n)| n);
    for n in of_sheet.chain(sheet..camera) {
        let mut beside = w.clone();
        beside[n] += STEP;
        let moved = first.model.point(&beside).departure.reflectance;
        let [slope, offset] = [0, 1].map(|k| (moved[k] - point.departure.reflectance[k]) / STEP);
        for (band, albedo) in point.albedo.iter().enumerate() {
            slopes[(band, first.place(n))] = slope * albedo + offset;
        }
    }
    slopes
}

fn rms(residuals: &DVector<f64>) -> f64 {
    (residuals.norm_squared() / residuals.len() as f64).sqrt()
}

/// 45:0 reflectance.
fn reflectance(point: &Point) -> DVector<f64> {
    let [slope, offset] = point.departure.reflectance;
    let of = |albedo: &f64| (slope * albedo + offset).clamp(0.0, 1.0);
    DVector::from_iterator(point.albedo.len(), point.albedo.iter().map(of))
}

/// Of all maxima, then of what is beside them, against the first. What was not searched counts for no more than the best that was.
fn odds(maxima: &[Maximum], beside: &[Beside]) -> Vec<f64> {
    let most = maxima.first().map_or(0.0, |one| one.ln_evidence);
    let all = maxima.iter().map(|one| one.ln_evidence).chain(beside.iter().map(|one| one.ln_evidence));
    all.map(|ln_evidence| (ln_evidence - most).min(0.0).exp()).collect()
}

/// The mean of all maxima and what is beside them by their `odds`, what they do not agree on as an error; one estimate for each photograph.
/// What is beside is taken to be known as the maxima are in the mean.
fn mean(
    maxima: Vec<Maximum>,
    beside: &[Beside],
    odds: &[f64],
    trace: &[Vec<Iteration>],
) -> Option<Vec<Estimate>> {
    let bands = maxima.first()?.reflectance.len();
    let total: f64 = odds.iter().sum();
    let of_maxima: f64 = odds[..maxima.len()].iter().sum();
    let searched = maxima.iter().map(|one| (&one.albedo, &one.reflectance));
    let all = searched.chain(beside.iter().map(|one| (&one.albedo, &one.reflectance)));
    let all = || all.clone().zip(odds.iter().map(|odds| odds / total));
    let reflectance: DVector<f64> = all().map(|((_, reflectance), share)| share * reflectance).sum();
    let mut albedo = vec![0.0; bands];
    let mut rows = Vec::new();
    for (one, odds) in maxima.iter().zip(odds) {
        rows.extend(one.spread.row_iter().map(|row| (odds / of_maxima).sqrt() * row));
    }
    for ((its_albedo, its_reflectance), share) in all() {
        albedo.iter_mut().zip(its_albedo).for_each(|(sum, albedo)| *sum += share * albedo);
        rows.push(share.sqrt() * (its_reflectance - &reflectance).transpose());
    }
    let best = maxima.into_iter().next()?;
    let is_ideal = best.hypothesis.imperfection.is_ideal();
    let spread = DMatrix::from_rows(&rows);
    // shares may add up to a rounding more than 1
    let within = |values: &[f64]| values.iter().map(|value| value.min(1.0)).collect::<Vec<_>>();
    let of = |seen: Seen| Estimate {
        total: (!is_ideal).then(|| within(&albedo)),
        reflectance: within(reflectance.as_slice()),
        spread: Some(spread.clone()),
        exposure: seen.exposure,
        fitted: seen.fitted,
        findings: Vec::new(),
        skipped: Vec::new(),
        residual_rms: rms(&seen.residuals),
        unexplained: seen.unexplained,
        without_bounces: 0.0,
        iterations: trace.iter().map(|run| run.len() as u32).sum(),
        trace: trace.to_vec(),
        termination: best.termination,
    };
    Some(best.seen.into_iter().map(of).collect())
}
