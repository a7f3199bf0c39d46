//! A photograph in one of its possible lights.

use nalgebra::DVector;

use super::Candidate;
use crate::estimate::photograph::day::Day;
use crate::estimate::photograph::hypotheses::Hypothesis;
use crate::estimate::photograph::{Parts, Photographs};
use crate::estimate::prior::Prior;
use crate::estimate::search::{Search, Sorted};

/// Probability that daylight comes without a sky and the ground below it: from a flash, with a colour
/// temperature in [`WITHOUT_SKY_K`], or through a small window.
pub(super) const WITHOUT_SKY: f64 = 0.1;
const WITHOUT_SKY_K: std::ops::RangeInclusive<f64> = 5000.0..=7700.0;

/// A photograph in a light, under all spectra as one.
pub(super) type Tried = Sorted<Hypothesis, ()>;

/// A light, and the photograph in it.
pub(super) struct Scenario<'a> {
    /// The candidate; `None` for daylight of any temperature under a sky, and for the stated light.
    pub light: Option<&'a Candidate>,
    /// Logarithm of its probability, relative to that of the [days](Self::days).
    pub ln_share: f64,
    pub parts: Parts,
    /// Possible kinds of day.
    pub days: Vec<Day>,
}

impl<'a> Scenario<'a> {
    /// A light with the logarithm of its probability. For lamps, a clear day stands for all.
    pub fn new(light: Option<&'a Candidate>, ln_share: f64, parts: Parts) -> Self {
        if parts.stated.daylight.is_some() {
            return Self { light, ln_share, parts, days: Day::ALL.to_vec() };
        }
        let ln_clear = parts.stated.share_of(Day::Clear).ln();
        Self { light, ln_share: ln_share - ln_clear, parts, days: vec![Day::Clear] }
    }

    /// All daylight under a sky as one scenario, and each daylight without a sky and each other light as one.
    pub fn all(parts: &Parts, lights: &'a [Candidate]) -> Vec<Self> {
        // errors of a photograph hide what is between
        let lights = lights.iter().filter(|light| !light.is_between);
        let (daylights, others): (Vec<&Candidate>, Vec<_>) = lights.partition(|light| light.is_any_daylight);
        let of_daylight: f64 = daylights.iter().map(|light| light.ln_share.exp()).sum();
        let ln_of_sky = ((1.0 - WITHOUT_SKY) * of_daylight).ln();
        let daylight = (of_daylight > 0.0).then(|| Self::new(None, ln_of_sky, parts.clone()));
        let share = |flashes: usize| WITHOUT_SKY * of_daylight / flashes as f64;
        let flashes = Self::without_sky(parts, &daylights, share);
        let lamp =
            |light: &'a Candidate| Self::new(Some(light), light.ln_share, parts.in_light(&light.power));
        daylight.into_iter().chain(flashes).chain(others.into_iter().map(lamp)).collect()
    }

    /// The photograph in the same daylight without a sky, for each of the `lights` that may be a flash; they
    /// have this probability each.
    pub fn without_sky(parts: &Parts, lights: &[&'a Candidate], share: impl Fn(usize) -> f64) -> Vec<Self> {
        let is_of_flash = |light: &&&Candidate| {
            light.is_any_daylight && light.cct_k.is_some_and(|cct_k| WITHOUT_SKY_K.contains(&cct_k))
        };
        let flashes: Vec<&Candidate> = lights.iter().filter(is_of_flash).copied().collect();
        let ln_share = share(flashes.len()).ln();
        let of = |light: &'a Candidate| {
            Self::new(Some(light), ln_share, parts.in_light(&light.power).without_sky())
        };
        flashes.iter().copied().map(of).collect()
    }

    /// The kind of day that suits it best, under one sheet model; `None` if no evidence times probability
    /// reaches `ln_least`.
    pub fn best(
        &self,
        photographs: &Photographs,
        prior: &Prior,
        (starts, mut ln_least): (&mut Starts, f64),
    ) -> Option<Tried> {
        let family = photographs.in_light_of(&self.parts);
        let mut best = None;
        for day in &self.days {
            let hypothesis = Hypothesis::of_family(*day);
            let ln_share = self.ln_share + self.parts.stated.share_of(*day).ln();
            let start = starts.of(family.unknowns(hypothesis, prior));
            let tried = Search::new(&family, prior).sort((hypothesis, ln_share), start, ln_least);
            let Some(tried) = tried else { continue };
            starts.keep(&tried.solution.w);
            if tried.ln_weight() >= ln_least {
                ln_least = tried.ln_weight();
                best = Some(tried);
            }
        }
        best
    }
}

/// The result of the last search for each number of unknowns, which differs between kinds of light.
#[derive(Default)]
pub(super) struct Starts(Vec<DVector<f64>>);

impl Starts {
    pub fn of(&self, unknowns: Option<usize>) -> Option<DVector<f64>> {
        self.0.iter().find(|w| Some(w.len()) == unknowns).cloned()
    }

    pub fn keep(&mut self, w: &DVector<f64>) {
        self.0.retain(|kept| kept.len() != w.len());
        self.0.push(w.clone());
    }
}
