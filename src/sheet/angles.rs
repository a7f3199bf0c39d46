//! The angles that determine an isotropic reflection.

use nalgebra::Vector3;

use super::fresnel::fresnel;
use super::place::Place;

/// Smallest cosine of incidence and exit: below it fits and lobes grow without bound.
const COS_MIN: f64 = 1e-3;

/// Directions in which light arrives at a sheet and leaves it.
#[derive(Clone, Copy, Debug)]
pub struct Angles {
    /// Cosine between the normal and the direction towards the light, (0, 1].
    pub cos_in: f64,
    /// Cosine between the normal and the direction towards the eye, (0, 1].
    pub cos_out: f64,
    /// Cosine between the two directions.
    pub cos_between: f64,
    /// Position in the grid of a table.
    pub(super) place: Place,
    /// Fresnel reflectance for incoming and for outgoing light, and for light mirrored by microfacets from
    /// one direction to the other.
    pub(super) fresnel: [f64; 3],
}

/// Many pairs of directions, stored number by number, so that reflections of several are computed at once.
#[derive(Clone, Debug, Default)]
pub struct AngleList {
    pub(super) cos_in: Vec<f64>,
    pub(super) cos_out: Vec<f64>,
    pub(super) cos_between: Vec<f64>,
    pub(super) places: Vec<Place>,
    pub(super) fresnel: [Vec<f64>; 3],
}

impl AngleList {
    /// Number of pairs.
    pub(super) fn len(&self) -> usize {
        self.places.len()
    }
}

impl Extend<Angles> for AngleList {
    fn extend<I: IntoIterator<Item = Angles>>(&mut self, more: I) {
        for Angles { cos_in, cos_out, cos_between, place, fresnel } in more {
            self.cos_in.push(cos_in);
            self.cos_out.push(cos_out);
            self.cos_between.push(cos_between);
            self.places.push(place);
            self.fresnel.iter_mut().zip(fresnel).for_each(|(values, value)| values.push(value));
        }
    }
}

impl FromIterator<Angles> for AngleList {
    fn from_iter<I: IntoIterator<Item = Angles>>(all: I) -> Self {
        let mut list = Self::default();
        list.extend(all);
        list
    }
}

impl Angles {
    /// From unit vectors towards the light and towards the eye, with z along the normal of the sheet.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use vfold::sheet::Angles;
    /// let angles = Angles::new(&Vector3::new(0.6, 0.0, 0.8), &Vector3::z());
    /// assert_eq!([angles.cos_in, angles.cos_out, angles.cos_between], [0.8, 1.0, 0.8]);
    /// ```
    #[must_use]
    pub fn new(to_light: &Vector3<f64>, to_eye: &Vector3<f64>) -> Self {
        let [cos_in, cos_out] = [to_light, to_eye].map(|direction| direction.z.clamp(COS_MIN, 1.0));
        let cos_between = to_light.dot(to_eye).clamp(-1.0, 1.0);
        let cos_apart = (0.5 * (1.0 + cos_between)).sqrt();
        Self {
            cos_in,
            cos_out,
            cos_between,
            place: Place::of(cos_in, cos_out, cos_between),
            fresnel: [cos_in, cos_out, cos_apart].map(fresnel),
        }
    }

    /// Light from 45 degrees, seen along the normal, as in spectrophotometers.
    #[must_use]
    pub fn instrument() -> Self {
        let half = 0.5_f64.sqrt();
        Self::new(&Vector3::new(half, 0.0, half), &Vector3::z())
    }
}
