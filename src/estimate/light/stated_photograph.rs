//! Tests whether a photograph contradicts the stated light: under one sheet model, on the kind of day that
//! suits each light best.
//!
//! Stated daylight means any daylight, whose temperature is an unknown of the photograph. It may come with or
//! without a sky: otherwise lamps of its colour, which have none, would better explain pictures that show
//! hardly any sky.

use nalgebra::DVector;

use super::Candidate;
use super::photograph::{WITHOUT_SKY, is_of_flash};
use super::stated::{Others, coarse_to_fine};
use crate::estimate::photograph::conditions::Daylight;
use crate::estimate::photograph::day::Day;
use crate::estimate::photograph::hypotheses::Hypothesis;
use crate::estimate::photograph::sheet_models::SheetModel;
use crate::estimate::photograph::{Modes, Parts, Photographs};
use crate::estimate::prior::Prior;
use crate::estimate::rival::{LN_AHEAD, Rival, ln_enough};
use crate::estimate::search::{Search, Sorted};

/// Log evidence ratio that outweighs a statement, four hundred to one: more than for computed facets, as a
/// lamp may mimic effects in a photograph that no model has. Fitted to `../shared/train`: one of 48 correctly
/// stated lights is doubted.
const LN_ODDS: f64 = 6.0;

type Tried = Sorted<Hypothesis, ()>;

/// A light, and the photograph in it: with a sky, if it has one, and without.
struct Lit {
    name: String,
    with_sky: Parts,
    without_sky: Vec<Parts>,
    /// Kinds of day on which it may shine.
    days: Vec<Day>,
}

/// The scenario of a light with most evidence: its index, and its search under all spectra as one.
struct Best {
    scenario: usize,
    tried: Tried,
}

/// The result of the last search for each number of unknowns, which differs between kinds of light.
#[derive(Default)]
struct Starts(Vec<DVector<f64>>);

impl Starts {
    fn of(&self, unknowns: Option<usize>) -> Option<DVector<f64>> {
        self.0.iter().find(|w| Some(w.len()) == unknowns).cloned()
    }

    fn keep(&mut self, w: &DVector<f64>) {
        self.0.retain(|kept| kept.len() != w.len());
        self.0.push(w.clone());
    }
}

/// The light among `others`, if any, in which a photograph is much more probable than in the stated one,
/// given the modes of its search.
pub fn rival_in_photograph(parts: &Parts, modes: &Modes, others: &Others, prior: &Prior) -> Option<Rival> {
    let Modes { photographs, day, ln_by_emission, .. } = modes;
    let days = day.map_or_else(|| Day::ALL.to_vec(), |found| vec![found.day]);
    let under_sky = Lit { name: String::new(), with_sky: parts.clone(), without_sky: Vec::new(), days };
    let mut starts = Starts::default();
    if let Some((_, mode)) = modes.of_day() {
        starts.keep(mode);
    }
    let best_under_sky = under_sky.best(photographs, prior, (&mut starts, f64::NEG_INFINITY))?;
    let lamp = parts.clone().without_sky();
    let of_sky = (photographs, &best_under_sky.tried.solution.w);
    let hypothesis = Hypothesis::on_dull_day(Day::Clear, SheetModel::Family);
    starts.keep(&photographs.in_light_of(&lamp).carried(of_sky, hypothesis, prior)?);
    let mut least = best_under_sky.tried.ln_weight() + ln_by_emission + LN_AHEAD;
    let mut if_ahead = |lit: Lit| {
        let best = lit.best(photographs, prior, (&mut starts, least))?;
        (best.tried.ln_weight() > least).then_some((lit, best))
    };
    let by_lamp =
        |lamp: &&Candidate| if_ahead(Lit::of(lamp.name.clone(), parts.in_light(&lamp.power), others));
    let lamps: Vec<_> = others.lights().iter().filter(|light| !light.is_any_daylight).collect();
    let lamps = coarse_to_fine(&lamps, by_lamp, |(_, best)| best.tried.ln_weight());
    let mut ahead: Vec<_> = lamps.into_iter().map(|(_, ahead)| ahead).collect();
    // daylight is like none of them
    if !matches!(parts.stated.daylight, Some(Daylight::Cie { .. })) {
        ahead.extend(if_ahead(Lit::of("daylight".to_owned(), parts.in_any_daylight(), others)));
    }
    if ahead.is_empty() {
        return None;
    }
    // without a sky, the stated light may be ahead of these
    let stated = Lit { days: under_sky.days.clone(), ..Lit::of(String::new(), parts.clone(), others) };
    let best_of_stated = stated.best(photographs, prior, (&mut starts, f64::NEG_INFINITY))?;
    least = best_of_stated.tried.ln_weight() + ln_by_emission + LN_AHEAD;
    ahead.retain(|(_, best)| best.tried.ln_weight() > least);
    let by_classes = |lit: &Lit, Best { scenario, tried }: &Best| {
        let (parts, ..) = *lit.scenarios().get(*scenario)?;
        Search::new(&photographs.in_light_of(parts), prior).ln_evidence_by_classes(tried)
    };
    let of_lights = ahead.iter().filter_map(|(lit, best)| Some((lit.name.clone(), by_classes(lit, best)?)));
    let ln_stated = by_classes(&stated, &best_of_stated)? + ln_by_emission;
    Rival::of(of_lights, ln_stated, ln_enough(LN_ODDS, *ln_by_emission))
}

impl Lit {
    fn of(name: String, with_sky: Parts, others: &Others) -> Self {
        let flashes =
            others.lights().iter().filter(|light| with_sky.stated.daylight.is_some() && is_of_flash(light));
        let without_sky = flashes.map(|light| with_sky.in_light(&light.power).without_sky()).collect();
        Self { name, with_sky, without_sky, days: Day::ALL.to_vec() }
    }

    /// The best scenario under all spectra as one; `None` if evidence times probability cannot reach
    /// `ln_least`.
    fn best(
        &self,
        photographs: &Photographs,
        prior: &Prior,
        (starts, ln_least): (&mut Starts, f64),
    ) -> Option<Best> {
        let mut best: Option<Best> = None;
        for (scenario, (parts, day, share)) in self.scenarios().into_iter().enumerate() {
            let family = photographs.in_light_of(parts);
            let hypothesis = Hypothesis::on_dull_day(day, SheetModel::Family);
            let least = best.as_ref().map_or(ln_least, |best| best.tried.ln_weight());
            let from = starts.of(family.unknowns(hypothesis, prior));
            let Some(tried) = Search::new(&family, prior).sort((hypothesis, share.ln()), from, least) else {
                continue;
            };
            starts.keep(&tried.solution.w);
            if tried.ln_weight() >= least {
                best = Some(Best { scenario, tried });
            }
        }
        best
    }

    /// Scenarios of the light: the photograph in it, the kind of day, and the probability; indoors days make
    /// no difference.
    fn scenarios(&self) -> Vec<(&Parts, Day, f64)> {
        let stated = &self.with_sky.stated;
        if stated.daylight.is_none() {
            return vec![(&self.with_sky, Day::Clear, 1.0)];
        }
        let share = |day: Day| (1.0 - WITHOUT_SKY) * stated.share_of(day);
        let with_sky = self.days.iter().map(|day| (&self.with_sky, *day, share(*day)));
        let without_sky = self.without_sky.iter().map(|parts| (parts, Day::Clear, WITHOUT_SKY));
        with_sky.chain(without_sky).collect()
    }
}
