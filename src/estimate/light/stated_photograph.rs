//! Tests whether a photograph contradicts the stated light: under one sheet model, on the kind of day that
//! suits each light best.
//!
//! Stated daylight means any daylight, whose temperature is an unknown of the photograph. It may come with or
//! without a sky: otherwise lamps of its colour, which have none, would better explain pictures that show
//! hardly any sky.

use super::Candidate;
use super::scenario::{Scenario, Starts, Tried, WITHOUT_SKY};
use super::stated::{Others, coarse_to_fine};
use crate::estimate::family::Family;
use crate::estimate::photograph::day::Day;
use crate::estimate::photograph::hypotheses::Hypothesis;
use crate::estimate::photograph::{Parts, Photographs, Weighed};
use crate::estimate::prior::Prior;
use crate::estimate::rival::{LN_AHEAD, Rival, ln_enough};
use crate::estimate::search::Search;

/// Log evidence ratio that outweighs a statement, four hundred to one: more than for computed facets, as a
/// lamp may mimic effects in a photograph that no model has. Fitted to `../shared/train`: one of 48 correctly
/// stated lights is doubted.
const LN_ODDS: f64 = 6.0;

/// The light among `others`, if any, in which a photograph is much more probable than in the stated one,
/// given its hypotheses as weighed.
pub fn rival_in_photograph(
    parts: &Parts,
    weighed: &Weighed,
    others: &Others,
    prior: &Prior,
) -> Option<Rival> {
    let Weighed { photographs, day, of_family, ln_by_emission, .. } = weighed;
    let mut starts = Starts::default();
    if let Some((_, mode)) = of_family {
        starts.keep(mode);
    }
    let mut stated = of_light(parts.clone(), others);
    let mut under_sky = stated.remove(0);
    if let Some(found) = day {
        under_sky.days = vec![found.day];
    }
    let best = under_sky.best(photographs, prior, (&mut starts, f64::NEG_INFINITY))?;
    let lamp = parts.clone().without_sky();
    let (under_lamp, hypothesis) = (photographs.in_light_of(&lamp), Hypothesis::of_family(Day::Clear));
    let of_sky = photographs.model(hypothesis, prior.broad())?;
    starts.keep(&under_lamp.model(hypothesis, prior.broad())?.carried(&of_sky, &best.solution.w));
    let ahead_by = ln_by_emission + LN_AHEAD;
    let mut least = best.ln_weight() + ahead_by;
    let mut if_ahead = |lit: Parts| {
        let best = best_of(of_light(lit, others), photographs, prior, (&mut starts, least));
        best.filter(|(_, tried)| tried.ln_weight() > least)
    };
    let lamps: Vec<_> = others.lights().iter().filter(|light| !light.is_any_daylight).collect();
    let by_lamp = |lamp: &&Candidate| if_ahead(parts.in_light(&lamp.power));
    let lamps = coarse_to_fine(&lamps, by_lamp, |(_, tried)| tried.ln_weight());
    let mut ahead: Vec<_> = lamps.into_iter().map(|(lamp, best)| (lamp.name.clone(), best)).collect();
    // daylight is like none of them
    if !parts.stated.daylight.is_some_and(|stated| stated.is_cie) {
        ahead.extend(if_ahead(parts.in_any_daylight()).map(|best| ("daylight".to_owned(), best)));
    }
    if ahead.is_empty() {
        return None;
    }
    // without a sky, the stated light may be ahead of these
    let better = best_of(stated, photographs, prior, (&mut starts, best.ln_weight()));
    let best = better.unwrap_or((under_sky, best));
    least = best.1.ln_weight() + ahead_by;
    ahead.retain(|(_, (_, tried))| tried.ln_weight() > least);
    let by_classes = |(scenario, tried): &(Scenario, Tried)| {
        Search::new(&photographs.in_light_of(&scenario.parts), prior).ln_evidence_by_classes(tried)
    };
    let of_lights = ahead.iter().filter_map(|(name, best)| Some((name.clone(), by_classes(best)?)));
    let ln_stated = by_classes(&best)? + ln_by_emission;
    Rival::of(of_lights, ln_stated, ln_enough(LN_ODDS, *ln_by_emission))
}

/// Scenarios of one light: with a sky first, if it has one, then without.
fn of_light(parts: Parts, others: &Others) -> Vec<Scenario<'_>> {
    if parts.stated.daylight.is_none() {
        return vec![Scenario::new(None, 0.0, parts)];
    }
    let lights: Vec<_> = others.lights().iter().collect();
    let mut all = Scenario::without_sky(&parts, &lights, |_| WITHOUT_SKY);
    all.insert(0, Scenario::new(None, (1.0 - WITHOUT_SKY).ln(), parts));
    all
}

/// The best scenario under all spectra as one; `None` if no evidence times probability reaches `ln_least`.
fn best_of<'a>(
    scenarios: Vec<Scenario<'a>>,
    photographs: &Photographs,
    prior: &Prior,
    (starts, mut ln_least): (&mut Starts, f64),
) -> Option<(Scenario<'a>, Tried)> {
    let mut best = None;
    for scenario in scenarios {
        if let Some(tried) = scenario.best(photographs, prior, (starts, ln_least)) {
            ln_least = tried.ln_weight();
            best = Some((scenario, tried));
        }
    }
    best
}
