//! A light or a camera that is more probable than the stated one.

use std::fmt;

use super::photograph::priors::Priors;
use super::verdict::Doubt;

/// Others are searched if linear models predict that facets may become this much more probable, and are
/// weighed by classes of spectra if they are this far ahead under all spectra as one: what classes contribute
/// varies between lights and cameras by less than the rest of the odds that outweigh a statement.
pub const LN_AHEAD: f64 = 1.0;
/// Larger ratios are not reported exactly.
const MOST_TIMES: f64 = 1e6;

/// Log evidence ratio that outweighs a statement about a photograph, given one, `ln_odds`, for sheets without
/// emission. That is higher than the odds that statements are right, as another light or camera may mimic
/// effects that no model has. Emission mimics them, too: what it contributes takes the place of the excess.
#[must_use]
pub fn ln_enough(ln_odds: f64, ln_by_emission: f64) -> f64 {
    Priors::USUAL.ln_odds_of_statement().max(ln_odds - ln_by_emission)
}

/// A light or a camera that is more probable than the stated one.
#[derive(Clone, Debug, PartialEq)]
pub struct Rival {
    /// Its name.
    pub name: String,
    /// Logarithm of how many times as probable it makes the facets.
    pub ln_odds: f64,
}

impl Rival {
    /// The one of `others` with most evidence, if it is sufficiently ahead of the stated one.
    pub fn of(others: impl Iterator<Item = (String, f64)>, ln_stated: f64, ln_enough: f64) -> Option<Self> {
        let ahead = others.map(|(name, ln_evidence)| Self { name, ln_odds: ln_evidence - ln_stated });
        let most = ahead.max_by(|a, b| a.ln_odds.total_cmp(&b.ln_odds));
        most.filter(|most| most.ln_odds > ln_enough)
    }

    /// The doubt that it casts on an estimate in the light that was `stated`.
    #[must_use]
    pub fn doubt_of_light(&self, stated: &str) -> Doubt {
        Doubt::new(
            format!("{self} as the {stated} you stated"),
            "check the light, or let vestimate find it (--illuminant unknown)",
        )
    }

    /// The doubt that it casts on an estimate with the camera that was `stated`.
    #[must_use]
    pub fn doubt_of_camera(&self, stated: &str) -> Doubt {
        Doubt::new(
            format!("{self} as the {stated} you stated"),
            "check the camera, or derive its sensitivities from a photograph of a colour chart \
             (vextract --save-camera)",
        )
    }
}

impl fmt::Display for Rival {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let times = self.ln_odds.exp();
        if times > MOST_TIMES {
            return write!(f, "{} is more than a million times as probable", self.name);
        }
        // two digits: the evidence is an approximation
        let unit = 10_f64.powf(times.log10().floor() - 1.0).max(1.0);
        write!(f, "{} is {:.0} times as probable", self.name, (times / unit).round() * unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn odds_are_said_to_two_digits() {
        let text = |ln_odds: f64| Rival { name: "A".to_owned(), ln_odds }.to_string();
        assert_eq!(text(412_f64.ln()), "A is 410 times as probable");
        assert_eq!(text(23.4_f64.ln()), "A is 23 times as probable");
        assert_eq!(text(30.0), "A is more than a million times as probable");
    }

    #[test]
    fn another_must_make_up_for_the_statement() {
        let of = |ln_evidence| {
            Rival::of([("A".to_owned(), ln_evidence), ("B".to_owned(), -9.0)].into_iter(), 5.0, 3.0)
        };
        assert_eq!(of(7.9), None);
        assert_eq!(of(8.1).map(|one| one.name), Some("A".to_owned()));
    }
}
