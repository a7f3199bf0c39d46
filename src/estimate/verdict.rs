//! Whether an estimate can be believed: good, doubtful or wrong, because of what, and what to do.
//!
//! It rests on evidence: how far the facets are from the model, whether another scene than the one that was told explains them better, and
//! how much of the spectrum they leave open. What facets cannot show, the colour of the light and the camera's curves, is said to be as it
//! was told.

use super::unknowns::{EXPOSURE, EXPOSURE_OF_PHOTOGRAPH, Normal};
use super::{Estimate, Exposure, Fitted, MISFIT};

/// Residuals, in units of their expected size, up to which facets are explained.
pub const EXPLAINED: f64 = 2.0;
/// Mean standard deviation of the reflectance from which on the facets leave too much open.
const OPEN: f64 = 0.06;
/// Standard deviations of the sum of squared residuals beyond which chance does not explain it.
const CHANCE: f64 = 5.0;
/// An exposure is doubtful that is brighter than nineteen in twenty, in standard deviations of those that people take, and wrong if it is this
/// much brighter or darker: one that is too dark makes noise, where one that is too bright asks for pixels that no picture holds.
const EXPOSURE_DOUBTFUL: f64 = 1.65;
const EXPOSURE_WRONG: f64 = 3.25;
/// A sheet that is darker than this in its brightest waveband is exposed longer: by the root of how much darker it is.
const DARK_SHEET: f64 = 0.2;
/// No sheet is darker than that in its brightest waveband.
const DARKEST_SHEET: f64 = 0.03;
/// Facets say another exposure than was stated if that leaves so small a part of the misfit, is so many standard deviations away, and by this
/// logarithm of a factor.
const EXPOSURE_BETTER: f64 = 0.8;
const EXPOSURE_SURE: f64 = 3.0;
const EXPOSURE_APART: f64 = 0.1;
/// What may be wrong where facets are not as they should be.
const CHECK: &str = "check angle, corners, light, camera and exposure";

/// How far an estimate can be believed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Nothing speaks against it: its error bars hold, if what was told of light and camera is true.
    Good,
    /// Something speaks against it: it may be further off than its error bars.
    Doubtful,
    /// The facets are not those of the scene: it means nothing.
    Wrong,
}

impl Level {
    /// As records and messages have it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Doubtful => "doubtful",
            Self::Wrong => "wrong",
        }
    }
}

/// Something that speaks against an estimate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Doubt {
    /// How much.
    pub level: Level,
    /// What it is.
    pub because: String,
    /// What to do.
    pub remedy: String,
}

impl Doubt {
    /// One for which an estimate is [`Level::Doubtful`].
    #[must_use]
    pub fn new(because: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { level: Level::Doubtful, because: because.into(), remedy: remedy.into() }
    }
}

/// What is thought of an estimate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// How far it can be believed.
    pub level: Level,
    /// Why.
    pub because: String,
    /// What to do; none if it is good.
    pub remedy: Option<String>,
}

impl Verdict {
    /// The verdict on an estimate that knows its errors.
    ///
    /// # Arguments
    /// - `doubts`: what speaks against it beside its own numbers; what stands first among the gravest is the verdict's reason.
    /// - `untold`: what the facets cannot show, in words: light and camera as they were told.
    #[must_use]
    pub fn of(estimate: &Estimate, doubts: Vec<Doubt>, untold: &str) -> Self {
        let own = [misfit(estimate), open(estimate)];
        let all: Vec<Doubt> = doubts.into_iter().chain(own.into_iter().flatten()).collect();
        let gravest = all.iter().map(|doubt| doubt.level).max().unwrap_or(Level::Good);
        match all.into_iter().find(|doubt| doubt.level == gravest) {
            Some(Doubt { level, because, remedy }) => Self { level, because, remedy: Some(remedy) },
            None => Self {
                level: Level::Good,
                because: format!(
                    "facets within {:.1} times their expected error; it rests on {untold}, which facets do not show",
                    estimate.residual_rms
                ),
                remedy: None,
            },
        }
    }
}

/// An exposure that people do not take: white that faces the sun too many times as bright as the white level of the picture.
///
/// # Arguments
/// - `is_stated`: whether somebody stated the exposure, which then is what to look at.
#[must_use]
pub fn unusual_exposure(estimate: &Estimate, is_stated: bool) -> Option<Doubt> {
    let brightest = estimate.reflectance.iter().copied().fold(DARKEST_SHEET, f64::max);
    let longer = 0.5 * (DARK_SHEET / brightest).ln().max(0.0);
    let Normal { mean, sd } = EXPOSURE_OF_PHOTOGRAPH;
    let off = (estimate.exposure.ln() - mean - longer) / sd;
    let level = if off.abs() > EXPOSURE_WRONG { Level::Wrong } else { Level::Doubtful };
    let remedy = if is_stated {
        "state the exposure as a fraction of the picture's white level, such as 0.8"
    } else {
        "check that the sheet is folded, its proportions, angle, corners and light; put a white card or a chart in the picture"
    };
    (!(-EXPOSURE_WRONG..=EXPOSURE_DOUBTFUL).contains(&off)).then(|| Doubt {
        level,
        because: format!(
            "white that faces the sun would be {:.3} times the white level of the picture, which people do not expose to",
            estimate.exposure
        ),
        remedy: remedy.to_owned(),
    })
}

