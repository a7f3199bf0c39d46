//! What an unknown of the scene is.

use std::fmt;
use std::ops::RangeInclusive;

use super::sources::{FoldInLight, Sources};
use crate::error::Result;
use crate::estimate::normal::{Expectation, Normal, Scale};
use crate::estimate::photograph::conditions::{Conditions, StatedScene};

/// What asks for everything that photographs of real sheets need.
pub static AUTO: Flag =
    Flag { value: "auto", help: "All effects of real sheets, lights and lenses, each with a prior" };

/// Takes the scene as stated.
pub static NONE: Flag = Flag { value: "none", help: "Nothing: the scene is taken as stated" };

/// A number of the scene that can be fitted.
pub struct Unknown {
    /// Name of the field in records, unit included.
    pub name: &'static str,
    /// What it is, for the schema; without the unit.
    pub description: &'static str,
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
    pub known: fn(&StatedScene) -> Known,
    /// What is known of it before the picture is looked at; none where it does not occur.
    pub prior: fn(&StatedScene) -> Option<Expectation>,
    /// Makes it one of the conditions.
    pub set: fn(&mut Conditions, f64),
    /// What the user reads about it; none of what every photograph has.
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
    /// Camera and light were stated: they are as two of a kind differ.
    Nominal,
    /// An ideal fold does not have it: there is more of it, the less ideal a photograph is.
    Imperfection,
    /// It is a property of what an ideal fold does not have.
    OfImperfection,
}

/// What is not ideal about a photograph, in the words of who took it.
#[derive(Debug)]
pub struct Symptom {
    /// Value where nothing is wrong.
    pub ideal: fn(&StatedScene) -> f64,
    /// Least difference from it that is worth a word.
    pub least: f64,
    /// What is wrong.
    pub words: fn(&Fitted, &StatedScene) -> String,
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
    /// The model is proportional to it: the best one is a quotient for every spectrum tried, and nothing is
    /// known of it before.
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

/// A number of the scene as found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// What it is.
    pub unknown: &'static Unknown,
    /// Value.
    pub value: f64,
    /// Standard deviation, in the same unit.
    pub sd: f64,
    /// Whether the facets say more of it than was known before.
    pub supported: bool,
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
