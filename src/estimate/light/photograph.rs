//! A photograph in an unstated light: usually daylight of any day and temperature, else one of the other
//! candidates.
//!
//! Under one sheet model and all spectra as one Gaussian, each light started from the result of its
//! neighbour, most lights are soon ruled out. Each remaining one is estimated as if it had been stated, and
//! the estimate is their mean, weighted by evidence.

use std::{iter, slice};

use nalgebra::{DMatrix, DVector, RowDVector};

use super::{Candidate, InferredLight, Weighed};
use crate::error::{Error, Result};
use crate::estimate::Estimate;
use crate::estimate::photograph::conditions::Daylight;
use crate::estimate::photograph::day::Day;
use crate::estimate::photograph::hypotheses::Hypothesis;
use crate::estimate::photograph::sheet_models::SheetModel;
use crate::estimate::photograph::{
    self, KnownReflectance, KnownSeen, Parts, Photographs, SheetEstimate, ShownDaylight, shown_daylight,
};
use crate::estimate::prior::Prior;
use crate::estimate::search::Search;

/// Lights whose log evidence is this far below the best are dropped, and at most this many are estimated in
/// addition to daylight, the usual light of photographs: including the survey of all lights, that takes less
/// time than four estimates.
const LN_EVIDENCE_LEAST: f64 = -6.0;
const TRIED: usize = 2;
/// Lights whose log evidence from a known sheet is this far below the best are dropped for all other sheets.
pub(super) const LN_HOPELESS: f64 = -20.0;

/// Probability that daylight comes without a sky and the ground below it: from a flash, with a colour
/// temperature in [`WITHOUT_SKY_K`], or through a small window.
pub(super) const WITHOUT_SKY: f64 = 0.1;
const WITHOUT_SKY_K: std::ops::RangeInclusive<f64> = 5000.0..=7700.0;

/// A light, and the photograph in it.
struct Scenario<'a> {
    /// The candidate; `None` for daylight of any kind.
    light: Option<&'a Candidate>,
    ln_share: f64,
    parts: Parts,
}

/// What a photograph of a known sheet reveals about its possible lights.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownScenarios {
    /// Log evidence in each of them.
    ln_evidence: Vec<f64>,
    /// Daylight.
    daylight: Option<ShownDaylight>,
    /// Deviation of its facets from the model in the best light, relative to the expected error.
    pub rms: f64,
}

impl ShownScenarios {
    /// From a photograph of a known sheet, with its `parts` in unstated daylight.
    ///
    /// # Errors
    /// [`Error::Numeric`] if the facets are not finite.
    pub fn of(parts: &Parts, lights: &[Candidate], known: &KnownReflectance, prior: &Prior) -> Result<Self> {
        let scenarios = scenarios(parts, lights);
        let photographs = Photographs::of(slice::from_ref(parts));
        let (mut best, mut start, mut rms, mut daylight) = (f64::NEG_INFINITY, None, f64::INFINITY, None);
        let mut ln_evidence = Vec::with_capacity(scenarios.len());
        for scenario in &scenarios {
            let days = scenario.known(&photographs, known, prior, &mut start, best + LN_HOPELESS);
            let ln_all = ln_of_days(&days);
            best = best.max(ln_all);
            rms = days.iter().map(|(.., seen)| seen.rms).fold(rms, f64::min);
            if scenario.light.is_none() {
                daylight = shown_daylight(&days);
            }
            ln_evidence.push(ln_all);
        }
        if !best.is_finite() {
            return Err(Error::Numeric("the facets of the known fold are not finite".to_owned()));
        }
        ln_evidence.iter_mut().for_each(|ln| *ln -= best);
        Ok(Self { ln_evidence, daylight, rms })
    }

    /// Drops scenarios that it rules out, and updates the probabilities of the others.
    fn enter(&self, scenarios: &mut Vec<Scenario>) {
        for (scenario, ln_evidence) in iter::zip(scenarios.iter_mut(), &self.ln_evidence) {
            scenario.ln_share += ln_evidence;
            if scenario.light.is_none() {
                scenario.parts.stated.shown = self.daylight;
            }
        }
        let most = scenarios.iter().map(|scenario| scenario.ln_share).fold(f64::NEG_INFINITY, f64::max);
        scenarios.retain(|scenario| scenario.ln_share >= most + LN_HOPELESS);
    }
}

/// What a photograph of a known sheet reveals about its daylight; `None` for a lamp.
#[must_use]
pub fn daylight_of_known(parts: &Parts, known: &KnownReflectance, prior: &Prior) -> Option<ShownDaylight> {
    parts.stated.daylight?;
    let photographs = Photographs::of(slice::from_ref(parts));
    let scenario = Scenario { light: None, ln_share: 0.0, parts: parts.clone() };
    shown_daylight(&scenario.known(&photographs, known, prior, &mut None, f64::NEG_INFINITY))
}