/// An exposure that was stated where the facets of the fold as it was told say another.
///
/// # Arguments
/// - `told`: what facets tell with the exposure as stated, none if the search did not come to its end; `free`: if it is unknown.
#[must_use]
pub fn other_exposure(stated: Exposure, told: Option<&Estimate>, free: &Estimate) -> Option<Doubt> {
    let Fitted { value, sd, .. } = free.fitted.iter().find(|one| one.unknown == &EXPOSURE)?;
    let stated = stated.known()?;
    let apart = (value / stated).ln().abs();
    let is_better = free.residual_rms < EXPLAINED
        && told.is_none_or(|told| free.residual_rms < EXPOSURE_BETTER * told.residual_rms);
    (is_better && apart > EXPOSURE_APART && apart * value > EXPOSURE_SURE * sd).then(|| {
        let because =
            format!("the facets are those of an exposure of {value:.2} ± {sd:.2}, not {stated} as stated");
        Doubt::new(
            because,
            "leave --exposure out, or measure it again with a white card or chart in the sheet's light",
        )
    })
}

/// Something about the photograph that is further from what is usual than people err and sheets differ: it is no longer only allowed for.
#[must_use]
pub fn unusual_findings(estimate: &Estimate) -> Vec<Doubt> {
    let unusual = estimate.findings.iter().filter(|finding| finding.is_unusual);
    unusual
        .map(|finding| Doubt::new(format!("{}, more than is usual", finding.what), finding.remedy))
        .collect()
}

/// Facets that are not those of the scene.
fn misfit(estimate: &Estimate) -> Option<Doubt> {
    let rms = estimate.residual_rms;
    let level = if rms > MISFIT { Level::Wrong } else { Level::Doubtful };
    (rms >= EXPLAINED).then(|| Doubt {
        level,
        because: format!("facets are {rms:.1} times further from the model than their noise"),
        remedy: CHECK.to_owned(),
    })
}

/// Standard deviation of the reflectance in the mean over all wavebands, if the facets leave too much open.
fn too_open(estimate: &Estimate) -> Option<f64> {
    let sd = estimate.reflectance_sd()?;
    let mean = sd.iter().sum::<f64>() / sd.len() as f64;
    (mean > OPEN).then_some(mean)
}

/// Whether facets that are further from the model than chance has it do not tell the spectrum either: another scene may explain both.
#[must_use]
pub fn is_loose(estimate: &Estimate, values: usize) -> bool {
    too_open(estimate).is_some() && beyond_chance(estimate, values).is_some()
}

/// A spectrum of which the facets tell little.
fn open(estimate: &Estimate) -> Option<Doubt> {
    too_open(estimate).map(|mean| {
        Doubt::new(
            format!("the facets leave the reflectance open by ± {:.2} in the mean", 2.0 * mean),
            "a chart or card in the picture, more light, less noise or an angle nearer to 45° tell more",
        )
    })
}

/// Computed facets further from the model than their noise allows, by chance alone; `values` is how many there are.
#[must_use]
pub fn beyond_chance(estimate: &Estimate, values: usize) -> Option<Doubt> {
    let off = (estimate.residual_rms.powi(2) - 1.0) * (values as f64 / 2.0).sqrt();
    (off > CHANCE).then(|| {
        Doubt::new(
            format!("facets are further from the model than chance has it, by {off:.0} standard deviations"),
            CHECK,
        )
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::solve::Termination;

    fn estimate(residual_rms: f64, sd: f64) -> Estimate {
        Estimate {
            reflectance: vec![0.5; 4],
            total: None,
            spread: Some(DMatrix::from_diagonal_element(4, 4, sd)),
            exposure: 1.0,
            fitted: Vec::new(),
            findings: Vec::new(),
            skipped: Vec::new(),
            residual_rms,
            unexplained: 0.0,
            iterations: 1,
            trace: Vec::new(),
            termination: Termination::IterationLimit,
        }
    }

    #[test]
    fn the_gravest_doubt_is_the_reason() {
        let of = |rms, sd, doubts| Verdict::of(&estimate(rms, sd), doubts, "light D65");
        let good = of(0.9, 0.01, Vec::new());
        assert_eq!((good.level, good.remedy), (Level::Good, None));
        assert!(good.because.contains("light D65"));
        assert_eq!(of(3.0, 0.01, Vec::new()).level, Level::Doubtful);
        assert_eq!(of(0.9, 0.1, Vec::new()).level, Level::Doubtful);
        let wrong = of(6.0, 0.1, vec![Doubt::new("another", "remedy")]);
        assert!(
            wrong.level == Level::Wrong && wrong.because.starts_with("facets are 6.0 times"),
            "{wrong:?}"
        );
        assert_eq!(of(0.9, 0.1, vec![Doubt::new("another", "remedy")]).because, "another");
    }

    #[test]
    fn loose_is_what_neither_fits_nor_tells() {
        let of = |rms, sd| is_loose(&estimate(rms, sd), 600);
        assert_eq!([of(1.2, 0.1), of(1.2, 0.01), of(1.0, 0.1), of(1.0, 0.01)], [true, false, false, false]);
    }

    #[test]
    fn chance_grows_rare_with_the_number_of_values() {
        assert_eq!(beyond_chance(&estimate(1.1, 0.01), 600), None);
        assert!(beyond_chance(&estimate(1.2, 0.01), 600).is_some());
        assert_eq!(beyond_chance(&estimate(1.2, 0.01), 60), None);
    }
}
