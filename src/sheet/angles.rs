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

    /// Dot product of the directions' projections onto the sheet: the sines of both angles times the cosine
    /// of the azimuth between them.
    #[must_use]
    pub fn along_sheet(&self) -> f64 {
        self.cos_between - self.cos_in * self.cos_out
    }
}
