//! Kinds of days: where daylight comes from.

use super::beliefs::Beliefs;
use crate::estimate::unknowns::Normal;

/// Standard deviation of a sky that somebody stated, as a part of it.
const STATED: f64 = 0.25;

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
pub struct Found {
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

    /// How many photographs are taken on such a day.
    #[must_use]
    pub fn share(self, beliefs: &Beliefs) -> f64 {
        match self {
            Self::Clear => 1.0 - beliefs.hazy_share - beliefs.overcast_share - beliefs.shade_share,
            Self::Hazy => beliefs.hazy_share,
            Self::Overcast => beliefs.overcast_share,
            Self::Shade => beliefs.shade_share,
        }
    }

    /// Whether the sun shines.
    #[must_use]
    pub fn has_sun(self) -> bool {
        matches!(self, Self::Clear | Self::Hazy)
    }

    /// Irradiance of an open horizontal plane by the sky, that of a plane that faces the sun by the sun being 1; none if the sun is hidden. People know no
    /// better of one that they state.
    #[must_use]
    pub fn sky(self, beliefs: &Beliefs, stated: Option<f64>) -> Option<Normal> {
        match self {
            Self::Clear | Self::Hazy if stated.is_some() => {
                stated.map(|mean| Normal { mean, sd: STATED * mean })
            }
            Self::Clear => Some(Normal { mean: beliefs.sky_mean, sd: beliefs.sky_sd }),
            Self::Hazy => Some(Normal { mean: beliefs.hazy_sky_mean, sd: beliefs.hazy_sky_sd }),
            Self::Overcast | Self::Shade => None,
        }
    }

    /// Reciprocal colour temperature of the sky, 1e-6/K.
    #[must_use]
    pub fn sky_mired(self, beliefs: &Beliefs) -> Normal {
        match self {
            Self::Clear => Normal { mean: beliefs.sky_mired, sd: beliefs.sky_mired_sd },
            Self::Hazy => Normal { mean: beliefs.hazy_mired, sd: beliefs.hazy_mired_sd },
            Self::Overcast => Normal { mean: beliefs.overcast_mired, sd: beliefs.overcast_mired_sd },
            Self::Shade => Normal { mean: beliefs.shade_mired, sd: beliefs.shade_mired_sd },
        }
    }

    /// Irradiance by a sun that is hidden of a plane that faces it, that of an open horizontal plane by the sky being 1, on the scale of its unknown.
    #[must_use]
    pub fn hidden_sun(self) -> Option<Normal> {
        (!self.has_sun()).then_some(Normal { mean: -0.5, sd: 1.0 })
    }

    /// Share of the sky's light that is an overcast one's; none of a clear day.
    #[must_use]
    pub fn cloud(self) -> Option<Normal> {
        match self {
            Self::Clear => None,
            Self::Hazy => Some(Normal { mean: 0.3, sd: 0.3 }),
            Self::Overcast => Some(Normal { mean: 0.9, sd: 0.2 }),
            Self::Shade => Some(Normal { mean: 0.0, sd: 0.2 }),
        }
    }
}
