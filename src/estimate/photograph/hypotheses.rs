//! Hypotheses on a photograph, and their probabilities.

use super::conditions::StatedScene;
use super::day::Day;
use super::imperfection::Imperfection;
use super::priors::Priors;
use super::sheet_models::SheetModel;
use super::whitened::Photograph;

/// A hypothesis on a photograph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hypothesis {
    /// Its sheet model.
    pub kind: SheetModel,
    /// Its deviation from the ideal.
    pub imperfection: Imperfection,
    /// The kind of day on which it was taken.
    pub day: Day,
    /// The statement that is wrong, if any.
    pub mistake: Option<Mistake>,
    /// The emission of the sheet, as an index into [all possible
    /// ones](crate::estimate::emission::Emission::all), the first of which is none; `None` if emission is not
    /// considered.
    pub emission: Option<usize>,
}

/// A statement that may be entirely wrong. In usual photographs, angle and exposure are never exact, and
/// mistakes are in the tails of their priors; in a computed scene they are exact or mistaken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// No light bounces between the panels: a flat sheet, a ridge, corners elsewhere.
    NoFold,
    /// The stated exposure is not that of the picture.
    Exposure,
    /// The stated angle is not that of the fold.
    Angle,
    /// Another sky than the stated one lights it uniformly.
    Sky,
}

impl Mistake {
    /// Its probability.
    fn share(self, priors: &Priors) -> f64 {
        match self {
            Self::NoFold => priors.no_fold_share,
            Self::Exposure | Self::Angle | Self::Sky => priors.mistake_share,
        }
    }
}

/// Hypotheses on photographs of ideal folds.
pub fn ideal_hypotheses(photographs: &[Photograph]) -> Vec<Hypothesis> {
    // the sensitivities of another camera are never exactly those of this one
    if photographs.iter().any(|photograph| photograph.parts.eye.is_stand_in) {
        return Vec::new();
    }
    let is_exposure_stated =
        photographs.iter().any(|photograph| photograph.parts.stated.is_exposure_stated());
    let mistakes = [None, Some(Mistake::Angle), Some(Mistake::Sky)].into_iter();
    let mistakes = mistakes.chain(is_exposure_stated.then_some(Some(Mistake::Exposure)));
    mistakes.map(Hypothesis::ideal).collect()
}

/// Kinds of day, other than clear ones, on which photographs may have been taken.
pub fn dull_days(photographs: &[Photograph]) -> Vec<Day> {
    let are_in_daylight = photographs.iter().all(|photograph| photograph.parts.stated.daylight.is_some());
    Day::ALL.into_iter().filter(|day| are_in_daylight && *day != Day::Clear).collect()
}

/// Hypotheses without a fold.
pub fn hypotheses_without_bounces() -> [Hypothesis; 2] {
    let mistake = Some(Mistake::NoFold);
    [Hypothesis { mistake, ..Hypothesis::usual(SheetModel::Matt) }, Hypothesis::ideal(mistake)]
}

impl Hypothesis {
    /// A usual photograph with this sheet model.
    #[must_use]
    pub fn usual(kind: SheetModel) -> Self {
        Self { kind, imperfection: Imperfection::Usual, day: Day::Clear, mistake: None, emission: None }
    }

    /// A usual photograph of a sheet of the [family](SheetModel::Family) on this kind of day: under this
    /// hypothesis lights and cameras are compared.
    #[must_use]
    pub fn of_family(day: Day) -> Self {
        Self { day, ..Self::usual(SheetModel::Family) }
    }

    /// An ideal fold, everything as stated except for a mistake.
    #[must_use]
    pub fn ideal(mistake: Option<Mistake>) -> Self {
        // the sky of a computed scene is white rather than blue
        let day = if mistake == Some(Mistake::Sky) { Day::Hazy } else { Day::Clear };
        Self { kind: SheetModel::Matt, imperfection: Imperfection::Ideal, day, mistake, emission: None }
    }

    /// Logarithm of its probability, given what was stated about a photograph.
    pub fn ln_share(&self, stated: &StatedScene) -> f64 {
        let priors = stated.priors;
        let of_mistake = self.mistake.map_or(0.0, |mistake| mistake.share(priors).ln());
        let of_kind = if self.imperfection.is_ideal() { 0.0 } else { self.kind.ln_share(priors) };
        let of_day = if self.imperfection.is_ideal() { 0.0 } else { stated.share_of(self.day).ln() };
        let of_fold = self.imperfection.ln_share(priors) + of_kind + of_day;
        if self.has_bounces() { of_fold + of_mistake } else { of_mistake }
    }

    /// Differences from another hypothesis, ordered by how much they change the result of a search.
    pub fn differences(&self, other: &Self) -> [bool; 5] {
        [
            self.imperfection != other.imperfection,
            self.day.has_sun() != other.day.has_sun(),
            self.day != other.day,
            self.mistake != other.mistake,
            self.kind != other.kind,
        ]
    }

    /// True if light bounces between the panels, as in a fold.
    pub fn has_bounces(&self) -> bool {
        self.mistake != Some(Mistake::NoFold)
    }

    /// The stated values to be used.
    pub fn stated(&self, stated: &StatedScene) -> StatedScene {
        let exposure = match self.mistake {
            Some(Mistake::Exposure) if stated.is_exposure_stated() => None,
            Some(Mistake::Exposure | Mistake::NoFold | Mistake::Angle | Mistake::Sky) | None => {
                stated.exposure
            }
        };
        StatedScene { exposure, day: self.day, ..*stated }
    }
}
