//! What the facets of a photograph are made of: light of each kind, as functions of the sheet's albedo.

use nalgebra::{DMatrix, DVector};

use super::conditions::Told;
use super::sheets::Sheets;
use super::sums::add;

/// Radiance of all facets at the nodes of albedo: facet by node.
pub type Radiance = DMatrix<f64>;

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
    /// Adds what a change of this size does.
    pub fn add_to(&self, sum: &mut Radiance, size: f64) {
        for (n, (own, radiance)) in self.known.iter().enumerate() {
            let others =
                self.known.iter().enumerate().filter(|(other, _)| *other != n).map(|(_, (other, _))| other);
            let share = others.fold(size / own, |share, other| share * (size - other) / (own - other));
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
}

/// Light that is not the sun's.
#[derive(Clone, Debug)]
pub struct Ambient {
    /// The facets, for an irradiance of 1 on an open plane that faces the source.
    pub radiance: Radiance,
    /// Irradiance of an open plane that faces the sun.
    pub open: f64,
}

/// How the camera sees light of any spectrum.
#[derive(Clone, Debug)]
pub struct Eye {
    /// Wavelengths, nm.
    pub wavelengths_nm: Vec<f64>,
    /// Sensitivity times the width of the waveband: waveband by channel.
    pub sensitivities: DMatrix<f64>,
    /// How the sensitivities may be off, in units of a standard deviation: error by waveband, with its channel.
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

/// All of it.
#[derive(Clone, Debug)]
pub struct Parts {
    /// What was said of the photograph.
    pub told: Told,
    /// Where the facets are.
    pub places: Vec<Place>,
    /// Their values: facet by channel.
    pub values: DMatrix<f64>,
    /// Standard deviations of their noise.
    pub sd: DMatrix<f64>,
    /// Light of the sun.
    pub sun: Sunlit,
    /// Light of the sky that was told, if any was.
    pub told_sky: Option<Radiance>,
    /// Light of the sky.
    pub sky: Ambient,
    /// Light of the ground.
    pub ground: Ambient,
    /// Sine of the sun's height.
    pub sun_height: f64,
    /// Kinds of sheets.
    pub sheets: Sheets,
    /// The camera.
    pub eye: Eye,
}
