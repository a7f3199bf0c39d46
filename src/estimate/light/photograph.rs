//! A photograph in an unstated light: usually daylight of any day and temperature, else one of the other
//! candidates.
//!
//! Under one sheet model and all spectra as one Gaussian, each light started from the result of its
//! neighbour, most lights are soon ruled out. Each remaining one is estimated as if it had been stated, and
//! the estimate is their mean, weighted by evidence.

use std::{iter, slice};

use nalgebra::{DMatrix, DVector, RowDVector};

use super::known_photograph::ShownScenarios;
use super::scenario::{Scenario, Starts};
use super::{Candidate, InferredLight, Weighed};
use crate::error::{Error, Result};
use crate::estimate::Estimate;
use crate::estimate::photograph::conditions::Daylight;
use crate::estimate::photograph::{self, Parts, Photographs, SheetEstimate};
use crate::estimate::prior::Prior;

/// Lights whose log evidence is this far below the best are dropped, and at most this many are estimated in
/// addition to daylight, the usual light of photographs: including the survey of all lights, that takes less
/// time than four estimates.
const LN_EVIDENCE_LEAST: f64 = -6.0;
const TRIED: usize = 2;

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
    let mut scenarios = Scenario::all(parts, lights);
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

/// Scenarios other than daylight under a sky that remain possible, the most probable first.
fn probable<'w, 'a>(scenarios: &'w [Scenario<'a>], prior: &Prior) -> Vec<&'w Scenario<'a>> {
    let Some(first) = scenarios.first() else { return Vec::new() };
    let predicted = Photographs::of(slice::from_ref(&first.parts), prior);
    let Some((photographs, start)) = predicted else { return Vec::new() };
    let (mut all, mut starts, mut best) = (Vec::new(), Starts::default(), f64::NEG_INFINITY);
    starts.keep(&start);
    for scenario in scenarios {
        let ln_least = best + 2.0 * LN_EVIDENCE_LEAST;
        if let Some(tried) = scenario.best(&photographs, prior, (&mut starts, ln_least)) {
            best = best.max(tried.ln_weight());
            all.push((scenario, tried.ln_weight()));
        }
    }
    all.retain(|(scenario, ln_weight)| scenario.light.is_some() && *ln_weight >= best + LN_EVIDENCE_LEAST);
    all.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    all.into_iter().map(|(scenario, _)| scenario).collect()
}

impl Scenario<'_> {
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
    let weighted = |of: fn(&Estimate) -> &[f64]| {
        let each = all.iter().map(|(share, one)| *share * DVector::from_column_slice(of(one)));
        each.reduce(|sum, one| sum + one)
    };
    let reflectance = weighted(|one| &one.reflectance)?;
    // a Lambertian sheet reflects alike whatever the directions
    let albedo = weighted(|one| one.albedo.as_ref().unwrap_or(&one.reflectance))?;
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
        albedo: best.albedo.is_some().then(|| within(albedo)),
        spread,
        without_bounces,
        ..best
    })
}
