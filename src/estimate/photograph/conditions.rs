//! Under which conditions a photograph was taken.

use nalgebra::{DMatrix, DVector};

use super::day::Day;
use super::priors::Priors;
use crate::estimate::emission::Backing;
use crate::estimate::unknowns::Normal;
use crate::spectrum::daylight_weights;

/// All that the facets of a photograph depend on, beside the spectrum and the kind of sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    /// Value of a perfect white diffuser facing the sun in its strongest channel, or what a chart in the
    /// light of sun and sky made of it.
    pub exposure: f64,
    /// Gains of the first and the last of three channels beside the second.
    pub gains: [f64; 2],
    /// Angle between the panels, degrees.
    pub angle_deg: f64,
    /// Angle of the sun off the bisecting plane, degrees.
    pub tilt_deg: f64,
    /// Reciprocal colour temperature of the sun, 1e-6/K, if it is daylight.
    pub sun_mired: Option<f64>,
    /// The kind of day.
    pub day: Day,
    /// Irradiance of a plane that faces the sun by the sun; 1 where that is not hidden.
    pub sun: f64,
    /// Irradiance of an open horizontal plane by the sky; 1 where the sun is hidden.
    pub sky: f64,
    /// Share of the sky's light that is an overcast one's.
    pub cloud: f64,
    /// How far above the horizon the fold opens, degrees.
    pub elevation_deg: f64,
    /// Irradiance of an open plane by light that is alike in all directions.
    pub even_sky: f64,
    /// Reciprocal colour temperature of the sky, 1e-6/K; none if its colour is given.
    pub sky_mired: Option<f64>,
    /// Reflectance of the ground at 550 nm.
    pub ground: f64,
    /// Rise of the ground's reflectance over 150 nm, relative to that at 550 nm.
    pub ground_redness: f64,
    /// Radius of the rounded crease, in depths of the panels.
    pub crease_radius: f64,
    /// By how much both panels turn over their depth, degrees.
    pub bow_deg: f64,
    /// By how much panel 0 turns more than their mean, and panel 1 less, degrees.
    pub bow_difference_deg: f64,
    /// Depth of a panel over the distance of the lamp that lights it; 0 of the sun.
    pub nearness: f64,
    /// By how much end 1 of the crease has less light than end 0, relative to the middle.
    pub fall_off: f64,
    /// Share of the light that the lens loses in the corners of the picture.
    pub vignetting: f64,
    /// Veiling glare: share of the picture's mean light that the lens spreads over all of it.
    pub veiling_glare: f64,
    /// Specular weight: strength of the surface's reflection, that of a bare surface of refractive index 1.5
    /// being 1.
    pub specular_weight: f64,
    /// Roughness of the surface: α of its microfacets' distribution (GGX).
    pub specular_roughness: f64,
    /// Roughness of the body: Oren and Nayar's σ, degrees.
    pub body_roughness_deg: f64,
    /// Sheen: brightening of the body at grazing incidence or viewing.
    pub sheen: f64,
}

/// What was stated about a photograph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedScene {
    /// The priors on it.
    pub priors: &'static Priors,
    /// The exposure, if it is known.
    pub exposure: Option<f64>,
    /// Logarithm of what it is in an unclouded sun by the camera's settings, if they are known.
    pub metered: Option<Normal>,
    /// Whether a chart or a card in the light of sun and sky told the exposure and balanced the channels.
    pub by_chart: bool,
    /// Number of channels.
    pub channels: usize,
    /// Angle between the panels, degrees.
    pub angle_deg: f64,
    /// Its standard deviation, degrees.
    pub angle_sd_deg: f64,
    /// Angle of the sun off the bisecting plane, degrees.
    pub tilt_deg: f64,
    /// The daylight that the illuminant is, if it is any. Up and down are known then, so that sky and ground
    /// are.
    pub daylight: Option<Daylight>,
    /// Whether that was assumed, as nobody stated it.
    pub is_daylight_assumed: bool,
    /// Irradiance by the sky that somebody stated, that by the sun being 1.
    pub sky: Option<f64>,
    /// What of the sky somebody stated beside that, if it is not alike in all directions.
    pub sky_kind: Option<SkyKind>,
    /// Irradiance by the sun of a plane that faces it, as it was stated: 1, or 0 if the sky is alone.
    pub sun: f64,
    /// Whether the sky's colour is given.
    pub has_sky_illuminant: bool,
    /// What is behind the sheet.
    pub backing: Backing,
    /// The kind of day that it is taken to have been.
    pub day: Day,
    /// What a known sheet showed of the daylight, if one did.
    pub shown: Option<ShownDaylight>,
}

/// Daylight as a photograph of a known sheet shows it, by kinds of days.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShownDaylight {
    /// How probable each kind of day is.
    pub shares: [f64; Day::ALL.len()],
    /// Reciprocal colour temperature of the sun, 1e-6/K, where it is unknown.
    pub sun: [Option<Normal>; Day::ALL.len()],
    /// The same of the sky.
    pub sky: [Option<Normal>; Day::ALL.len()],
}

