//! What a photograph shows that sets its fold apart from an ideal one, in the words of who took it.

use super::conditions::Told;
use crate::estimate::Fitted;

/// Something that is not ideal about a photograph. The estimate allows for it; a photograph without it tells more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What is wrong.
    pub what: String,
    /// What to do about it.
    pub remedy: &'static str,
}

/// Differences from what is ideal, in standard deviations, of which a word is said.
const SURE: f64 = 2.0;

/// Numbers further than that from what was known before, in standard deviations, are not allowed for but doubted: people seldom err by so
/// much, and where facets say so something else is wrong as a rule.
const BEYOND: f64 = 3.0;

/// What the facets say of the unknowns that is further from what was known before than people err, in words.
#[must_use]
pub fn beyond(fitted: &[Fitted]) -> Option<(String, &'static str)> {
    let doubted = |one: &&Fitted| one.supported && one.off.abs() > BEYOND;
    let with_symptom = fitted.iter().filter(doubted).filter_map(|one| {
        let symptom = one.unknown.photograph.as_ref()?.symptom.as_ref()?;
        Some((one, symptom))
    });
    let (one, symptom) = with_symptom.max_by(|(a, _), (b, _)| a.off.abs().total_cmp(&b.off.abs()))?;
    let Fitted { unknown, value, sd, .. } = one;
    let words = symptom.words;
    Some((format!("{words}, by more than people err: {} {value:.3} ± {sd:.3}", unknown.name), symptom.remedy))
}

/// What the facets tell of the unknowns, what they are surest of first.
#[must_use]
pub fn findings(fitted: &[Fitted], told: &Told) -> Vec<Finding> {
    let found = |one: &Fitted| {
        let symptom = one.unknown.photograph.as_ref()?.symptom.as_ref()?;
        let off = (one.value - (symptom.ideal)(told)).abs();
        let is_found =
            one.supported && off >= symptom.least && off > SURE * one.sd && one.off.abs() <= BEYOND;
        is_found.then_some((off / one.sd, symptom))
    };
    let mut all: Vec<_> = fitted.iter().filter_map(found).collect();
    all.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let mut findings: Vec<Finding> = Vec::new();
    for (_, symptom) in all {
        if findings.iter().all(|one| one.what != symptom.words) {
            findings.push(Finding { what: symptom.words.to_owned(), remedy: symptom.remedy });
        }
    }
    findings
}
