//! The most probable spectrum under all kinds of sheets and all classes of spectra.
//!
//! Every kind of sheet is tried under all spectra as one Gaussian; those of evidence are tried again under the classes that the
//! model, linearised there, leaves possible. What is reported is the mean over all of these, weighed by their evidence, and the error
//! bars hold how far they are apart.

use std::rc::Rc;

use nalgebra::{Cholesky, DMatrix, DVector};

use super::corners;
use super::error::ModelError;
use super::findings::findings;
use super::joint::{JointModel, Member, Photograph};
use super::kinds::Kind;
use super::model::Point;
use super::parts::Parts;
use crate::error::{Error, Result};
use crate::estimate::gaussian::Gaussian;
use crate::estimate::prior::{Class, Prior};
use crate::estimate::starts::SCALES;
use crate::estimate::unknowns::EXPOSURE;
use crate::estimate::{Estimate, Fitted};
use crate::kernel::skipped::Skipped;
use crate::solve::posterior::{Iteration, Model, Solution, first_inflation, maximise};
use crate::solve::{Eigen, Termination};

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
/// Power of the shares that classes have of all spectra: people fold paper and cloth more often than painted chips, of which most is known.
const SHARE_POWER: f64 = 0.25;
/// A number is told by the facets if its standard deviation is below that share of what it was before.
const SUPPORTED: f64 = 0.8;
/// Information on a direction of logits that tells no classes apart, each of which knows a hundred times more of it.
const NEGLIGIBLE: f64 = 1e-3;
/// Standard deviation of logits in which a Gaussian has a spectrum only nearly.
const NEARLY: f64 = 0.1;
/// Step of difference quotients, in standard deviations.
const STEP: f64 = 1e-3;

/// A maximum.
struct Maximum {
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
    let not_finite = || Error::Numeric("the facets of the photograph are not finite".to_owned());
    let photographs = Photograph::all(parts, error).ok_or_else(not_finite)?;
    // each kind from where the one before it led, which is near
    let mut start = None;
    let sorted = Kind::ALL.into_iter().filter_map(|kind| {
        let model = JointModel::new(&photographs, kind, prior.broad());
        let from = start.take().unwrap_or_else(|| DVector::zeros(model.unknowns()));
        let solution = search(&model, from, SORTING_TOLERANCE, SORTING_LIMIT);
        start = Some(solution.w.clone());
        let ln_evidence = solution.ln_evidence(1.0)?;
        ln_evidence.is_finite().then_some((ln_evidence, kind, solution))
    });
    let sorted = most_evident(sorted.collect(), Kind::ALL.len(), |one| one.0);
    let mut trace: Vec<Vec<Iteration>> = sorted.iter().map(|one| one.2.trace.clone()).collect();
    let likely: Result<Vec<_>> = sorted
        .iter()
        .map(|(ln_evidence, kind, solution)| {
            let about = About::new(prior.broad(), solution).ok_or_else(not_finite)?;
            about.classes(*kind, prior, *ln_evidence).ok_or_else(not_finite)
        })
        .collect();
    let likely: Vec<Likely> = likely?.into_iter().flatten().collect();
    let searches = likely.len();
    let likely = most_evident(likely, TRIED, |one| one.ln_evidence);
    let skipped_searches = searches - likely.len();
    let mut maxima = Vec::new();
    for Likely { kind, class, scale, ln_share, about, .. } in likely {
        let gaussian = class.gaussian.scaled(scale);
        let model = JointModel::new(&photographs, kind, &gaussian);
        let start = about.start(&model, &gaussian).ok_or_else(not_finite)?;
        let found = search(&model, start, TOLERANCE, LIMIT);
        maxima.extend(Maximum::of(&model, &found, ln_share));
    }
    let maxima = most_evident(maxima, TRIED, |one| one.ln_evidence);
    trace.extend(maxima.iter().map(|one| one.trace.clone()));
    let best = maxima.first().ok_or_else(not_finite)?;
    let of_scene = photographs.iter().zip(&best.seen).map(|(photograph, seen)| {
        let Photograph { parts, whitening, .. } = photograph;
        let shifts: Vec<_> =
            corners::shifts(&parts.places, &parts.values).iter().map(|shift| whitening.of(shift)).collect();
        let mut found = findings(&seen.fitted, &parts.told);
        found.extend(corners::findings(&shifts, &seen.residuals, error.corner));
        (found, skipped(&seen.fitted, skipped_searches))
    });
    let of_scene: Vec<_> = of_scene.collect();
    let ln_evidence = best.ln_evidence
        + maxima.iter().map(|one| (one.ln_evidence - best.ln_evidence).exp()).sum::<f64>().ln()
        - ln_all_shares(prior);
    let estimates = mean(maxima, &trace).ok_or_else(not_finite)?;
    let complete = |(estimate, (findings, skipped))| Estimate { findings, skipped, ..estimate };
    Ok(SheetEstimate {
        photographs: estimates.into_iter().zip(of_scene).map(complete).collect(),
        ln_evidence,
    })
}

