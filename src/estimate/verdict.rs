//! The verdict on an estimate: good, doubtful or wrong, with the reason and the remedy.
//!
//! It rests on evidence: how far the facets are from the model, whether another scene than the stated one
//! explains them better, and how much of the spectrum they leave open. Things that no facet can check, the
//! colour of the light and the camera's sensitivities, are named.

use std::{fmt, iter};

use super::Estimate;
pub use super::doubt::{Doubt, EXPLAINED, Level};
use super::photograph::Finding;
use super::photograph::priors::Priors;
use super::unknowns::{Normal, Unknown};
use crate::error::{Error, Result};

/// Reduced chi above which the scene cannot be right.
pub const WRONG_CHI: f64 = 5.0;
/// Mean standard deviation of the reflectance above which the facets leave too much open.
const OPEN: f64 = 0.06;
/// Probabilities of no bounces above which an estimate is doubtful, and wrong.
const PROBABLY_NO_FOLD: f64 = 0.5;
const NO_FOLD: f64 = 0.9;
/// Standard deviations of a sum of squares above which chance does not explain it.
const CHANCE: f64 = 5.0;
/// An exposure is doubtful if it is brighter than nineteen in twenty (in standard deviations of usual
/// exposures), and wrong if it is this much brighter or darker. Too dark an exposure only means noise, but
/// too bright a one requires pixel values that no picture can hold.
const EXPOSURE_DOUBTFUL: f64 = 1.65;
const EXPOSURE_WRONG: f64 = 3.25;
/// A sheet darker than this in its brightest waveband is exposed longer, by the square root of how much
/// darker it is.
const DARK_SHEET: f64 = 0.2;
/// Lower bound on the brightest waveband of any sheet.
const DARKEST_SHEET: f64 = 0.03;
/// Share of unexplained light, beyond noise, above which a spectrum fitted to the rest is meaningless.
const UNEXPLAINED: f64 = 0.3;
/// Possible causes if facets are not as they should be.
const CHECK: &str = "check angle, corners, light, camera and exposure";

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.level.name(), self.because)?;
        self.remedy.as_ref().map_or(Ok(()), |remedy| write!(f, "; {remedy}"))
    }
}

/// The verdict on an estimate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// Trustworthiness.
    pub level: Level,
    /// The reason.
    pub because: String,
    /// What to do; `None` if the estimate is good.
    pub remedy: Option<String>,
}

impl Verdict {
    /// The verdict on an estimate with error bars.
    ///
    /// # Arguments
    /// - `doubts`: doubts other than those from its own numbers, causes first. The first among the gravest is
    ///   the verdict's reason; the first of all is mentioned too, as it may be the cause.
    /// - `assumed`: things that no facet can check, in words: light and camera.
    #[must_use]
    pub fn of(estimate: &Estimate, doubts: Vec<Doubt>, assumed: &str) -> Self {
        let own = [without_bounces(estimate), far_off(estimate), open(estimate)];
        let all: Vec<Doubt> = doubts.into_iter().chain(own.into_iter().flatten()).collect();
        let gravest = all.iter().map(|doubt| doubt.level).max().unwrap_or(Level::Good);
        let first = all.first().filter(|doubt| doubt.level < gravest);
        match all.iter().find(|doubt| doubt.level == gravest) {
            Some(reason) => {
                let joined = |of: fn(&Doubt) -> &str, between: &str| {
                    let all: Vec<_> = iter::once(reason).chain(first).map(of).collect();
                    all.join(between)
                };
                Self {
                    level: gravest,
                    because: joined(|doubt| &doubt.because, "; also, "),
                    remedy: Some(joined(|doubt| &doubt.remedy, "; ")),
                }
            }
            None => Self {
                level: Level::Good,
                because: format!(
                    "model and facets agree to {:.1} times the expected error; \
                     the facets cannot confirm {assumed}",
                    estimate.residual_rms
                ),
                remedy: None,
            },
        }
    }
}

/// Refuses facets if neither noise nor any reflectance explains enough of their light, such as facets a
/// thousand times too bright.
///
/// # Arguments
/// - `noise`: standard deviation of the facets in units of the estimate's residuals; 1 if these are in
///   standard deviations.
///
/// # Errors
/// [`Error::Field`] if the estimate leaves this much light unexplained; as `noise`, which is called only in
/// this case.
pub fn refuse_unexplained(estimate: &Estimate, noise: impl FnOnce() -> Result<f64>) -> Result<()> {
    if estimate.unexplained <= UNEXPLAINED || estimate.residual_rms <= WRONG_CHI * noise()? {
        return Ok(());
    }
    let problem = format!(
        "no reflectance explains {:.0} % of the light; check exposure, noise, angle, corners, \
         light and camera",
        100.0 * estimate.unexplained
    );
    Err(Error::field("facet_rgb", problem))
}