/// Log evidence summed over the kinds of day, weighted by their probabilities.
fn ln_of_days(days: &[(Day, f64, KnownSeen)]) -> f64 {
    let most = days.iter().map(|(.., seen)| seen.ln_evidence).fold(f64::NEG_INFINITY, f64::max);
    let weight = |(_, share, seen): &(Day, f64, KnownSeen)| share * (seen.ln_evidence - most).exp();
    if days.is_empty() { most } else { most + days.iter().map(weight).sum::<f64>().ln() }
}

/// The posterior mean reflectance, and the light, for a photograph in one of `lights`; its `parts` are those
/// in unstated daylight.
///
/// # Errors
/// [`Error::Numeric`] if the facets are not finite.
pub fn estimate_photograph(
    parts: &Parts,
    lights: &[Candidate],
    shown: Option<&ShownScenarios>,
    prior: &Prior,
) -> Result<Estimate> {
    let mut scenarios = scenarios(parts, lights);
    if let Some(shown) = shown {
        shown.enter(&mut scenarios);
    }
    let mut tried = Vec::new();
    let daylight = scenarios.iter().filter(|scenario| scenario.light.is_none());
    for scenario in daylight.chain(probable(&scenarios, prior).into_iter().take(TRIED)) {
        let SheetEstimate { photographs, ln_evidence, .. } =
            photograph::estimate(slice::from_ref(&scenario.parts), prior)?;
        tried.extend(
            photographs.into_iter().map(|estimate| (scenario, scenario.ln_share + ln_evidence, estimate)),
        );
    }
    let most = tried.iter().map(|(_, ln_weight, _)| *ln_weight).fold(f64::NEG_INFINITY, f64::max);
    let odds: Vec<f64> = tried.iter().map(|(_, ln_weight, _)| (ln_weight - most).exp()).collect();
    let sum: f64 = odds.iter().sum();
    let all: Vec<_> = iter::zip(tried, odds)
        .map(|((scenario, _, estimate), odds)| (scenario, odds / sum, estimate))
        .collect();
    let found: Vec<_> =
        all.iter().map(|(scenario, share, estimate)| scenario.found(*share, estimate)).collect();
    let light = InferredLight::of(found.iter().map(|(light, power)| (light.clone(), power.as_slice())));
    let mean = mean(all.into_iter().map(|(_, share, estimate)| (share, estimate)).collect());
    mean.map(|estimate| Estimate { light: Some(light), ..estimate })
        .ok_or_else(|| Error::Numeric("the facets of the photograph are not finite".to_owned()))
}

/// All daylight under a sky as one scenario, and each daylight without a sky and each other light as one.
fn scenarios<'a>(parts: &Parts, lights: &'a [Candidate]) -> Vec<Scenario<'a>> {
    // errors of a photograph hide what is between
    let lights: Vec<&Candidate> = lights.iter().filter(|light| !light.is_between).collect();
    let of_daylight: f64 =
        lights.iter().filter(|light| light.is_any_daylight).map(|light| light.ln_share.exp()).sum();
    let of_sky = (1.0 - WITHOUT_SKY) * of_daylight;
    let daylight =
        (of_daylight > 0.0).then(|| Scenario { light: None, ln_share: of_sky.ln(), parts: parts.clone() });
    let others = lights.iter().copied().filter(|light| !light.is_any_daylight);
    // for lamps one hypothesis represents all days, with the probability of a clear one
    let ln_clear = parts.stated.share_of(Day::Clear).ln();
    let of = |light: &'a Candidate| {
        let parts = parts.in_light(&light.power);
        let ln_days = if parts.stated.daylight.is_some() { 0.0 } else { ln_clear };
        Scenario { light: Some(light), ln_share: light.ln_share - ln_days, parts }
    };
    let flashes: Vec<&Candidate> = lights.iter().copied().filter(|light| is_of_flash(light)).collect();
    let ln_flash = (WITHOUT_SKY * of_daylight / flashes.len() as f64).ln() - ln_clear;
    let of_flash = |light: &'a Candidate| Scenario {
        light: Some(light),
        ln_share: ln_flash,
        parts: parts.in_light(&light.power).without_sky(),
    };
    daylight.into_iter().chain(flashes.into_iter().map(of_flash)).chain(others.map(of)).collect()
}

/// True for daylight that may come without a sky.
pub(super) fn is_of_flash(light: &Candidate) -> bool {
    light.is_any_daylight && light.cct_k.is_some_and(|cct_k| WITHOUT_SKY_K.contains(&cct_k))
}

