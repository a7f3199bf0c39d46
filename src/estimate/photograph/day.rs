//! Kinds of day: the origin of daylight.

use super::priors::Priors;
use crate::estimate::unknowns::Normal;

/// The origin of daylight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Day {
    /// The sun, and little from a blue sky.
    Clear,
    /// The sun and a bright sky: haze, thin cloud.
    Hazy,
    /// Clouds.
    Overcast,
    /// A blue sky, with the sun hidden.
    Shade,
}

/// The kind of day inferred from a photograph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DayEstimate {
    /// The most probable kind.
    pub day: Day,
    /// Its probability.
    pub probability: f64,
}

impl Day {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Clear, Self::Hazy, Self::Overcast, Self::Shade];

    /// Short name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Clear => "clear",
            Self::Hazy => "hazy",
            Self::Overcast => "overcast",
            Self::Shade => "shade",
        }
    }

    /// The kind of day implied by such a stated sky.
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

    /// True if the sun shines.
    #[must_use]
    pub fn has_sun(self) -> bool {
        matches!(self, Self::Clear | Self::Hazy)
    }

    /// Irradiance from the sky on an open horizontal plane, relative to that from the sun on a plane facing
    /// it; `None` if the sun is hidden. A stated value is no more accurate.
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

    /// Share of the sky's light that has the distribution of an overcast sky, the rest being a clear one's;
    /// `None` if it is all or nothing.
    #[must_use]
    pub fn cloud(self, priors: &Priors) -> Option<Normal> {
        let hazy = Normal { mean: priors.hazy_cloud, sd: priors.hazy_cloud };
        (self == Self::Hazy).then_some(hazy)
    }

    /// Logarithm of the exposure, given that in an unclouded sun: light that haze takes from the sun is added
    /// to the sky.
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

    /// Usual share of the sky in the light on an open horizontal plane.
    #[must_use]
    pub fn diffuse_share(self, priors: &Priors) -> f64 {
        if self.has_sun() { (1.0 + self.usual_sky(priors).recip()).recip() } else { 1.0 }
    }

    /// Irradiance from the sky relative to the sun's, on days with sun.
    fn usual_sky(self, priors: &Priors) -> f64 {
        if self == Self::Hazy { priors.hazy_sky } else { priors.sky }
    }
}
