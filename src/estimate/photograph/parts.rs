//! Ingredients of the facets of a photograph: light of each kind, as a function of the sheet's albedo.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::conditions::{Conditions, Daylight, StatedScene};
use super::eye::{Eye, errors};
pub use super::sheets::Radiance;
use super::sheets::Sheets;
use crate::solve::dense::add;

/// Position of a facet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Panel.
    pub panel: usize,
    /// Distance from the crease, in panel depths.
    pub depth: f64,
    /// Position along the crease, in panel depths.
    pub along: f64,
    /// Squared distance from the picture's centre, relative to that of the picture's corners.
    pub off_centre: f64,
}

/// A change of the fold, tabulated at some sizes other than zero; in between it is a polynomial in its size.
#[derive(Clone, Debug)]
pub struct Change {
    /// Nonzero sizes, and the effect of each on the facets.
    pub known: Vec<(f64, Radiance)>,
}

impl Change {
    /// Adds the effect of a change of this size on this amount of light.
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

/// The fold in sunlight.
#[derive(Clone, Debug)]
pub struct Sunlit {
    /// For a sun on the bisecting plane, per unit of the cosine of its tilt.
    pub even: Radiance,
    /// Addition per unit of the sine of its tilt.
    pub odd: Radiance,
    /// Difference between the angle and the stated one, degrees.
    pub angle_deg: Change,
    /// Radius of the crease, in panel depths.
    pub crease_radius: Change,
    /// Bow of both panels, degrees.
    pub bow_deg: Change,
    /// Bow of panel 0 and the opposite bow of panel 1, degrees.
    pub bow_difference_deg: Change,
    /// Panel depth divided by the distance of a lamp in the sun's place.
    pub nearness: Change,
}

/// Elevations of the direction in which the fold opens, degrees, at which light of the surroundings is
/// tabulated.
pub const ELEVATIONS_DEG: [f64; 3] = [15.0, 45.0, 75.0];

/// Light other than the sun's, at each of [`ELEVATIONS_DEG`].
#[derive(Clone, Debug)]
pub struct Ambient {
    /// The facets, for irradiance 1 on an open plane facing the source.
    pub radiance: [Radiance; 3],
    /// Irradiance of an open plane facing as the fold does.
    pub open: [f64; 3],
    /// Change of the facets per degree of angle between the panels.
    pub by_angle: Radiance,
    /// Change with the radius of the crease.
    pub crease_radius: Change,
    /// Change per degree of bow of both panels.
    pub by_bow: Radiance,
}

/// All light of the surroundings.
#[derive(Clone, Debug)]
pub struct Surroundings {
    /// From a clear sky.
    pub clear: Ambient,
    /// From an overcast sky.
    pub overcast: Ambient,
    /// From the ground.
    pub ground: Ambient,
}

/// Interpolation weights of [`ELEVATIONS_DEG`] at an elevation.
#[must_use]
pub fn shares_at(elevation_deg: f64) -> [f64; 3] {
    lagrange(ELEVATIONS_DEG, elevation_deg.clamp(0.0, 90.0))
}

/// Interpolation weights of three nodes at `x`.
#[must_use]
pub fn lagrange(nodes: [f64; 3], x: f64) -> [f64; 3] {
    [0, 1, 2].map(|at| {
        let [own, a, b] = [0, 1, 2].map(|n| nodes[(at + n) % 3]);
        (x - a) * (x - b) / ((own - a) * (own - b))
    })
}

impl Ambient {
    /// Irradiance on an open plane facing as the fold does.
    #[must_use]
    pub fn open_at(&self, shares: [f64; 3]) -> f64 {
        self.open.iter().zip(shares).map(|(open, share)| open * share).sum()
    }

    /// Adds this amount of it to the light on the facets of a fold whose stated angle is `stated_deg`.
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

/// All ingredients. The same fold in another light shares everything that does not depend on the light.
#[derive(Clone, Debug)]
pub struct Parts {
    /// The stated properties of the photograph.
    pub stated: StatedScene,
    /// Positions of the facets.
    pub places: Vec<Place>,
    /// Their values: facet by channel.
    pub values: DMatrix<f64>,
    /// Standard deviations of their noise.
    pub sd: DMatrix<f64>,
    /// Light of the sun.
    pub sun: Arc<Sunlit>,
    /// Uniform light, for irradiance 1 on an open plane.
    pub even_sky: Radiance,
    /// Light of sky and ground.
    pub surroundings: Arc<Surroundings>,
    /// Sheet models.
    pub sheets: Arc<Sheets>,
    /// The camera.
    pub eye: Eye,
}

impl Parts {
    /// The same in a stated light of this power.
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

    /// The same, taken by a camera with these sensitivities, one number per waveband for each channel, and
    /// errors of them.
    #[must_use]
    pub fn taken_by(&self, sensitivities: &[Vec<f64>]) -> Self {
        let Self { eye, stated, .. } = self;
        let errors = errors(sensitivities, &eye.wavelengths_nm, &eye.widths_nm, stated.priors);
        Self { eye: eye.with(sensitivities, errors), ..self.clone() }
    }

    /// The same, taken by a camera with exactly these sensitivities.
    #[must_use]
    pub fn taken_exactly_by(&self, sensitivities: &[Vec<f64>]) -> Self {
        Self { eye: self.eye.with(sensitivities, Vec::new()), ..self.clone() }
    }

    /// The same in unstated daylight.
    #[must_use]
    pub fn in_any_daylight(&self) -> Self {
        let power = Daylight::power(&self.eye.daylight, self.stated.priors.sun_mired);
        let mut lit = self.in_light(power.as_slice());
        lit.stated.is_daylight_assumed = true;
        lit
    }

    /// The same with light from a lamp alone, whatever its colour, without sky and ground.
    #[must_use]
    pub fn without_sky(mut self) -> Self {
        self.stated.daylight = None;
        self
    }
}
