//! What a photograph of a known sheet reveals about its light.

use std::{iter, slice};

use nalgebra::DVector;

use super::Candidate;
use super::scenario::Scenario;
use crate::error::{Error, Result};
use crate::estimate::photograph::day::Day;
use crate::estimate::photograph::{
    KnownReflectance, KnownSeen, Parts, Photographs, ShownDaylight, shown_daylight,
};
use crate::estimate::prior::Prior;

/// Lights whose log evidence from a known sheet is this far below the best are dropped for all other sheets.
pub(super) const LN_HOPELESS: f64 = -20.0;

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
        let scenarios = Scenario::all(parts, lights);
        let not_finite = || Error::Numeric("the facets of the known fold are not finite".to_owned());
        let (photographs, _) = Photographs::of(slice::from_ref(parts), prior).ok_or_else(not_finite)?;
        let (mut best, mut start, mut rms, mut daylight) = (f64::NEG_INFINITY, None, f64::INFINITY, None);
        let mut ln_evidence = Vec::with_capacity(scenarios.len());
        for scenario in &scenarios {
            let days = known_in(scenario, &photographs, known, prior, (&mut start, best + LN_HOPELESS));
            let ln_all = ln_of_days(&days);
            best = best.max(ln_all);
            rms = days.iter().map(|(.., seen)| seen.rms).fold(rms, f64::min);
            if scenario.light.is_none() {
                daylight = shown_daylight(&days);
            }
            ln_evidence.push(ln_all);
        }
        if !best.is_finite() {
            return Err(not_finite());
        }
        ln_evidence.iter_mut().for_each(|ln| *ln -= best);
        Ok(Self { ln_evidence, daylight, rms })
    }

    /// Drops scenarios that it rules out, and updates the probabilities of the others.
    pub(super) fn enter(&self, scenarios: &mut Vec<Scenario>) {
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
    let (photographs, _) = Photographs::of(slice::from_ref(parts), prior)?;
    let scenario = Scenario::new(None, 0.0, parts.clone());
    shown_daylight(&known_in(&scenario, &photographs, known, prior, (&mut None, f64::NEG_INFINITY)))
}

/// Log evidence summed over the kinds of day, weighted by their probabilities.
fn ln_of_days(days: &[(Day, f64, KnownSeen)]) -> f64 {
    let most = days.iter().map(|(.., seen)| seen.ln_evidence).fold(f64::NEG_INFINITY, f64::max);
    let weight = |(_, share, seen): &(Day, f64, KnownSeen)| share * (seen.ln_evidence - most).exp();
    if days.is_empty() { most } else { most + days.iter().map(weight).sum::<f64>().ln() }
}

/// A photograph of a known sheet in a light, for each possible kind of day, with its probability.
fn known_in(
    Scenario { parts, days, .. }: &Scenario,
    photographs: &Photographs,
    known: &KnownReflectance,
    prior: &Prior,
    (start, mut ln_least): (&mut Option<DVector<f64>>, f64),
) -> Vec<(Day, f64, KnownSeen)> {
    let family = photographs.in_light_of(parts);
    let share = |day: Day| parts.stated.share_of(day);
    let of_all: f64 = days.iter().map(|day| share(*day)).sum();
    let mut all = Vec::new();
    for day in days {
        if let Some(seen) = family.known(*day, prior, known, start.as_ref(), ln_least) {
            *start = Some(seen.w.clone());
            ln_least = ln_least.max(seen.ln_evidence + LN_HOPELESS);
            all.push((*day, share(*day) / of_all, seen));
        }
    }
    all
}
