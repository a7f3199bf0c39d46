//! What a photograph may be taken to be, and how often it is so.

use super::conditions::StatedScene;
use super::day::Day;
use super::imperfection::Imperfection;
use super::priors::Priors;
use super::sheet_models::SheetModel;
use super::whitened::Photograph;

/// What a photograph is taken to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hypothesis {
    /// The kind of its sheet.
    pub kind: SheetModel,
    /// How far it is from an ideal one.
    pub imperfection: Imperfection,
    /// The kind of day on which it was taken.
    pub day: Day,
    /// What is not as it was stated, if anything is.
    pub mistake: Option<Mistake>,
    /// What the sheet sends out itself, as a place among
    /// [all that it may](crate::estimate::emission::Emission::all), nothing being the first; none where that
    /// is not asked.
    pub emission: Option<usize>,
}

/// What may be another thing altogether than was stated. Angle and exposure are never exact in photographs as
/// people take them, where mistakes are in the tails of their priors; in a scene that is computed they are,
/// or are mistaken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// No light bounces between the panels: a flat sheet, a ridge, corners elsewhere.
    NoFold,
    /// The exposure that somebody stated is not that of the picture.
    Exposure,
    /// The angle that somebody stated is not that of the fold.
    Angle,
    /// Another sky than was stated lights it, alike in all directions.
    Sky,
}

impl Mistake {
    /// How often it is made.
    fn share(self, priors: &Priors) -> f64 {
        match self {
            Self::NoFold => priors.no_fold_share,
            Self::Exposure | Self::Angle | Self::Sky => priors.mistake_share,
        }
    }
}

/// All hypotheses on photographs of folds, the most probable first.
pub fn hypotheses(photographs: &[Photograph]) -> Vec<Hypothesis> {
    let mut all = usual_hypotheses();
    // the sensitivities of another camera are never those of this one; an ideal fold is the same whatever its
    // sheet's kind
    if !photographs.iter().any(|photograph| photograph.parts.eye.is_stand_in) {
        let mistakes = [None, Some(Mistake::Angle), Some(Mistake::Sky)];
        all.extend(mistakes.map(Hypothesis::ideal));
        if photographs.iter().any(|photograph| photograph.parts.stated.is_exposure_stated()) {
            all.push(Hypothesis::ideal(Some(Mistake::Exposure)));
        }
    }
    all
}

/// Hypotheses on photographs as people take them.
pub fn usual_hypotheses() -> Vec<Hypothesis> {
    SheetModel::ALL.map(Hypothesis::usual).to_vec()
}

/// Days other than clear ones on which photographs may have been taken.
pub fn dull_days(photographs: &[Photograph]) -> Vec<Day> {
    let are_in_daylight = photographs.iter().all(|photograph| photograph.parts.stated.daylight.is_some());
    Day::ALL.into_iter().filter(|day| are_in_daylight && *day != Day::Clear).collect()
}

/// Hypotheses on what is no fold.
pub fn hypotheses_without_bounces() -> [Hypothesis; 2] {
    let mistake = Some(Mistake::NoFold);
    [Hypothesis { mistake, ..Hypothesis::usual(SheetModel::Matt) }, Hypothesis::ideal(mistake)]
}

impl Hypothesis {
    /// A photograph as people take them, of this kind of sheet.
    #[must_use]
    pub fn usual(kind: SheetModel) -> Self {
        Self { kind, imperfection: Imperfection::USUAL, day: Day::Clear, mistake: None, emission: None }
    }

    /// One as people take them under another sky than a clear day's.
    #[must_use]
    pub fn on_dull_day(day: Day, kind: SheetModel) -> Self {
        Self { day, ..Self::usual(kind) }
    }

    /// One of an ideal fold, all as stated but for a mistake.
    #[must_use]
    pub fn ideal(mistake: Option<Mistake>) -> Self {
        // the sky of a computed scene is white rather than blue
        let day = if mistake == Some(Mistake::Sky) { Day::Hazy } else { Day::Clear };
        Self { kind: SheetModel::Matt, imperfection: Imperfection::IDEAL, day, mistake, emission: None }
    }

    /// Logarithm of how often it is true of photographs of which this was stated.
    pub fn ln_share(&self, stated: &StatedScene) -> f64 {
        let priors = stated.priors;
        let of_mistake = self.mistake.map_or(0.0, |mistake| mistake.share(priors).ln());
        let of_kind = if self.imperfection.is_ideal() { 0.0 } else { self.kind.ln_share(priors) };
        let of_day = if self.imperfection.is_ideal() { 0.0 } else { stated.share_of(self.day).ln() };
        let of_fold = self.imperfection.ln_share(priors) + of_kind + of_day;
        if self.has_bounces() { of_fold + of_mistake } else { of_mistake }
    }

    /// What it does not share with another, that comes first which changes most of where the search under it
    /// leads.
    pub fn differences(&self, other: &Self) -> [bool; 5] {
        [
            self.imperfection != other.imperfection,
            self.day.has_sun() != other.day.has_sun(),
            self.day != other.day,
            self.mistake != other.mistake,
            self.kind != other.kind,
        ]
    }

    /// Whether it is a fold on a clear day as people take them.
    pub fn is_usual_fold(&self) -> bool {
        *self == Self::usual(self.kind)
    }

    /// Whether light bounces between the panels, as it does in a fold.
    pub fn has_bounces(&self) -> bool {
        self.mistake != Some(Mistake::NoFold)
    }

    /// Which of the stated values to use.
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
