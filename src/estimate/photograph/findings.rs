//! Deviations of a photographed fold from an ideal one, in the photographer's words.

use super::conditions::StatedScene;
use super::day::{Day, DayEstimate};
use super::finding::Finding;
use super::hypotheses::Hypothesis;
use super::number::Number;
use crate::estimate::Fitted;
use crate::estimate::unknowns::Scale;

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
        unknown: None,
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
        let (symptom, from_usual) = (one.unknown.symptom.as_ref()?, number.normal(one.value).abs());
        let ideal = (symptom.ideal)(stated)?;
        let off = (one.value - ideal).abs();
        let least = if one.unknown.scale == Scale::Logarithm { symptom.least * ideal } else { symptom.least };
        let is_noteworthy = one.supported && off >= least && off > SURE * one.sd;
        let finding = || Finding {
            unknown: Some(one.unknown),
            what: (symptom.words)(one, stated),
            remedy: symptom.remedy,
            is_unusual: from_usual > UNUSUAL,
        };
        is_noteworthy.then(|| (off / one.sd, finding()))
    };
    let mut all: Vec<_> = fitted.iter().filter_map(found).collect();
    all.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let mut findings: Vec<Finding> = Vec::new();
    for (_, finding) in all {
        match findings.iter_mut().find(|one| one.what == finding.what) {
            Some(same) => same.is_unusual |= finding.is_unusual,
            None => findings.push(finding),
        }
    }
    findings
}
