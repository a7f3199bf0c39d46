//! Numbers of the scene that are fitted along with the spectrum, one file each; [`TABLE`] lists them.
//!
//! A new one is a file with an [`Unknown`] and a row of the table: without one of its parts it does not compile, without the row
//! it does not pass the lints. The values of `vestimate --fit` and their help, the records with their schema, residuals and
//! messages follow from the two.
//!
//! Facets are sums over sources (a lamp on a fold), and an unknown changes in what amounts they shine ([`Factor`]) or replaces
//! some by others ([`Sources`]). So a source's amount is a product of one function of each unknown. What is not linear (the angle of
//! the fold, the colour of the sky) is interpolated between three sources.

mod angle;
mod body_roughness;
mod bow;
mod bow_difference;
mod cloud;
mod crease;
mod elevation;
mod even_sky;
mod exposure;
mod factor;
mod fall_off;
mod first_gain;
mod fuzz;
mod glare;
mod gloss;
mod gloss_roughness;
mod ground;
mod ground_redness;
mod last_gain;
mod nearness;
mod scene_model;
mod sky;
mod sky_colour;
mod sources;
mod sun;
mod sun_colour;
mod tilt;
mod vignetting;

use std::fmt;
use std::ops::RangeInclusive;

pub use angle::ANGLE;
use body_roughness::BODY_ROUGHNESS;
use bow::BOW;
use bow_difference::BOW_DIFFERENCE;
use cloud::CLOUD;
use crease::CREASE;
use elevation::ELEVATION;
pub use even_sky::EVEN_SKY;
pub use exposure::EXPOSURE;
pub use factor::Factor;
use fall_off::FALL_OFF;
use first_gain::FIRST_GAIN;
use fuzz::FUZZ;
use glare::GLARE;
use gloss::GLOSS;
use gloss_roughness::GLOSS_ROUGHNESS;
use ground::GROUND;
use ground_redness::GROUND_REDNESS;
use last_gain::LAST_GAIN;
use nearness::NEARNESS;
pub use scene_model::{Amounts, Expected, SceneModel};
pub use sky::SKY;
pub use sky_colour::SKY_COLOUR;
pub use sources::{FoldInLight, Lamp, Sources, State};
use sun::SUN;
pub use sun_colour::SUN_COLOUR;
pub use tilt::TILT;
use vignetting::VIGNETTING;

use super::Fitted;
use super::photograph::{Conditions, Told};
use crate::error::Result;

/// All unknowns, in the order of the records.
pub static TABLE: &[&Unknown] = &[
    &EXPOSURE,
    &ANGLE,
    &TILT,
    &SKY,
    &SKY_COLOUR,
    &SUN_COLOUR,
    &GROUND,
    &GROUND_REDNESS,
    &EVEN_SKY,
    &SUN,
    &CLOUD,
    &ELEVATION,
    &GLOSS,
    &GLOSS_ROUGHNESS,
    &BODY_ROUGHNESS,
    &FUZZ,
    &CREASE,
    &BOW,
    &BOW_DIFFERENCE,
    &NEARNESS,
    &FALL_OFF,
    &VIGNETTING,
    &GLARE,
    &FIRST_GAIN,
    &LAST_GAIN,
];

/// What asks for everything that photographs of real sheets need.
pub static AUTO: Flag =
    Flag { value: "auto", help: "All that sets a real sheet apart from an ideal one, bounded by priors" };

/// What asks that the scene is believed as it is told.
pub static NONE: Flag = Flag { value: "none", help: "Nothing: the scene is believed as it is told" };

/// A number of the scene that can be fitted.
pub struct Unknown {
    /// Name of the field in records, unit included.
    pub name: &'static str,
    /// What it is, for the schema; without the unit.
    pub about: &'static str,
    /// The unit in full; none for a ratio.
    pub unit: Option<&'static str>,
    /// What asks for it.
    pub flag: &'static Flag,
    /// Least and greatest value that it can have.
    pub range: RangeInclusive<f64>,
    /// What of the value is normal before a picture is taken.
    pub scale: Scale,
    /// How it enters the model of an ideal fold.
    pub role: Role,
    /// How it enters that of a photograph of a real sheet.
    pub photograph: Option<Effect>,
}

