//! An unknown of a photograph as a standard normal number.

use super::conditions::StatedScene;
use super::day::Day;
use super::hypotheses::{Hypothesis, Mistake};
use crate::estimate::unknowns::{ANGLE, EVEN_SKY, Expectation, Known, SKY_COLOUR, TABLE, Unknown};

/// An unknown with its prior in a photograph of some imperfection.
#[derive(Clone, Copy)]
pub struct Number {
    /// The unknown.
    pub unknown: &'static Unknown,
    prior: Expectation,
    /// True if it has any effect.
    pub matters: bool,
}

impl Number {
    /// All numbers of a photograph.
    #[must_use]
    pub fn all(stated: &StatedScene, Hypothesis { imperfection, mistake, .. }: Hypothesis) -> Vec<Self> {
        let number = |unknown: &&'static Unknown| {
            let (own, known) = ((unknown.prior)(stated), (unknown.known)(stated));
            // unknowns that do not occur on this day keep a place, so that a search can start from another
            // day
            let of_day = |day: &Day| (unknown.prior)(&StatedScene { day: *day, ..*stated });
            let prior = own.or_else(|| Day::ALL.iter().find_map(of_day))?;
            // in an ideal fold only what nobody stated, or what is mistaken, is unknown
            let matters = own.is_some()
                && match mistake {
                    _ if matches!(known, Known::Usual | Known::Metered) => true,
                    _ if !imperfection.is_ideal() => **unknown != EVEN_SKY,
                    Some(Mistake::Angle) => **unknown == ANGLE,
                    Some(Mistake::Sky) => **unknown == EVEN_SKY || **unknown == SKY_COLOUR,
                    Some(Mistake::Exposure | Mistake::NoFold) | None => false,
                };
            let prior = prior.with_tail(known.tail(stated.priors));
            Some(Self { unknown, prior, matters })
        };
        TABLE.iter().filter_map(number).collect()
    }

    /// Value at `w`, a standard normal number, and its derivative, in the unit of the unknown.
    #[must_use]
    pub fn at(&self, w: f64) -> (f64, f64) {
        self.prior.value(self.unknown.scale, w)
    }

    /// Root mean square deviation from the value at `w`, in the unit of the unknown, if `w` is uncertain by
    /// `sd`.
    #[must_use]
    pub fn spread(&self, w: f64, sd: f64) -> f64 {
        self.prior.spread(self.unknown.scale, w, sd)
    }

    /// The standard normal number for a value.
    #[must_use]
    pub fn normal(&self, value: f64) -> f64 {
        self.prior.normal_of(self.unknown.scale, value)
    }
}
