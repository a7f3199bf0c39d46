//! The conditions of a photograph.

use std::iter;

use nalgebra::{DMatrix, DVector};

use super::day::Day;
use super::priors::Priors;
use crate::estimate::emission::Backing;
use crate::estimate::unknowns::Normal;
use crate::solve::dense::rms;
use crate::spectrum::daylight_weights;

/// Everything that determines the facets of a photograph, apart from the spectrum and the sheet model.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    /// Value in the strongest channel of a perfect white diffuser facing the sun, or of a chart in the light
    /// of sun and sky.
    pub exposure: f64,
    /// Gains of the first and the last of three channels relative to the second.
    pub gains: [f64; 2],
    /// Angle between the panels, degrees.
    pub angle_deg: f64,
    /// Angle of the sun off the bisecting plane, degrees.
    pub tilt_deg: f64,
    /// Reciprocal colour temperature of the sun, 1e-6/K, if it is daylight.
    pub sun_mired: Option<f64>,
    /// The kind of day.
    pub day: Day,
    /// Irradiance from the sun on a plane facing it; 1 unless the sun is hidden.
    pub sun: f64,
    /// Irradiance from the sky on an open horizontal plane; 1 if the sun is hidden.
    pub sky: f64,
    /// Share of the sky's light that has the distribution of an overcast sky.
    pub cloud: f64,
    /// Elevation above the horizon of the direction in which the fold opens, degrees.
    pub elevation_deg: f64,
    /// Irradiance on an open plane from uniform light.
    pub even_sky: f64,
    /// Reciprocal colour temperature of the sky, 1e-6/K; `None` if its colour is stated.
    pub sky_mired: Option<f64>,
    /// Reflectance of the ground at 550 nm.
    pub ground: f64,
    /// Rise of the ground's reflectance over 150 nm, relative to that at 550 nm.
    pub ground_redness: f64,
    /// Radius of the rounded crease, in depths of the panels.
    pub crease_radius: f64,
    /// Turn of both panels over their depth, degrees.
    pub bow_deg: f64,
    /// Excess of the turn of panel 0 over the mean of both, degrees; panel 1 has as much less.
    pub bow_difference_deg: f64,
    /// Panel depth divided by the distance of the lamp that lights the sheet; 0 for the sun.
    pub nearness: f64,
    /// Loss of light from end 0 to end 1 of the crease, relative to the middle.
    pub fall_off: f64,
    /// Share of the light lost by the lens in the corners of the picture.
    pub vignetting: f64,
    /// Veiling glare: share of the picture's mean light that the lens spreads evenly over it.
    pub veiling_glare: f64,
    /// Specular weight: strength of the surface's reflection, relative to a bare surface of refractive
    /// index 1.5.
    pub specular_weight: f64,
    /// Specular roughness: α of the GGX microfacet distribution.
    pub specular_roughness: f64,
    /// Body roughness: σ of Oren and Nayar's model, degrees.
    pub body_roughness_deg: f64,
    /// Sheen: brightening of the body at grazing incidence or viewing.
    pub sheen: f64,
}

impl Conditions {
    /// Whether sky and ground light the facets as under `other` conditions, in whatever amounts and colours.
    pub(super) fn distribute_alike(&self, other: &Self) -> bool {
        let places = |of: &Self| [of.cloud, of.elevation_deg, of.angle_deg, of.bow_deg, of.crease_radius];
        let has_even_sky = |of: &Self| of.even_sky > 0.0;
        iter::zip(places(self), places(other)).all(|(a, b)| a.total_cmp(&b).is_eq())
            && has_even_sky(self) == has_even_sky(other)
    }
}

/// Everything stated about a photograph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedScene {
    /// The priors in use.
    pub priors: &'static Priors,
    /// The exposure, if it is known.
    pub exposure: Option<f64>,
    /// Logarithm of the exposure in an unclouded sun, from the camera's settings, if they are known.
    pub metered: Option<Normal>,
    /// Logarithm of the exposure in the light of sun and sky, from white paper, if there is any.
    pub by_paper: Option<Normal>,
    /// True if a chart or a card in the light of sun and sky gave the exposure and balanced the channels.
    pub by_chart: bool,
    /// Number of channels.
    pub channels: usize,
    /// Angle between the panels, degrees.
    pub angle_deg: f64,
    /// Its standard deviation, degrees.
    pub angle_sd_deg: f64,
    /// Angle of the sun off the bisecting plane, degrees.
    pub tilt_deg: f64,
    /// The illuminant as daylight, if it is one. The orientation is known then, and with it sky and ground.
    pub daylight: Option<Daylight>,
    /// True if the illuminant was assumed, because none was stated.
    pub is_daylight_assumed: bool,
    /// Stated irradiance from the sky, relative to the sun's.
    pub sky: Option<f64>,
    /// Other stated properties of the sky, if it is not uniform.
    pub sky_kind: Option<SkyKind>,
    /// Stated irradiance from the sun on a plane facing it: 1, or 0 if there is only a sky.
    pub sun: f64,
    /// True if the sky's colour is stated.
    pub has_sky_illuminant: bool,
    /// What is behind the sheet.
    pub backing: Backing,
    /// The assumed kind of day.
    pub day: Day,
    /// The daylight inferred from a known sheet, if there is one.
    pub shown: Option<ShownDaylight>,
}