impl StatedScene {
    /// Irradiance by the sky of an ideal fold as it was stated, alike in all directions, that by the sun
    /// being 1.
    #[must_use]
    pub fn even_sky(&self) -> f64 {
        self.sky.filter(|_| self.sky_kind.is_none()).unwrap_or(0.0)
    }

    /// The same of a sky with a horizon.
    #[must_use]
    pub fn sky_above_horizon(&self) -> f64 {
        self.sky.filter(|_| self.sky_kind.is_some()).unwrap_or(0.0)
    }

    /// How far above the horizon the fold opens, degrees, by the zenith that somebody stated.
    #[must_use]
    pub fn elevation_deg(&self) -> Option<f64> {
        self.sky_kind.filter(|kind| kind.is_zenith_stated).map(|kind| kind.elevation_deg)
    }

    /// How many photographs are taken on such a day, of those of which this was stated: on days with another
    /// sky, or in the sun where there is none, they are mistakes.
    #[must_use]
    pub fn share_of(&self, day: Day) -> f64 {
        if let Some(shown) = self.shown {
            return shown.shares[day as usize];
        }
        let (priors, is_sunny) = (self.priors, self.sun > 0.0);
        let mistaken = priors.mistake_share * day.usual_share(priors);
        match self.sky_kind {
            Some(SkyKind { is_overcast, .. }) if day == Day::with(is_sunny, is_overcast) => 1.0,
            Some(_) => mistaken,
            None if day.has_sun() && !is_sunny => mistaken,
            None => day.usual_share(priors),
        }
    }

    /// Logarithm of the exposure by the camera's settings, in daylight of this day; of a lamp they tell
    /// nothing.
    #[must_use]
    pub fn metered_exposure(&self) -> Option<Normal> {
        self.metered
            .filter(|_| self.daylight.is_some())
            .map(|in_the_sun| self.day.metered(self.priors, in_the_sun))
    }

    /// Whether somebody stated the exposure, rather than that a chart or a card shows it.
    #[must_use]
    pub fn is_exposure_stated(&self) -> bool {
        self.exposure.is_some() && !self.by_chart
    }
}

/// A sky with a horizon, as it was stated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyKind {
    /// Whether clouds cover it.
    pub is_overcast: bool,
    /// How far above the horizon the fold opens, degrees.
    pub elevation_deg: f64,
    /// Whether somebody said so: straight up is what nobody has to say of a computed fold.
    pub is_zenith_stated: bool,
}

/// Daylight of a reciprocal colour temperature, 1e-6/K.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Daylight {
    /// As CIE 15 has it, which people say of any.
    Cie {
        /// Of the one that was said.
        mired: f64,
    },
    /// As a sun has it that was measured or computed.
    OfSun {
        /// Of the CIE daylight that is nearest to it.
        mired: f64,
    },
}

/// The reddest daylight that CIE 15 has, 4000 K, and a bluer one than any sky's, 1e-6/K.
const MOST_MIRED: f64 = 250.0;
const LEAST_MIRED: f64 = 40.0;

/// A light is CIE daylight if that is all that it is off from one of them, relative to its mean, and the
/// sun's if that is: computed suns are off by 0.025, and by 0.05 where they stand 10° high; of lamps the
/// nearest is off by 0.27.
const CIE: f64 = 0.005;
const DAYLIGHT: f64 = 0.06;
/// The bluest daylight that people take the sun's for, 8000 K.
const BLUEST_SUN_MIRED: f64 = 125.0;

impl Daylight {
    /// The daylight that a sun of this power was said to be, if it is any; `vectors`: mean daylight and its
    /// two characteristic vectors, waveband by three.
    #[must_use]
    pub fn of(vectors: &DMatrix<f64>, sun: &DVector<f64>) -> Option<Self> {
        let sun = sun / sun.mean();
        let off = |mired: f64| {
            let daylight = Self::power(vectors, mired);
            let daylight = &daylight / daylight.mean();
            ((daylight - &sun).norm_squared() / sun.len() as f64).sqrt()
        };
        let range = (BLUEST_SUN_MIRED as u32..=MOST_MIRED as u32).map(f64::from);
        let (off, mired) = range.map(|mired| (off(mired), mired)).min_by(|a, b| a.0.total_cmp(&b.0))?;
        match off {
            CIE..DAYLIGHT => Some(Self::OfSun { mired }),
            ..CIE => Some(Self::Cie { mired }),
            _ => None,
        }
    }

    /// Relative power of daylight of a reciprocal colour temperature, from its mean and two characteristic
    /// vectors (waveband by three).
    ///
    /// # Source
    /// CIE 15:2018, section 4.1.2, not rounded.
    #[must_use]
    pub fn power(vectors: &DMatrix<f64>, mired: f64) -> DVector<f64> {
        let [m1, m2] = daylight_weights(1e6 / mired.clamp(LEAST_MIRED, MOST_MIRED));
        vectors * DVector::from_column_slice(&[1.0, m1, m2])
    }

    /// Its reciprocal colour temperature, 1e-6/K.
    #[must_use]
    pub fn mired(self) -> f64 {
        match self {
            Self::Cie { mired } | Self::OfSun { mired } => mired,
        }
    }
}