/// How an unknown enters the model of a photograph.
pub struct Effect {
    /// What it is a number of.
    pub whose: Whose,
    /// How it is known.
    pub known: fn(&Told) -> Known,
    /// What is known of it before the picture is looked at; none where it does not occur.
    pub prior: fn(&Told) -> Option<Expectation>,
    /// Makes it one of the conditions.
    pub set: fn(&mut Conditions, f64),
    /// What the user is told of it; none of what every photograph has.
    pub symptom: Option<Symptom>,
}

/// What an unknown of a photograph is a number of, and the only part of it that depends on that number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whose {
    /// The sheet: how its surface and body reflect, the same in every photograph of it.
    Sheet,
    /// The fold, as one photograph shows it: its shape, and where the sun stands before it.
    Fold,
    /// What sun and sky both shine on, or how much the sun does.
    Scene,
    /// The light: colour of the sun, sky and ground.
    Light,
    /// The lens, and what becomes of light behind it.
    Lens,
}

/// How something is known of a photograph before it is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// As photographs usually are.
    Usual,
    /// Somebody measured it: near to that as a rule, now and then a blunder.
    Stated,
    /// The camera's settings and the day tell it, if nothing was put before the lens.
    Metered,
    /// A chart or a card showed it, which is no blunder.
    Shown,
    /// Camera and light were told: they are as two of a kind differ.
    Told,
    /// An ideal fold does not have it: there is more of it, the less ideal a photograph is.
    Imperfection,
    /// It is a property of what an ideal fold does not have.
    OfImperfection,
}

/// What is not ideal about a photograph, in the words of who took it.
#[derive(Debug)]
pub struct Symptom {
    /// Value where nothing is wrong.
    pub ideal: fn(&Told) -> f64,
    /// Least difference from it that is worth a word.
    pub least: f64,
    /// What is wrong.
    pub words: fn(&Fitted, &Told) -> String,
    /// What to do about it.
    pub remedy: &'static str,
}

/// A value of `vestimate --fit`; unknowns that share it are fitted together.
#[derive(Debug, PartialEq, Eq)]
pub struct Flag {
    /// As it is written.
    pub value: &'static str,
    /// What is fitted.
    pub help: &'static str,
}

/// How an unknown enters the model.
pub enum Role {
    /// The model is proportional to it: the best one is a quotient for every spectrum tried, and nothing is known of it before.
    Exposure,
    /// It is none of an ideal fold's.
    Photograph,
    /// It changes the sources.
    Sources {
        /// What is known of it before a picture is taken; none where the scene leaves nothing open.
        prior: fn(&FoldInLight) -> Result<Option<Normal>>,
        /// Puts it into the sources.
        enter: fn(&FoldInLight, Normal, &mut Sources) -> Result<()>,
    },
}

/// Mean and standard deviation of a number on the [`Scale`] of its unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normal {
    /// Mean.
    pub mean: f64,
    /// Standard deviation; zero for a number that is known after all.
    pub sd: f64,
}

impl Normal {
    /// The same number, of which something else, independent of what is known so far, says this.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let [own, others] = [self, other].map(|one| one.sd.powi(-2));
        let information = own + others;
        Self { mean: (own * self.mean + others * other.mean) / information, sd: information.sqrt().recip() }
    }
}

/// What is known of an unknown of a photograph before that is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectation {
    /// The unit in which the value is on its [`Scale`].
    pub unit: f64,
    /// What is known of it there.
    pub normal: Normal,
}

impl From<Normal> for Expectation {
    /// In the unit of the unknown itself.
    fn from(normal: Normal) -> Self {
        Self { unit: 1.0, normal }
    }
}

