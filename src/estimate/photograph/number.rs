//! An unknown of a photograph as a standard normal number.

use super::conditions::StatedScene;
use super::day::Day;
use super::hypotheses::{Hypothesis, Mistake};
use crate::estimate::unknowns::{
    ANGLE, EVEN_SKY, Effect, Expectation, Known, Normal, SKY_COLOUR, TABLE, Unknown,
};

/// An unknown with its prior in a photograph of some imperfection.
#[derive(Clone, Copy)]
pub struct Number {
    /// The unknown.
    pub unknown: &'static Unknown,
    /// Its effect.
    pub effect: &'static Effect,
    prior: Expectation,
    tail: f64,
    matters: bool,
}

impl Number {
    /// All numbers of a photograph.
    #[must_use]
    pub fn all(stated: &StatedScene, Hypothesis { imperfection, mistake, .. }: Hypothesis) -> Vec<Self> {
        let number = |unknown: &&'static Unknown| {
            let effect = unknown.photograph.as_ref()?;
            let (own, known) = ((effect.prior)(stated), (effect.known)(stated));
            // unknowns that do not occur on this day keep a place, so that a search can start from another
            // day
            let of_day = |day: &Day| (effect.prior)(&StatedScene { day: *day, ..*stated });
            let prior = own.or_else(|| Day::ALL.iter().find_map(of_day))?;
            // in an ideal fold only what is mistaken is unknown
            let matters = own.is_some()
                && match mistake {
                    _ if matches!(known, Known::Usual | Known::Metered) => true,
                    _ if !imperfection.is_ideal() => **unknown != EVEN_SKY,
                    Some(Mistake::Angle) => **unknown == ANGLE,
                    Some(Mistake::Sky) => **unknown == EVEN_SKY || **unknown == SKY_COLOUR,
                    Some(Mistake::Exposure | Mistake::NoFold) | None => false,
                };
            let tail = match known {
                Known::Stated | Known::Metered => stated.priors.stated_tail,
                Known::Imperfection => stated.priors.amount_tail,
                Known::Usual | Known::Shown | Known::Nominal | Known::OfImperfection => 0.0,
            };
            Some(Self { unknown, effect, prior, tail, matters })
        };
        TABLE.iter().filter_map(number).collect()
    }

    /// True if it has any effect.
    #[must_use]
    pub fn matters(&self) -> bool {
        self.matters
    }

    /// Value at `w`, a standard normal number, and its derivative, in the unit of the unknown. Heavy tails
    /// are those of sinh(tw) / t, which is w near 0.
    ///
    /// # Source
    /// M. C. Jones, A. Pewsey, "Sinh-arcsinh distributions", *Biometrika* 96 (2009), p. 761.
    #[must_use]
    pub fn at(&self, w: f64) -> (f64, f64) {
        let Expectation { unit, normal: Normal { mean, sd } } = self.prior;
        let t = self.tail;
        let (x, by_w) = if t > 0.0 { ((t * w).sinh() / t, (t * w).cosh()) } else { (w, 1.0) };
        let (value, by_x) = self.unknown.scale.value(mean + sd * x);
        (unit * value, unit * by_x * sd * by_w)
    }

    /// The standard normal number for a value.
    #[must_use]
    pub fn normal(&self, value: f64) -> f64 {
        let Expectation { unit, normal: Normal { mean, sd } } = self.prior;
        let x = (self.unknown.scale.normal(value / unit) - mean) / sd;
        if self.tail > 0.0 { (self.tail * x).asinh() / self.tail } else { x }
    }
}