/// Logarithm of the sum of what pairs of a kind and a class are weighed with.
fn ln_all_shares(prior: &Prior) -> f64 {
    let classes: f64 = prior.classes().iter().map(|class| (SHARE_POWER * class.ln_share).exp()).sum();
    let scales: f64 = SCALES.iter().map(|(_, share)| share).sum();
    (Kind::ALL.len() as f64 * classes * scales).ln()
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

/// A kind of sheets and a class of spectra at one of its widths, and where they are judged from.
struct Likely<'a> {
    kind: Kind,
    about: Rc<About>,
    class: &'a Class,
    scale: f64,
    ln_share: f64,
    ln_evidence: f64,
}

/// The model, taken to be linear about a maximum under all spectra.
struct About {
    /// Logits of the albedo there, and the numbers that are not of the spectrum.
    logit: DVector<f64>,
    others: DVector<f64>,
    /// Derivatives by logit, as far as the coordinates of all spectra tell them, and by the others.
    by_logit: DMatrix<f64>,
    by_others: DMatrix<f64>,
    residuals: DVector<f64>,
    /// What the facets tell of logits whatever the others are, as few values of standard deviation 1: value by waveband, and how far the
    /// values are off at the maximum.
    told: DMatrix<f64>,
    off: DVector<f64>,
}

impl About {
    fn new(broad: &Gaussian, solution: &Solution<()>) -> Option<Self> {
        let scene = broad.basis().ncols();
        let count = solution.w.len() - scene;
        let coordinates_of = broad.basis().clone().pseudo_inverse(1e-9).ok()?;
        let logit = broad.logit_at(&solution.w.rows(0, scene).into_owned());
        let others = solution.w.rows(scene, count).into_owned();
        let by_logit = solution.at.jacobian.columns(0, scene) * coordinates_of;
        let by_others = solution.at.jacobian.columns(scene, count).into_owned();
        let residuals = solution.at.residuals.clone();
        let mut information = by_others.transpose() * &by_others;
        (0..count).for_each(|n| information[(n, n)] += 1.0);
        let both = by_others.transpose() * &by_logit;
        let left = Cholesky::new(information)?.solve(&both);
        let at_prior = &residuals + &by_others * &others;
        let told = by_logit.transpose() * &by_logit - both.transpose() * &left;
        let off = by_logit.tr_mul(&at_prior) - left.tr_mul(&by_others.tr_mul(&at_prior));
        let Eigen { values, vectors } = Eigen::of_symmetric(told);
        let kept: Vec<usize> = (0..values.len()).filter(|n| values[*n] > NEGLIGIBLE).collect();
        let row = |n: &usize| values[*n].sqrt() * vectors.column(*n).transpose();
        Some(Self {
            told: DMatrix::from_rows(&kept.iter().map(row).collect::<Vec<_>>()),
            off: DVector::from_iterator(
                kept.len(),
                kept.iter().map(|n| vectors.column(*n).dot(&off) / values[*n].sqrt()),
            ),
            logit,
            others,
            by_logit,
            by_others,
            residuals,
        })
    }