/// Scenarios other than daylight under a sky that remain possible, the most probable first.
fn probable<'w, 'a>(scenarios: &'w [Scenario<'a>], prior: &Prior) -> Vec<&'w Scenario<'a>> {
    let Some(first) = scenarios.first() else { return Vec::new() };
    let photographs = Photographs::of(slice::from_ref(&first.parts));
    let mut all: Vec<(&Scenario, f64)> = Vec::new();
    let mut start: Option<DVector<f64>> = None;
    let mut best = f64::NEG_INFINITY;
    for scenario in scenarios {
        let family = photographs.in_light_of(&scenario.parts);
        let mut search = Search::new(&family, prior);
        for day in scenario.days() {
            let hypothesis = Hypothesis::on_dull_day(*day, SheetModel::Family);
            let ln_share = scenario.ln_share + scenario.parts.stated.share_of(*day).ln();
            // lights of another kind have different unknowns
            let from = start.clone().filter(|w| Some(w.len()) == family.unknowns(hypothesis, prior));
            let Some(one) = search.sort((hypothesis, ln_share), from, best + 2.0 * LN_EVIDENCE_LEAST) else {
                continue;
            };
            best = best.max(one.ln_weight());
            all.push((scenario, one.ln_weight()));
            start = Some(one.solution.w);
        }
    }
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut kept: Vec<&Scenario> = Vec::new();
    let near =
        all.into_iter().filter(|(scenario, ln)| scenario.light.is_some() && *ln >= best + LN_EVIDENCE_LEAST);
    for (scenario, _) in near {
        // a daylight is listed once for each kind of day
        if !kept.iter().any(|other| std::ptr::eq(*other, scenario)) {
            kept.push(scenario);
        }
    }
    kept
}

impl Scenario<'_> {
    /// A photograph of a known sheet in this light, for each possible kind of day, with its probability.
    fn known(
        &self,
        photographs: &Photographs,
        known: &KnownReflectance,
        prior: &Prior,
        start: &mut Option<DVector<f64>>,
        mut ln_least: f64,
    ) -> Vec<(Day, f64, KnownSeen)> {
        let family = photographs.in_light_of(&self.parts);
        let share = |day: Day| self.parts.stated.share_of(day);
        let of_all: f64 = self.days().iter().map(|day| share(*day)).sum();
        let mut all = Vec::new();
        for day in self.days() {
            if let Some(seen) = family.known(*day, prior, known, start.as_ref(), ln_least) {
                *start = Some(seen.w.clone());
                ln_least = ln_least.max(seen.ln_evidence + LN_HOPELESS);
                all.push((*day, share(*day) / of_all, seen));
            }
        }
        all
    }

    /// Possible kinds of day; indoors they make no difference.
    fn days(&self) -> &'static [Day] {
        if self.parts.stated.daylight.is_some() { &Day::ALL } else { &[Day::Clear] }
    }

    /// The light with this probability, and its power; for daylight, as inferred from the photograph.
    fn found(&self, probability: f64, estimate: &Estimate) -> (Weighed, Vec<f64>) {
        if let Some(light) = self.light {
            return (light.weighed(probability), light.power.clone());
        }
        let has_sun = estimate.day.is_none_or(|found| found.day.has_sun());
        let name = if has_sun { "sun_cct_k" } else { "sky_cct_k" };
        let cct_k = estimate.fitted.iter().find(|one| one.unknown.name == name).map(|one| one.value.round());
        let mired = cct_k.map_or(self.parts.stated.priors.sun_mired, |cct_k| 1e6 / cct_k);
        let name = cct_k.map_or_else(|| "daylight".to_owned(), |cct_k| format!("daylight:{cct_k}"));
        let power = Daylight::power(&self.parts.eye.daylight, mired);
        (Weighed { name, cct_k, probability }, power.as_slice().to_vec())
    }
}

/// The mean of estimates, weighted by probability, with errors widened by their distances from it; everything
/// else is taken from the most probable one.
fn mean(mut all: Vec<(f64, Estimate)>) -> Option<Estimate> {
    all.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let weighted = |of: &dyn Fn(&Estimate) -> Option<DVector<f64>>| {
        let each: Option<Vec<_>> =
            all.iter().map(|(share, one)| of(one).map(|values| *share * values)).collect();
        each?.into_iter().reduce(|sum, one| sum + one)
    };
    let reflectance = weighted(&|one| Some(DVector::from_column_slice(&one.reflectance)))?;
    let total = weighted(&|one| one.albedo.as_deref().map(DVector::from_column_slice));
    let rows = |(share, one): &(f64, Estimate)| {
        let apart = RowDVector::from_row_slice(&one.reflectance) - reflectance.transpose();
        let within = one.spread.as_ref()?.row_iter().map(nalgebra::Matrix::into_owned);
        Some(within.chain([apart]).map(|row| share.sqrt() * row).collect::<Vec<_>>())
    };
    let spread: Option<Vec<_>> = all.iter().map(rows).collect();
    let spread = spread.map(|rows| DMatrix::from_rows(&rows.concat()));
    let without_bounces = all.iter().map(|(share, one)| share * one.without_bounces).sum();
    let (_, best) = all.into_iter().next()?;
    let within = |values: DVector<f64>| values.iter().map(|value| value.min(1.0)).collect::<Vec<_>>();
    Some(Estimate {
        reflectance: within(reflectance),
        albedo: total.map(within).filter(|_| best.albedo.is_some()),
        spread,
        without_bounces,
        ..best
    })
}
