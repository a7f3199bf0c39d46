//! Deviations of a photographed fold from an ideal one, in the photographer's words.

use super::conditions::StatedScene;
use super::day::{Day, DayEstimate};
use super::finding::Finding;
use super::hypotheses::Hypothesis;
use super::number::Number;
use crate::estimate::Fitted;

/// Deviations from the ideal are reported above this many standard deviations.
const SURE: f64 = 2.0;
/// A number is unusual at this distance from its prior mean, in standard deviations: one in forty is.
const UNUSUAL: f64 = 2.24;

/// Light other than that of a clear day.
#[must_use]
pub fn of_day(DayEstimate { day, .. }: DayEstimate) -> Option<Finding> {
    let what = match day {
        Day::Clear => return None,
        Day::Hazy => "much of the light comes from the sky, as in haze or under thin cloud",
        Day::Overcast => "the light is that of an overcast sky",
        Day::Shade => "the light is that of a blue sky: the sheet is in the shade",
    };
    Some(Finding {
        what: what.to_owned(),
        remedy: "photograph it in direct sunlight to learn more",
        is_unusual: false,
    })
}

/// Findings on the unknowns under a hypothesis, the most certain first.
#[must_use]
pub fn of_unknowns(fitted: &[Fitted], stated: &StatedScene, hypothesis: Hypothesis) -> Vec<Finding> {
    let numbers = Number::all(stated, hypothesis);
    let found = |one: &Fitted| {
        let number = numbers.iter().find(|number| number.unknown == one.unknown)?;
        let (symptom, from_usual) = (number.effect.symptom.as_ref()?, number.normal(one.value).abs());
        let off = (one.value - (symptom.ideal)(stated)?).abs();
        let is_noteworthy = one.supported && off >= symptom.least && off > SURE * one.sd;
        is_noteworthy
            .then(|| (off / one.sd, from_usual > UNUSUAL, (symptom.words)(one, stated), symptom.remedy))
    };
    let mut all: Vec<_> = fitted.iter().filter_map(found).collect();
    all.sort_by(|(a, ..), (b, ..)| b.total_cmp(a));
    let mut findings: Vec<Finding> = Vec::new();
    for (_, is_unusual, what, remedy) in all {
        match findings.iter_mut().find(|one| one.what == what) {
            Some(same) => same.is_unusual |= is_unusual,
            None => findings.push(Finding { what, remedy, is_unusual }),
        }
    }
    findings
}