    /// All classes of spectra at all widths, `ln_evidence` being that for all spectra as one Gaussian.
    fn classes<'a>(self, kind: Kind, prior: &'a Prior, ln_evidence: f64) -> Option<Vec<Likely<'a>>> {
        let about = Rc::new(self);
        let of_all = about.ln_evidence(prior.broad(), 1.0)?;
        let pairs =
            prior.classes().iter().flat_map(|class| SCALES.map(|(scale, share)| (class, scale, share)));
        let likely = |(class, scale, share): (&'a Class, f64, f64)| {
            let ln_share = SHARE_POWER * class.ln_share + share.ln();
            let ln_evidence = ln_evidence + ln_share + about.ln_evidence(&class.gaussian, scale)? - of_all;
            Some(Likely { kind, class, scale, ln_share, ln_evidence, about: Rc::clone(&about) })
        };
        Some(pairs.filter_map(likely).collect())
    }

    /// The evidence for spectra that are `scale` times as wide as a Gaussian, but for a term that all spectra share.
    fn ln_evidence(&self, spectra: &Gaussian, scale: f64) -> Option<f64> {
        let spread = scale * &self.told * spectra.basis();
        let mut covariance = &spread * spread.transpose();
        (0..covariance.nrows()).for_each(|n| covariance[(n, n)] += 1.0);
        let off = &self.off + &self.told * (&self.logit - spectra.mean());
        let factor = Cholesky::new(covariance)?;
        let cost = factor.l_dirty().solve_lower_triangular(&off)?.norm_squared();
        Some(-0.5 * (cost + factor.ln_determinant()))
    }

    /// Where to set out for the maximum under a Gaussian of spectra: where the linear model has it or, if that is further off, here.
    fn start(&self, model: &JointModel, own: &Gaussian) -> Option<DVector<f64>> {
        let cost = |w: &DVector<f64>| model.residuals(w).norm_squared() + w.norm_squared();
        let (maximum, here) = (self.maximum(own)?, self.in_coordinates_of(own)?);
        Some(if cost(&here) < cost(&maximum) { here } else { maximum })
    }

    /// The maximum under all spectra in the coordinates of another Gaussian, as nearly as that has it.
    fn in_coordinates_of(&self, own: &Gaussian) -> Option<DVector<f64>> {
        let basis = own.basis();
        let mut information = basis.tr_mul(basis);
        (0..information.nrows()).for_each(|i| information[(i, i)] += NEARLY.powi(2));
        let spectrum = Cholesky::new(information)?.solve(&basis.tr_mul(&(&self.logit - own.mean())));
        let count = spectrum.len() + self.others.len();
        Some(DVector::from_iterator(count, spectrum.iter().chain(&self.others).copied()))
    }

    /// Where the maximum under a Gaussian of spectra is.
    fn maximum(&self, own: &Gaussian) -> Option<DVector<f64>> {
        let coordinates = own.basis().ncols();
        let mut jacobian = DMatrix::zeros(self.by_logit.nrows(), coordinates + self.others.len());
        jacobian.columns_mut(0, coordinates).gemm(1.0, &self.by_logit, own.basis(), 0.0);
        jacobian.columns_mut(coordinates, self.others.len()).copy_from(&self.by_others);
        let residuals =
            &self.residuals + &self.by_logit * (&self.logit - own.mean()) + &self.by_others * &self.others;
        let mut information = jacobian.transpose() * &jacobian;
        (0..information.nrows()).for_each(|i| information[(i, i)] += 1.0);
        Some(Cholesky::new(information)?.solve(&jacobian.tr_mul(&residuals)))
    }
}

impl Maximum {
    fn of(model: &JointModel, found: &Solution<()>, ln_share: f64) -> Option<Self> {
        let ln_evidence = ln_share + found.ln_evidence(1.0)?;
        // spectrum and sheet are the same in all photographs
        let first = model.members().first()?;
        let w = first.own(&found.w);
        let point = first.model.point(&w);
        let reflectance = reflectance(&point);
        let lower = found.information()?.l();
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
            let fitted = member.model.scene_unknowns().iter().zip(scene..).map(|(expected, n)| {
                let (value, slope) = expected.at(w[n]);
                let value = if expected.unknown == &EXPOSURE { exposure } else { value };
                let sd = sd(member.place(n));
                Fitted { unknown: expected.unknown, value, sd: sd * slope.abs(), supported: sd < SUPPORTED }
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
    let unknowns = first.model.scene_unknowns().iter().zip(scene..);
    let of_sheet = unknowns.filter(|(expected, _)| expected.unknown.is_of_sheet()).map(|(_, n)| n);
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

/// The mean of all maxima by their evidence, what they do not agree on as an error; one estimate for each photograph.
fn mean(maxima: Vec<Maximum>, trace: &[Vec<Iteration>]) -> Option<Vec<Estimate>> {
    let most = maxima.first()?.ln_evidence;
    let odds: Vec<f64> = maxima.iter().map(|one| (one.ln_evidence - most).exp()).collect();
    let total: f64 = odds.iter().sum();
    let shares = || odds.iter().map(|odds| odds / total);
    let reflectance: DVector<f64> =
        maxima.iter().zip(shares()).map(|(one, share)| share * &one.reflectance).sum();
    let bands = reflectance.len();
    let mut albedo = vec![0.0; bands];
    let mut rows = Vec::new();
    for (one, share) in maxima.iter().zip(shares()) {
        albedo.iter_mut().zip(&one.albedo).for_each(|(sum, albedo)| *sum += share * albedo);
        rows.extend(one.spread.row_iter().map(|row| share.sqrt() * row));
        rows.push(share.sqrt() * (&one.reflectance - &reflectance).transpose());
    }
    let best = maxima.into_iter().next()?;
    let spread = DMatrix::from_rows(&rows);
    // shares may add up to a rounding more than 1
    let within = |values: &[f64]| values.iter().map(|value| value.min(1.0)).collect::<Vec<_>>();
    let of = |seen: Seen| Estimate {
        total: Some(within(&albedo)),
        reflectance: within(reflectance.as_slice()),
        spread: Some(spread.clone()),
        exposure: seen.exposure,
        fitted: seen.fitted,
        findings: Vec::new(),
        skipped: Vec::new(),
        residual_rms: rms(&seen.residuals),
        unexplained: seen.unexplained,
        iterations: trace.iter().map(|run| run.len() as u32).sum(),
        trace: trace.to_vec(),
        termination: best.termination,
    };
    Some(best.seen.into_iter().map(of).collect())
}