/// An unusual exposure: white facing the sun is too many times as bright as the white level of the picture.
///
/// # Arguments
/// - `stated`: the stated exposure, if any, which the remedy then questions.
#[must_use]
pub fn unusual_exposure(estimate: &Estimate, stated: Option<f64>) -> Option<Doubt> {
    let exposure = stated.unwrap_or(estimate.exposure);
    let brightest = estimate.reflectance.iter().copied().fold(DARKEST_SHEET, f64::max);
    let longer = 0.5 * (DARK_SHEET / brightest).ln().max(0.0);
    let Normal { mean, sd } = Priors::USUAL.exposure();
    let off = (exposure.ln() - mean - longer) / sd;
    let level = if off.abs() > EXPOSURE_WRONG { Level::Wrong } else { Level::Doubtful };
    let remedy = if stated.is_some() {
        "state --exposure as a fraction of the picture's white level, such as 0.8"
    } else {
        "check the fold, its proportions, angle, corners and light, and that the file is linear; \
         put a white card or a chart in the picture"
    };
    (!(-EXPOSURE_WRONG..=EXPOSURE_DOUBTFUL).contains(&off)).then(|| Doubt {
        level,
        because: format!(
            "white facing the sun would be {exposure:.3} times the white level of the picture: \
             an improbable exposure"
        ),
        remedy: remedy.to_owned(),
    })
}

/// Findings about the photograph beyond the usual errors of users and differences of sheets, so that allowing
/// for them is not enough.
#[must_use]
pub fn unusual_findings(estimate: &Estimate) -> Vec<Doubt> {
    let unusual = estimate.findings.iter().filter(|finding| finding.is_unusual);
    let because = |finding: &Finding| format!("{}, an unusually large deviation", finding.what);
    unusual.map(|finding| Doubt::new(because(finding), finding.remedy)).collect()
}

/// Findings about the photograph that an estimate does not allow for, as only those of `fit` were unknown.
#[must_use]
pub fn ignored_findings<'f>(
    findings: &[Finding],
    fit: impl Iterator<Item = &'f Unknown> + Clone,
) -> Vec<Doubt> {
    let is_ignored = |finding: &&Finding| !fit.clone().any(|unknown| finding.unknown == Some(unknown));
    let doubt = |finding: &Finding| {
        let because = format!("{}; the estimate does not allow for that", finding.what);
        Doubt::new(because, format!("leave --fit out; otherwise {}", finding.remedy))
    };
    findings.iter().filter(is_ignored).map(doubt).collect()
}

/// Panels between which probably no light bounces.
fn without_bounces(estimate: &Estimate) -> Option<Doubt> {
    let level = if estimate.without_bounces > NO_FOLD { Level::Wrong } else { Level::Doubtful };
    (estimate.without_bounces > PROBABLY_NO_FOLD).then(|| Doubt {
        level,
        because: "no light seems to bounce between the panels: a flat sheet, corners not at the crease, \
                  or a wrong exposure"
            .to_owned(),
        remedy: "check the fold, the corners and the exposure; \
                 put a white card or a chart in the picture"
            .to_owned(),
    })
}

/// Facets that do not belong to the scene.
fn far_off(estimate: &Estimate) -> Option<Doubt> {
    let rms = estimate.residual_rms;
    let level = if rms > WRONG_CHI { Level::Wrong } else { Level::Doubtful };
    (rms >= EXPLAINED).then(|| Doubt {
        level,
        because: format!("the facets differ from the model by {rms:.1} times the expected error"),
        remedy: CHECK.to_owned(),
    })
}

/// A spectrum that the facets hardly determine.
fn open(estimate: &Estimate) -> Option<Doubt> {
    let sd = estimate.reflectance_sd()?;
    let mean = sd.iter().sum::<f64>() / sd.len() as f64;
    (mean > OPEN).then(|| {
        Doubt::new(
            format!(
                "the facets fix the reflectance only to ± {:.2} on average (two standard deviations)",
                2.0 * mean
            ),
            "put a chart or card in the picture, use more light, or fold nearer to 45°",
        )
    })
}

/// Computed facets further from the model than chance allows for their noise; `values` is their number.
#[must_use]
pub fn beyond_chance(estimate: &Estimate, values: usize) -> Option<Doubt> {
    let off = (estimate.residual_rms.powi(2) - 1.0) * (values as f64 / 2.0).sqrt();
    (off > CHANCE)
        .then(|| Doubt::new(format!("the residual is larger than noise explains ({off:.0} sigma)"), CHECK))
}

/// Computed facets that no probable spectrum explains: through another camera, or in another light, they
/// often ask for an improbable one.
#[must_use]
pub fn improbable(estimate: &Estimate) -> Option<Doubt> {
    let because = "no probable spectrum explains the facets: light, camera or fold may not be as stated";
    (estimate.surprise > CHANCE).then(|| Doubt::new(because, CHECK))
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::solve::Termination;

    fn estimate(residual_rms: f64, sd: f64) -> Estimate {
        let spread = Some(DMatrix::from_diagonal_element(4, 4, sd));
        let ended = (1, Termination::IterationLimit);
        Estimate { spread, ..Estimate::of(vec![0.5; 4], 1.0, (residual_rms, 0.0), ended) }
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
            wrong.level == Level::Wrong
                && wrong.because.starts_with("the facets differ from the model by 6.0 times"),
            "{wrong:?}"
        );
        assert!(wrong.because.ends_with("; also, another"), "{wrong:?}");
        assert_eq!(of(0.9, 0.1, vec![Doubt::new("another", "remedy")]).because, "another");
    }

    #[test]
    fn chance_grows_rare_with_the_number_of_values() {
        assert_eq!(beyond_chance(&estimate(1.1, 0.01), 600), None);
        assert!(beyond_chance(&estimate(1.2, 0.01), 600).is_some());
        assert_eq!(beyond_chance(&estimate(1.2, 0.01), 60), None);
    }
}
