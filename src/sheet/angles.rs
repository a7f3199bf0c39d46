//! The angles that an isotropic reflection depends on.

use nalgebra::Vector3;

use super::fresnel::fresnel;
use super::place::Place;

/// Least cosine of incidence and exit: below it fits and lobes grow without bounds.
const COS_MIN: f64 = 1e-3;

/// How light comes to a sheet and leaves it.
#[derive(Clone, Copy, Debug)]
pub struct Angles {
    /// Cosine between the normal and where the light comes from, (0, 1].
    pub cos_in: f64,
    /// Cosine between the normal and where it goes, (0, 1].
    pub cos_out: f64,
    /// Cosine between both directions.
    pub cos_between: f64,
    /// Where a table has them.
    pub(super) place: Place,
    /// What a smooth surface reflects of light that comes in, that leaves, and of light that its facets
    /// mirror from one to the other.
    pub(super) fresnel: [f64; 3],
}

impl Angles {
    /// Those of two directions of length 1 away from the sheet, z along its normal: towards the light and
    /// towards the eye.
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

    /// Light from 45 degrees, seen from above, as spectrophotometers have it.
    #[must_use]
    pub fn instrument() -> Self {
        let half = 0.5_f64.sqrt();
        Self::new(&Vector3::new(half, 0.0, half), &Vector3::z())
    }

    /// Product of the directions' parts along the sheet: sines of both angles times the cosine of the azimuth
    /// between them.
    #[must_use]
    pub fn along_sheet(&self) -> f64 {
        self.cos_between - self.cos_in * self.cos_out
    }
}
