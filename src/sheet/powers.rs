//! Light reflected once or twice by a sheet, as powers of its albedo.

use super::Shape;

/// Number of powers, from 0 on: of light reflected twice at most.
pub const POWERS: usize = 3;

impl Shape {
    /// One reflection, of which body and surface are given: factors of the [powers](POWERS) of the albedo.
    ///
    /// # Example
    /// ```
    /// use vfold::sheet::{Angles, Family, Shape};
    /// let shape = Shape::from(Family { specular_weight: 0.5, roughness: 0.4, ..Family::default() });
    /// let angles = Angles::instrument();
    /// let [none, one, _] = shape.once(shape.at(&angles));
    /// assert!((none + one * 0.3 - shape.brdf(0.3, &angles)).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn once(&self, [body, surface]: [f64; 2]) -> [f64; POWERS] {
        let [slope, offset] = self.slope_and_offset();
        [offset * body + surface, slope * body, 0.0]
    }

    /// Two reflections, given the sums over their paths of the products of both bodies, of the body of one
    /// and the surface of the other, and of both surfaces: factors of the [powers](POWERS) of the albedo.
    ///
    /// # Example
    /// ```
    /// use vfold::sheet::Shape;
    /// assert_eq!(Shape::lambertian().twice([1.0, 0.0, 0.0]), [0.0, 0.0, 1.0]);
    /// ```
    #[must_use]
    pub fn twice(&self, [bodies, body, surfaces]: [f64; 3]) -> [f64; POWERS] {
        let [slope, offset] = self.slope_and_offset();
        [
            offset * (offset * bodies + body) + surfaces,
            slope * (2.0 * offset * bodies + body),
            slope * slope * bodies,
        ]
    }
}