/// A monotone map between the value of an unknown and the number that is normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// The value itself.
    Linear,
    /// A million over the value: colour temperatures in K differ to the eye as their reciprocals in 1e-6/K do.
    Reciprocal,
    /// The logarithm: what is known of the value is a factor.
    Logarithm,
    /// `ln(1 + eˣ)` is the value: it is never negative, near to nothing below and proportional to x above.
    Positive,
}

impl Scale {
    /// The value where the normal number is `x`, and its derivative by it.
    #[must_use]
    pub fn value(self, x: f64) -> (f64, f64) {
        match self {
            Self::Linear => (x, 1.0),
            Self::Reciprocal => (1e6 / x, -1e6 / (x * x)),
            Self::Logarithm => (x.exp(), x.exp()),
            Self::Positive => {
                let value = if x > 30.0 { x } else { x.exp().ln_1p() };
                (value, (1.0 + (-x).exp()).recip())
            }
        }
    }

    /// The normal number where the value is `value`.
    #[must_use]
    pub fn normal(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Reciprocal => 1e6 / value,
            Self::Logarithm => value.ln(),
            Self::Positive => value.exp_m1().ln(),
        }
    }
}

/// The unknown of this name in records.
#[must_use]
pub fn named(name: &str) -> Option<&'static Unknown> {
    TABLE.iter().copied().find(|unknown| unknown.name == name)
}

/// The values of `vestimate --fit`, each once.
pub fn flags() -> impl Iterator<Item = &'static Flag> {
    let is_first = |(n, flag): &(usize, &Flag)| !TABLE[..*n].iter().any(|one| one.flag == *flag);
    let all = TABLE.iter().map(|unknown| unknown.flag).enumerate();
    all.filter(is_first).map(|(_, flag)| flag)
}

/// What `asked` asks for, in the order of the table.
#[must_use]
pub fn of_flags(asked: &[&Flag]) -> Vec<&'static Unknown> {
    TABLE.iter().copied().filter(|unknown| asked.contains(&unknown.flag)).collect()
}

impl Unknown {
    /// Whether it is a number of the sheet, the same in every photograph of it.
    #[must_use]
    pub fn is_of_sheet(&self) -> bool {
        self.photograph.as_ref().is_some_and(|effect| effect.whose == Whose::Sheet)
    }

    /// Whether it is one of photographs of real sheets alone.
    #[must_use]
    pub fn is_of_photographs(&self) -> bool {
        match self.role {
            Role::Photograph => true,
            Role::Exposure | Role::Sources { .. } => false,
        }
    }
}

/// Names tell unknowns apart.
impl PartialEq for Unknown {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Unknown {}

impl fmt::Debug for Unknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_unknowns_apart() {
        for (n, unknown) in TABLE.iter().enumerate() {
            assert_eq!(TABLE.iter().position(|one| one == unknown), Some(n));
            assert_eq!(named(unknown.name), Some(*unknown));
        }
    }

    #[test]
    fn unknowns_of_one_flag_are_fitted_together() {
        assert!(flags().all(|flag| flags().filter(|other| other.value == flag.value).count() == 1));
        assert_eq!(of_flags(&[SKY.flag, EXPOSURE.flag]), [&EXPOSURE, &SKY, &SKY_COLOUR]);
    }

    #[test]
    fn scales_and_their_inverses_agree() {
        for scale in [Scale::Linear, Scale::Reciprocal, Scale::Logarithm, Scale::Positive] {
            for x in [3.0, 5.0, 7.0] {
                let (value, slope) = scale.value(x);
                assert!((scale.normal(value) - x).abs() < 1e-12 * x);
                let rise = scale.value(x + 1e-4).0 - scale.value(x - 1e-4).0;
                assert!((slope - rise / 2e-4).abs() < 1e-6 * slope.abs());
            }
        }
    }
}
