//! Whether a photograph speaks against the light that was stated: under one kind of sheet, on the kind of day that suits each light best.
//!
//! Daylight that people state is any daylight: a photograph has its temperature as an unknown. It comes with a sky or, now and then, without: otherwise
//! lamps of its colour, which have none, would explain pictures better that show hardly any.

use std::slice;

use nalgebra::DVector;

use super::photograph::{WITHOUT_SKY, is_of_flash};
use super::stated::{LN_AHEAD, Likelier, Others, TOLD_APART};
use crate::estimate::photograph::conditions::Daylight;
use crate::estimate::photograph::day::Day;
use crate::estimate::photograph::hypotheses::Hypothesis;
use crate::estimate::photograph::kinds::Kind;
use crate::estimate::photograph::{Parts, Photographs};
use crate::estimate::prior::Prior;
use crate::estimate::search::{Search, Sorted};

/// Logarithm of the ratio of evidence that makes up for a statement, four hundred times: more than of computed facets, as a lamp may mimic what of a
/// photograph no model has. Fitted to `../shared/train`: one of 48 in light that is told rightly is doubted.
const LN_ODDS: f64 = 6.0;

type Tried = Sorted<Hypothesis, ()>;

/// A light, and the photograph in it: with a sky, if it has one, and without.
struct Lit {
    name: String,
    with_sky: Parts,
    without_sky: Vec<Parts>,
}

/// The way of a light that has most evidence.
struct Best<'a> {
    parts: &'a Parts,
    tried: Tried,
}

/// The light in which a photograph is much more probable than in the one that was stated, if there is any among `others`.
pub fn likelier_in_photograph(parts: &Parts, others: &Others, prior: &Prior) -> Option<Likelier> {
    let photographs = Photographs::of(slice::from_ref(parts));
    let stated = Lit::of(String::new(), parts.clone(), others);
    let stated = stated.best(&photographs, prior, None, f64::NEG_INFINITY)?;
    let least = stated.tried.ln_weight() + LN_AHEAD;
    let lights = other_lights(parts, others);
    let ahead = lights.iter().filter_map(|lit| {
        let best = lit.best(&photographs, prior, Some(&stated.tried.solution.w), least)?;
        (best.tried.ln_weight() > least).then_some((lit, best))
    });
    let mut ahead: Vec<_> = ahead.collect();
    if ahead.is_empty() {
        return None;
    }
    ahead.sort_by(|(_, a), (_, b)| b.tried.ln_weight().total_cmp(&a.tried.ln_weight()));
    ahead.truncate(TOLD_APART);
    let by_classes = |Best { parts, tried }: &Best| {
        Search::new(&photographs.in_light_of(parts), prior).ln_evidence_by_classes(tried)
    };
    let of_lights = ahead.iter().filter_map(|(lit, best)| Some((lit.name.clone(), by_classes(best)?)));
    Likelier::of(of_lights, by_classes(&stated)?, LN_ODDS)
}

/// The same photograph in daylight, unless that was stated, and in each of the lamps.
fn other_lights(parts: &Parts, others: &Others) -> Vec<Lit> {
    let is_stated = matches!(parts.told.daylight, Some(Daylight::Cie { .. }));
    let daylight = (!is_stated).then(|| Lit::of("daylight".to_owned(), parts.in_any_daylight(), others));
    let lamps = others.lights().iter().filter(|light| !light.is_any_daylight);
    let lamps = lamps.map(|light| Lit::of(light.name.clone(), parts.in_light(&light.power), others));
    daylight.into_iter().chain(lamps).collect()
}

impl Lit {
    fn of(name: String, with_sky: Parts, others: &Others) -> Self {
        let flashes =
            others.lights().iter().filter(|light| with_sky.told.daylight.is_some() && is_of_flash(light));
        let without_sky = flashes.map(|light| with_sky.in_light(&light.power).without_sky()).collect();
        Self { name, with_sky, without_sky }
    }

    /// Under all spectra as one; none where evidence and share cannot be as high as `ln_least`.
    fn best(
        &self,
        photographs: &Photographs,
        prior: &Prior,
        start: Option<&DVector<f64>>,
        ln_least: f64,
    ) -> Option<Best<'_>> {
        let mut best: Option<Best> = None;
        for (parts, day, share) in self.ways() {
            let family = photographs.in_light_of(parts);
            let hypothesis = Hypothesis::on_dull_day(day, Kind::Family);
            let least = best.as_ref().map_or(ln_least, |best| best.tried.ln_weight());
            // lights of another kind have other unknowns
            let from = best.as_ref().map(|best| &best.tried.solution.w).or(start);
            let from = from.filter(|w| Some(w.len()) == family.unknowns(hypothesis, prior)).cloned();
            let tried = Search::new(&family, prior).sort((hypothesis, share.ln()), from, least);
            best = tried.filter(|one| one.ln_weight() >= least).map(|tried| Best { parts, tried }).or(best);
        }
        best
    }

    /// How it may fall on the fold: the photograph so, the kind of day, and how often; indoors days make no difference.
    fn ways(&self) -> Vec<(&Parts, Day, f64)> {
        let told = &self.with_sky.told;
        if told.daylight.is_none() {
            return vec![(&self.with_sky, Day::Clear, 1.0)];
        }
        let share = |day: Day| (1.0 - WITHOUT_SKY) * day.share(told);
        let with_sky = Day::ALL.map(|day| (&self.with_sky, day, share(day)));
        let without_sky = self.without_sky.iter().map(|parts| (parts, Day::Clear, WITHOUT_SKY));
        with_sky.into_iter().chain(without_sky).collect()
    }
}
