//! Definition of an unknown of the scene.

use std::fmt;
use std::ops::RangeInclusive;

use super::sources::{FoldInLight, Sources};
use crate::error::Result;
use crate::estimate::normal::{Expectation, Normal, Scale};
use crate::estimate::photograph::conditions::{Conditions, StatedScene};
use crate::estimate::photograph::priors::Priors;

/// Fits everything that photographs of real sheets need.
pub static AUTO: Flag =
    Flag { value: "auto", help: "All effects of real sheets, lights and lenses, each with a prior" };

/// Takes the scene as stated.
pub static NONE: Flag = Flag { value: "none", help: "Nothing: the scene is taken as stated" };

/// A parameter of the scene that can be fitted.
pub struct Unknown {
    /// Name of the field in records, unit included.
    pub name: &'static str,
    /// Description for the schema, without the unit.
    pub description: &'static str,
    /// The unit in full; `None` for a ratio.
    pub unit: Option<&'static str>,
    /// The flag that selects it.
    pub flag: &'static Flag,
    /// The scale on which its prior is normal.
    pub scale: Scale,
    /// Its role in the model of an ideal fold.
    pub role: Role,
    /// The part of a photograph to which it belongs.
    pub whose: Whose,
    /// Source of prior knowledge.
    pub known: fn(&StatedScene) -> Known,
    /// Its prior; `None` if it does not occur.
    pub prior: fn(&StatedScene) -> Option<Expectation>,
    /// Sets it in the conditions of a photograph.
    pub set: fn(&mut Conditions, f64),
    /// Report to the user; `None` for what every photograph has.
    pub symptom: Option<Symptom>,
}

/// The part of a photograph to which an unknown belongs, the only one that depends on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whose {
    /// The sheet: reflection by its surface and body, the same in every photograph of it.
    Sheet,
    /// The fold in one photograph: its shape, and the position of the sun.
    Fold,
    /// Everything lit by both sun and sky, or the amount of sun.
    Scene,
    /// The light: colour of the sun, sky and ground.
    Light,
    /// The lens, and the path of light behind it.
    Lens,
}

/// Source of prior knowledge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// Usual photographs.
    Usual,
    /// A measurement by the user: usually close, now and then a blunder.
    Stated,
    /// White paper, unless it was another; or the camera's settings and the day, unless something was put in
    /// front of the lens.
    Metered,
    /// A chart or a card, which makes no blunders.
    Shown,
    /// The stated camera and light, with the differences between two of a kind.
    Nominal,
    /// An effect that an ideal fold lacks: the less ideal a photograph, the more of it.
    Imperfection,
    /// A property of something that an ideal fold lacks.
    OfImperfection,
}

impl Known {
    /// Heaviness of the tails: what a user stated is now and then a blunder, and an otherwise careful
    /// photograph may have much of one effect.
    #[must_use]
    pub fn tail(self, priors: &Priors) -> f64 {
        match self {
            Self::Stated | Self::Metered => priors.stated_tail,
            Self::Imperfection => priors.amount_tail,
            Self::Usual | Self::Shown | Self::Nominal | Self::OfImperfection => 0.0,
        }
    }
}

/// A deviation of a photograph from the ideal, in the photographer's words.
#[derive(Debug)]
pub struct Symptom {
    /// Ideal value; `None` if there is none.
    pub ideal: fn(&StatedScene) -> Option<f64>,
    /// Least difference from it worth reporting; a share of it for factors.
    pub least: f64,
    /// What is wrong.
    pub words: fn(&Fitted, &StatedScene) -> String,
    /// What to do.
    pub remedy: &'static str,
}

/// A value of `vestimate --fit`; unknowns with the same one are fitted together.
#[derive(Debug, PartialEq, Eq)]
pub struct Flag {
    /// The value.
    pub value: &'static str,
    /// What is fitted.
    pub help: &'static str,
}

/// Role of an unknown in the model.
pub enum Role {
    /// The model is proportional to it: its best value for each spectrum tried is computed, not searched for.
    Exposure,
    /// It does not occur in an ideal fold.
    Photograph,
    /// It changes the sources. Their amounts are functions of the number on its scale, so the unit of its
    /// prior is 1.
    Sources {
        /// Smallest and largest possible value.
        range: RangeInclusive<f64>,
        /// Introduces it, with its prior, into the sources.
        enter: fn(&FoldInLight, Normal, &mut Sources) -> Result<()>,
    },
}

/// A fitted parameter of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// The unknown.
    pub unknown: &'static Unknown,
    /// Value.
    pub value: f64,
    /// Standard deviation, in the same unit.
    pub sd: f64,
    /// True if the facets say more about it than the prior.
    pub supported: bool,
}

/// The facets say more about a number than the prior if its standard deviation is below this share of the
/// prior one.
pub const SUPPORTED: f64 = 0.8;

impl Unknown {
    /// True if it belongs to the sheet, and is the same in every photograph of it.
    #[must_use]
    pub fn is_of_sheet(&self) -> bool {
        self.whose == Whose::Sheet
    }

    /// True if it occurs only in photographs of real sheets.
    #[must_use]
    pub fn is_of_photographs(&self) -> bool {
        match self.role {
            Role::Photograph => true,
            Role::Exposure | Role::Sources { .. } => false,
        }
    }
}

/// Names identify unknowns.
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