/// Daylight inferred from a photograph of a known sheet, for each kind of day.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShownDaylight {
    /// Probability of each kind of day.
    pub shares: [f64; Day::ALL.len()],
    /// Reciprocal colour temperature of the sun, 1e-6/K, where it is unknown.
    pub sun: [Option<Normal>; Day::ALL.len()],
    /// The same for the sky.
    pub sky: [Option<Normal>; Day::ALL.len()],
}

impl StatedScene {
    /// Irradiance from a uniform sky on an ideal fold, as stated, relative to the sun's.
    #[must_use]
    pub fn even_sky(&self) -> f64 {
        self.sky.filter(|_| self.sky_kind.is_none()).unwrap_or(0.0)
    }

    /// The same for a sky with a horizon.
    #[must_use]
    pub fn sky_above_horizon(&self) -> f64 {
        self.sky.filter(|_| self.sky_kind.is_some()).unwrap_or(0.0)
    }

    /// Elevation of the direction in which the fold opens, degrees, if the zenith was stated.
    #[must_use]
    pub fn elevation_deg(&self) -> Option<f64> {
        self.sky_kind.filter(|kind| kind.is_zenith_stated).map(|kind| kind.elevation_deg)
    }

    /// Probability of this kind of day, given the statement: days with another sky, or with sun where none
    /// was stated, are mistakes.
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

    /// True if the exposure is that of all the light, rather than of the sun alone.
    #[must_use]
    pub fn is_exposure_of_all_light(&self) -> bool {
        self.by_chart || (self.exposure.is_none() && self.by_paper.is_some())
    }

    /// Logarithm of the exposure from the camera's settings, in daylight of this day; they reveal nothing
    /// about lamps.
    #[must_use]
    pub fn metered_exposure(&self) -> Option<Normal> {
        self.metered
            .filter(|_| self.daylight.is_some())
            .map(|in_the_sun| self.day.metered(self.priors, in_the_sun))
    }

    /// True if the exposure was stated, rather than given by a chart or a card.
    #[must_use]
    pub fn is_exposure_stated(&self) -> bool {
        self.exposure.is_some() && !self.by_chart
    }
}

/// A stated sky with a horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyKind {
    /// True if it is covered by clouds.
    pub is_overcast: bool,
    /// Elevation above the horizon of the direction in which the fold opens, degrees.
    pub elevation_deg: f64,
    /// True if the zenith was stated; for a computed fold straight up is the default.
    pub is_zenith_stated: bool,
}

/// A light that is daylight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Daylight {
    /// Reciprocal colour temperature of the nearest CIE 15 daylight, 1e-6/K.
    pub mired: f64,
    /// True for that daylight itself, which users state for any; else it is measured or computed sunlight.
    pub is_cie: bool,
}

/// The reddest daylight of CIE 15, 4000 K, and one bluer than any sky, 1e-6/K.
const MOST_MIRED: f64 = 250.0;
const LEAST_MIRED: f64 = 40.0;

/// A light is CIE daylight if it differs from one by less than the first of these, relative to its mean, and
/// the sun's if by less than the second. Computed suns differ by 0.025, and by 0.05 at an elevation of 10°;
/// the nearest lamp by 0.27.
const CIE: f64 = 0.005;
const DAYLIGHT: f64 = 0.06;
/// The bluest daylight taken for the sun's, 8000 K.
const BLUEST_SUN_MIRED: f64 = 125.0;

impl Daylight {
    /// The daylight that a sun with this power stands for, if it is any; `vectors`: mean daylight and its two
    /// characteristic vectors, waveband by three.
    #[must_use]
    pub fn of(vectors: &DMatrix<f64>, sun: &DVector<f64>) -> Option<Self> {
        let sun = sun / sun.mean();
        let off = |mired: f64| {
            let daylight = Self::power(vectors, mired);
            let daylight = &daylight / daylight.mean();
            rms(&(daylight - &sun))
        };
        let range = (BLUEST_SUN_MIRED as u32..=MOST_MIRED as u32).map(f64::from);
        let (off, mired) = range.map(|mired| (off(mired), mired)).min_by(|a, b| a.0.total_cmp(&b.0))?;
        (off < DAYLIGHT).then_some(Self { mired, is_cie: off < CIE })
    }

    /// Relative power of daylight with a reciprocal colour temperature, from mean daylight and its two
    /// characteristic vectors (waveband by three).
    ///
    /// # Source
    /// CIE 15:2018, section 4.1.2, not rounded.
    #[must_use]
    pub fn power(vectors: &DMatrix<f64>, mired: f64) -> DVector<f64> {
        let [m1, m2] = daylight_weights(1e6 / mired.clamp(LEAST_MIRED, MOST_MIRED));
        vectors * DVector::from_column_slice(&[1.0, m1, m2])
    }
}
