//! What the facets of a photograph are made of: light of each kind, as functions of the sheet's albedo.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::conditions::{Conditions, Daylight, StatedScene};
use super::sheets::Sheets;
pub use super::sums::Radiance;
use super::sums::add;

/// Where a facet is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Panel.
    pub panel: usize,
    /// Distance from the crease, in depths of the panel.
    pub depth: f64,
    /// Place along the crease, in depths of the panel.
    pub along: f64,
    /// Square of the distance from the picture's centre, that of a corner being 1.
    pub off_centre: f64,
}

/// A change of the fold, known at some sizes beside none: between them it is a polynomial of its size.
#[derive(Clone, Debug)]
pub struct Change {
    /// Sizes, none of them zero, and what each does to the facets.
    pub known: Vec<(f64, Radiance)>,
}

impl Change {
    /// Adds what a change of this size does to so much light.
    pub fn add_to(&self, sum: &mut Radiance, amount: f64, size: f64) {
        for (n, (own, radiance)) in self.known.iter().enumerate() {
            let others =
                self.known.iter().enumerate().filter(|(other, _)| *other != n).map(|(_, (other, _))| other);
            let share =
                others.fold(amount * size / own, |share, other| share * (size - other) / (own - other));
            if share != 0.0 {
                add(sum.as_mut_slice(), share, radiance.as_slice());
            }
        }
    }
}

/// The fold as the sun lights it.
#[derive(Clone, Debug)]
pub struct Sunlit {
    /// A sun on the bisecting plane, for each unit of the cosine of its tilt.
    pub even: Radiance,
    /// What is added for each unit of the sine of its tilt.
    pub odd: Radiance,
    /// More degrees between the panels than was said.
    pub angle_deg: Change,
    /// The radius of the crease, in depths of the panels.
    pub crease_radius: Change,
    /// Bow of both panels, degrees.
    pub bow_deg: Change,
    /// Bow of panel 0 and the opposite of panel 1, degrees.
    pub bow_difference_deg: Change,
    /// Depth of a panel over the distance of a lamp that stands in the sun's place.
    pub nearness: Change,
}

/// Elevations above the horizon of the direction to which the fold opens, degrees, at which light of the
/// surroundings is known.
pub const ELEVATIONS_DEG: [f64; 3] = [15.0, 45.0, 75.0];

/// Light that is not the sun's, at each of [`ELEVATIONS_DEG`].
#[derive(Clone, Debug)]
pub struct Ambient {
    /// The facets, for an irradiance of 1 on an open plane that faces the source.
    pub radiance: [Radiance; 3],
    /// Irradiance of an open plane that faces the way the fold does.
    pub open: [f64; 3],
    /// What the facets have more for each degree between the panels.
    pub by_angle: Radiance,
    /// For the radius of the crease.
    pub crease_radius: Change,
    /// For each degree of bow of both panels.
    pub by_bow: Radiance,
}

/// All of it.
#[derive(Clone, Debug)]
pub struct Surroundings {
    /// Of a clear sky.
    pub clear: Ambient,
    /// Of an overcast one.
    pub overcast: Ambient,
    /// Of the ground.
    pub ground: Ambient,
}

/// Shares of [`ELEVATIONS_DEG`] at an elevation.
#[must_use]
pub fn shares_at(elevation_deg: f64) -> [f64; 3] {
    lagrange(ELEVATIONS_DEG, elevation_deg.clamp(0.0, 90.0))
}

/// Shares of three nodes at `x`.
#[must_use]
pub fn lagrange(nodes: [f64; 3], x: f64) -> [f64; 3] {
    [0, 1, 2].map(|at| {
        let [own, a, b] = [0, 1, 2].map(|n| nodes[(at + n) % 3]);
        (x - a) * (x - b) / ((own - a) * (own - b))
    })
}

impl Ambient {
    /// What it gives an open plane that faces the way the fold does.
    #[must_use]
    pub fn open_at(&self, shares: [f64; 3]) -> f64 {
        self.open.iter().zip(shares).map(|(open, share)| open * share).sum()
    }

