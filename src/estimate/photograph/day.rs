//! Kinds of days: where daylight comes from.

use super::priors::Priors;
use crate::estimate::unknowns::Normal;

/// Where daylight comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Day {
    /// From the sun, and little from a blue sky.
    Clear,
    /// From the sun and a bright sky: haze, thin cloud.
    Hazy,
    /// From clouds.
    Overcast,
    /// From a blue sky, the sun hidden.
    Shade,
}

/// A kind of day that a photograph shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DayEstimate {
    /// The most probable one.
    pub day: Day,
    /// How probable it is.
    pub probability: f64,
}

impl Day {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Clear, Self::Hazy, Self::Overcast, Self::Shade];

    /// In a word or two.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Clear => "clear",
            Self::Hazy => "hazy",
            Self::Overcast => "overcast",
            Self::Shade => "shade",
        }
    }

    /// The day of which somebody speaks who states such a sky.
    pub(super) fn with(is_sunny: bool, is_overcast: bool) -> Self {
        match (is_sunny, is_overcast) {
            (true, true) => Self::Hazy,
            (true, false) => Self::Clear,
            (false, true) => Self::Overcast,
            (false, false) => Self::Shade,
        }
    }

    pub(super) fn usual_share(self, priors: &Priors) -> f64 {
        match self {
            Self::Clear => 1.0 - 2.5 * priors.dull_share,
            Self::Hazy | Self::Overcast => priors.dull_share,
            Self::Shade => 0.5 * priors.dull_share,
        }
    }

    /// Whether the sun shines.
    #[must_use]
    pub fn has_sun(self) -> bool {
        matches!(self, Self::Clear | Self::Hazy)
    }

    /// Irradiance of an open horizontal plane by the sky, that of a plane that faces the sun by the sun being
    /// 1; none if the sun is hidden. People know no better of one that they state.
    #[must_use]
    pub fn sky(self, priors: &Priors, stated: Option<f64>) -> Option<Normal> {
        match self {
            Self::Clear | Self::Hazy if stated.is_some() => {
                stated.map(|mean| Normal { mean, sd: priors.sky_stated_sd * mean })
            }
            Self::Clear | Self::Hazy => {
                let mean = self.usual_sky(priors);
                Some(Normal { mean, sd: priors.sky_sd * mean })
            }
            Self::Overcast | Self::Shade => None,
        }
    }

    /// Reciprocal colour temperature of the sky, 1e-6/K.
    #[must_use]
    pub fn sky_mired(self, priors: &Priors) -> Normal {
        match self {
            Self::Clear | Self::Shade => Normal { mean: priors.sky_mired, sd: priors.sky_mired_sd },
            Self::Hazy => Normal { mean: priors.cloud_mired, sd: priors.hazy_mired_sd },
            Self::Overcast => Normal { mean: priors.cloud_mired, sd: priors.overcast_mired_sd },
        }
    }

    /// Share of the sky's light that is an overcast one's, the rest being a clear one's; none where it is all
    /// of it or nothing.
    #[must_use]
    pub fn cloud(self, priors: &Priors) -> Option<Normal> {
        let hazy = Normal { mean: priors.hazy_cloud, sd: priors.hazy_cloud };
        (self == Self::Hazy).then_some(hazy)
    }

    /// Logarithm of the exposure, if that of an unclouded sun is `in_the_sun`: what haze takes from the sun
    /// it adds to the sky.
    #[must_use]
    pub fn metered(self, priors: &Priors, in_the_sun: Normal) -> Normal {
        let Normal { mean, sd } = in_the_sun;
        match self {
            Self::Clear => in_the_sun,
            Self::Hazy => Normal { mean: mean - (1.0 + priors.hazy_sky).ln(), sd },
            Self::Overcast | Self::Shade => {
                Normal { mean: mean + priors.hidden_light.ln(), sd: sd.hypot(priors.hidden_light_sd) }
            }
        }
    }

    /// Share of the light on an open horizontal plane that is the sky's, as a rule.
    #[must_use]
    pub fn diffuse_share(self, priors: &Priors) -> f64 {
        if self.has_sun() { (1.0 + self.usual_sky(priors).recip()).recip() } else { 1.0 }
    }

    /// Irradiance by the sky where the sun shines, that by the sun being 1.
    fn usual_sky(self, priors: &Priors) -> f64 {
        if self == Self::Hazy { priors.hazy_sky } else { priors.sky }
    }
}