    /// Adds so much of it to the light on the facets of a fold that is open by `stated_deg` if it is as it
    /// was said to be.
    pub fn add_to(&self, sum: &mut Radiance, amount: f64, conditions: &Conditions, stated_deg: f64) {
        let shares = shares_at(conditions.elevation_deg);
        let changes =
            [(&self.by_angle, conditions.angle_deg - stated_deg), (&self.by_bow, conditions.bow_deg)];
        for (radiance, share) in self.radiance.iter().zip(shares).chain(changes) {
            if amount * share != 0.0 {
                add(sum.as_mut_slice(), amount * share, radiance.as_slice());
            }
        }
        self.crease_radius.add_to(sum, amount, conditions.crease_radius);
    }
}

/// How the camera sees light of any spectrum.
#[derive(Clone, Debug)]
pub struct Eye {
    /// Wavelengths, nm.
    pub wavelengths_nm: Vec<f64>,
    /// Sensitivity times the width of the waveband: waveband by channel.
    pub sensitivities: DMatrix<f64>,
    /// How the sensitivities may be off, in units of a standard deviation: error by waveband, with its
    /// channel.
    pub errors: Vec<(usize, DVector<f64>)>,
    /// Whether the curves are another camera's, which stands in for it.
    pub is_stand_in: bool,
    /// Power of the sun as it was said to be.
    pub sun: DVector<f64>,
    /// Power of the sky as it was said to be.
    pub sky: DVector<f64>,
    /// Mean daylight and its two characteristic vectors: waveband by three.
    pub daylight: DMatrix<f64>,
    /// The channel in which white is 1.
    pub reference: usize,
}

impl Eye {
    /// Whether it is the same camera, as far as its curves tell.
    #[must_use]
    pub fn is(&self, other: &Self) -> bool {
        (&self.wavelengths_nm, &self.sensitivities) == (&other.wavelengths_nm, &other.sensitivities)
            && self.errors == other.errors
    }
}

/// All of it. The same fold in another light shares what does not depend on that.
#[derive(Clone, Debug)]
pub struct Parts {
    /// What was said of the photograph.
    pub stated: StatedScene,
    /// Where the facets are.
    pub places: Vec<Place>,
    /// Their values: facet by channel.
    pub values: DMatrix<f64>,
    /// Standard deviations of their noise.
    pub sd: DMatrix<f64>,
    /// Light of the sun.
    pub sun: Arc<Sunlit>,
    /// Light that is alike in all directions, for an irradiance of 1 on an open plane.
    pub even_sky: Radiance,
    /// Light of sky and ground.
    pub surroundings: Arc<Surroundings>,
    /// Kinds of sheets.
    pub sheets: Arc<Sheets>,
    /// The camera.
    pub eye: Eye,
}

impl Parts {
    /// The same in a light of this power, which somebody said.
    #[must_use]
    pub fn in_light(&self, power: &[f64]) -> Self {
        let sun = DVector::from_column_slice(power);
        let mut lit = self.clone();
        lit.stated.daylight = Daylight::of(&lit.eye.daylight, &sun);
        lit.stated.is_daylight_assumed = false;
        lit.eye.reference = lit.eye.sensitivities.tr_mul(&sun).imax();
        (lit.eye.sun, lit.eye.sky) = (sun.clone(), sun);
        lit
    }

    /// The same in daylight that nobody stated.
    #[must_use]
    pub fn in_any_daylight(&self) -> Self {
        let power = Daylight::power(&self.eye.daylight, self.stated.priors.sun_mired);
        let mut lit = self.in_light(power.as_slice());
        lit.stated.is_daylight_assumed = true;
        lit
    }

    /// The same where light comes from one lamp, whatever its colour, and neither from a sky nor from the
    /// ground.
    #[must_use]
    pub fn without_sky(mut self) -> Self {
        self.stated.daylight = None;
        self
    }
}
