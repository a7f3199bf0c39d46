//! Maps between a panel and the picture: a plane in perspective.
//!
//! A camera without distortion maps a flat panel to the picture by a projective map, determined by four
//! corners; its lens may distort that picture ([`super::distortion`]). Closed form: P. Heckbert,
//! *Fundamentals of Texture Mapping and Image Warping* (1989), section 2.2.3.

use nalgebra::{Matrix2, Matrix3, Vector3};

use super::distortion::Lens;
use super::point::{Point, cross};
use crate::{Error, Result};

/// The map between a panel, (u, v) in the unit square, and the picture: projective, then distorted by the
/// lens.
#[derive(Debug, Clone, PartialEq)]
pub struct Homography {
    corners: [Point; 4],
    lens: Lens,
    to_image: Matrix3<f64>,
    to_panel: Matrix3<f64>,
    /// Absolute determinant of `to_panel`.
    to_panel_scale: f64,
}

impl Homography {
    /// The map from the unit square to a quadrilateral in the picture.
    ///
    /// # Arguments
    /// - `corners`: the images of (u, v) = (0, 0), (1, 0), (1, 1), (0, 1): crease end 0, crease end 1, outer
    ///   end 1, outer end 0, in either orientation; the two panels of a fold have opposite ones.
    ///
    /// # Errors
    /// Corners that are not finite, coincide, are collinear, or do not form a convex quadrilateral in order.
    ///
    /// # Example
    /// ```
    /// use vfold::image::{Homography, Point};
    /// let corners =
    ///     [(10.0, 20.0), (110.0, 20.0), (110.0, 70.0), (10.0, 70.0)].map(|(x, y)| Point::new(x, y));
    /// let panel = Homography::from_unit_square(corners)?;
    /// assert_eq!(panel.to_image(0.5, 0.5), Point::new(60.0, 45.0));
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn from_unit_square(corners: [Point; 4]) -> Result<Self> {
        Self::through(Lens::STRAIGHT, corners)
    }

    /// The map to a picture taken through `lens`; the corners are as seen, and the sides between them may be
    /// curved.
    ///
    /// # Errors
    /// As [`Homography::from_unit_square`].
    ///
    /// # Example
    /// ```
    /// use vfold::image::{Homography, Lens, Point};
    /// let corners =
    ///     [(100.0, 20.0), (540.0, 20.0), (540.0, 460.0), (100.0, 460.0)].map(|(x, y)| Point::new(x, y));
    /// let panel = Homography::through(Lens::new([-0.02, 0.0], 640, 480)?, corners)?;
    /// assert!(panel.to_image(0.5, 0.0).y < 19.0); // a barrel bends sides outwards
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn through(lens: Lens, corners: [Point; 4]) -> Result<Self> {
        let ideal = corners.map(|corner| lens.undistort(corner));
        check_seen(&corners, &ideal)?;
        check_quadrilateral(&ideal)?;
        let to_image = square_to_quadrilateral(&ideal);
        let lie_on_a_line = || bad_corners("the corners lie on a line".to_owned());
        let to_panel = to_image.try_inverse().ok_or_else(lie_on_a_line)?;
        Ok(Self { corners, lens, to_image, to_panel, to_panel_scale: to_panel.determinant().abs() })
    }

    /// The picture's point, px, of the panel's point (u, v).
    #[must_use]
    pub fn to_image(&self, u: f64, v: f64) -> Point {
        let seen = self.to_image * Vector3::new(u, v, 1.0);
        self.lens.distort(Point::new(seen.x / seen.z, seen.y / seen.z))
    }

    /// The panel's point (u, v) at a point of the picture.
    #[must_use]
    pub fn to_panel(&self, p: Point) -> (f64, f64) {
        let (u, v, _) = self.to_panel_with_area(p);
        (u, v)
    }

    /// The corners of the panel in the picture.
    #[must_use]
    pub fn corners(&self) -> &[Point; 4] {
        &self.corners
    }

    /// The images of the corners of the panel's rectangle from `u[0]` to `u[1]` along the crease and from
    /// `v[0]` to `v[1]` away from it, in the order of the panel's own corners.
    #[must_use]
    pub fn rectangle(&self, u: [f64; 2], v: [f64; 2]) -> [Point; 4] {
        [(u[0], v[0]), (u[1], v[0]), (u[1], v[1]), (u[0], v[1])].map(|(u, v)| self.to_image(u, v))
    }

    /// The angle at which a panel with these sides is seen at its middle, degrees: 0 straight on. The camera
    /// is assumed to be distant.
    ///
    /// # Example
    /// ```
    /// use vfold::image::{Homography, Point};
    /// // a square that is half as high as wide is seen at 60 degrees
    /// let corners = [(0., 0.), (40., 0.), (40., 20.), (0., 20.)].map(|(x, y)| Point::new(x, y));
    /// assert!((Homography::from_unit_square(corners)?.view_angle_deg([1.0, 1.0]) - 60.0).abs() < 1e-9);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn view_angle_deg(&self, sides: [f64; 2]) -> f64 {
        let middle = self.to_image * Vector3::new(0.5, 0.5, 1.0);
        let way = |k: usize| {
            let way = self.to_image.column(k) * middle.z - middle * self.to_image[(2, k)];
            way.xy() / (middle.z * middle.z * sides[k])
        };
        let stretch = Matrix2::from_columns(&[way(0), way(1)]).singular_values();
        (stretch.min() / stretch.max()).acos().to_degrees()
    }

    /// Largest distance, px, of the sides of a rectangle of the panel from the straight lines between its
    /// corners.
    pub(in crate::image) fn bow(&self, u: [f64; 2], v: [f64; 2]) -> f64 {
        let corners = self.rectangle(u, v);
        let (u_middle, v_middle) = ((u[0] + u[1]) / 2.0, (v[0] + v[1]) / 2.0);
        let middles = [(u_middle, v[0]), (u[1], v_middle), (u_middle, v[1]), (u[0], v_middle)];
        let bow = |k: usize| {
            let (p, q) = (corners[k], corners[(k + 1) % 4]);
            cross(p, q, self.to_image(middles[k].0, middles[k].1)).abs() / p.distance(q)
        };
        (0..4).map(bow).fold(0.0, f64::max)
    }

    /// The panel's point (u, v) and the panel's area per pixel there, the inverse of the Jacobian
    /// determinant.
    pub(in crate::image) fn to_panel_with_area(&self, p: Point) -> (f64, f64, f64) {
        let (ideal, ideal_area) = self.lens.undistort_with_area(p);
        let place = self.to_panel * Vector3::new(ideal.x, ideal.y, 1.0);
        let inverse_scale = 1.0 / place.z;
        let area = ideal_area * self.to_panel_scale * inverse_scale * inverse_scale * inverse_scale;
        (place.x * inverse_scale, place.y * inverse_scale, area)
    }
}

/// The map from the unit square's corners (0, 0), (1, 0), (1, 1), (0, 1) to those of a quadrilateral.
#[rustfmt::skip] // a matrix has rows
pub(in crate::image) fn square_to_quadrilateral([p0, p1, p2, p3]: &[Point; 4]) -> Matrix3<f64> {
    let (ax, ay) = (p1.x - p2.x, p1.y - p2.y);
    let (bx, by) = (p3.x - p2.x, p3.y - p2.y);
    let (cx, cy) = (p0.x - p1.x + p2.x - p3.x, p0.y - p1.y + p2.y - p3.y);
    let det = ax * by - bx * ay;
    let (g, h) = ((cx * by - bx * cy) / det, (ax * cy - cx * ay) / det);
    Matrix3::new(
        p1.x - p0.x + g * p1.x, p3.x - p0.x + h * p3.x, p0.x,
        p1.y - p0.y + g * p1.y, p3.y - p0.y + h * p3.y, p0.y,
        g, h, 1.0,
    )
}

/// Corners closer than this fraction of the quadrilateral's size coincide; flatter triples are collinear.
const DEGENERATE: f64 = 1e-6;

fn check_seen(corners: &[Point; 4], ideal: &[Point; 4]) -> Result<()> {
    let is_dark = |k: &usize| corners[*k].is_finite() && !ideal[*k].is_finite();
    (0..4).find(is_dark).map_or(Ok(()), |k| {
        Err(Error::Corners {
            problem: format!("corner {} lies where the lens shows nothing", k + 1),
            remedy: "mark it within the picture, and check --distortion".to_owned(),
        })
    })
}

fn check_quadrilateral(corners: &[Point; 4]) -> Result<()> {
    if let Some(k) = corners.iter().position(|p| !p.is_finite()) {
        return Err(bad_corners(format!("corner {} is not a finite number", k + 1)));
    }
    let size = corners.iter().map(|p| p.distance(corners[0])).fold(0.0, f64::max);
    for (i, j) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
        if corners[i].distance(corners[j]) <= DEGENERATE * size {
            return Err(bad_corners(format!("corners {} and {} are the same point", i + 1, j + 1)));
        }
    }
    let turns = [0, 1, 2, 3].map(|k| cross(corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4]));
    if let Some(k) = turns.iter().position(|turn| turn.abs() <= DEGENERATE * size * size) {
        let [i, j, l] = [k, k + 1, k + 2].map(|n| n % 4 + 1);
        return Err(bad_corners(format!("corners {i}, {j} and {l} lie on a line")));
    }
    if turns.iter().any(|turn| turn.signum() != turns[0].signum()) {
        return Err(bad_corners("the sides cross or a corner points inwards".to_owned()));
    }
    Ok(())
}

fn bad_corners(problem: String) -> Error {
    Error::Corners {
        problem,
        remedy: "give the four corners of the panel in order round its edge".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn points(corners: [(f64, f64); 4]) -> [Point; 4] {
        corners.map(|(x, y)| Point::new(x, y))
    }

    fn message(corners: [(f64, f64); 4]) -> String {
        Homography::from_unit_square(points(corners)).unwrap_err().to_string()
    }

    /// Heckbert's construction inverted by hand: in a trapezoid whose far side is half as long as its near
    /// side, the middle of the square is seen at two thirds of the height, where the diagonals meet.
    #[test]
    fn the_middle_of_a_square_is_seen_where_the_diagonals_meet() {
        let panel =
            Homography::from_unit_square(points([(0.0, 0.0), (4.0, 0.0), (3.0, 3.0), (1.0, 3.0)])).unwrap();
        let middle = panel.to_image(0.5, 0.5);
        assert!(middle.distance(Point::new(2.0, 2.0)) < 1e-14, "{middle:?}");
    }

    #[test]
    fn bad_corners_are_named() {
        let nan = f64::NAN;
        assert!(message([(0.0, 0.0), (1.0, nan), (1.0, 1.0), (0.0, 1.0)]).contains("corner 2"));
        assert!(
            message([(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (9.0, 9.0)])
                .contains("corners 3 and 4 are the same")
        );
        assert!(
            message([(0.0, 0.0), (5.0, 0.0), (9.0, 0.0), (0.0, 9.0)])
                .contains("corners 1, 2 and 3 lie on a line")
        );
        assert!(message([(0.0, 0.0), (9.0, 9.0), (9.0, 0.0), (0.0, 9.0)]).contains("cross"));
        assert!(message([(0.0, 0.0), (9.0, 0.0), (2.0, 2.0), (0.0, 9.0)]).contains("inwards"));
    }

    /// A convex quadrilateral of any size and orientation: one point near each corner of a square, mirrored
    /// or not.
    fn quadrilateral() -> impl Strategy<Value = [Point; 4]> {
        (prop::array::uniform8(-0.24..0.24), 1.0..5000.0, any::<bool>()).prop_map(|(d, size, mirrored)| {
            let mut corners = points([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
            for (k, p) in corners.iter_mut().enumerate() {
                *p = Point::new((p.x + d[2 * k] + 1.0) * size, (p.y + d[2 * k + 1] + 1.0) * size);
            }
            if mirrored {
                corners.reverse();
            }
            corners
        })
    }

    proptest! {
        #[test]
        fn there_and_back(corners in quadrilateral(), u in 0.0..1.0, v in 0.0..1.0) {
            let panel = Homography::from_unit_square(corners).unwrap();
            let (u2, v2) = panel.to_panel(panel.to_image(u, v));
            prop_assert!((u - u2).abs() < 1e-10 && (v - v2).abs() < 1e-10, "({u}, {v}) became ({u2}, {v2})");
            for (got, want) in panel.rectangle([0.0, 1.0], [0.0, 1.0]).iter().zip(&corners) {
                prop_assert!(got.distance(*want) < 1e-9 * want.x.abs().max(want.y.abs()));
            }
        }

        /// Against central differences of the map itself, pixels per area of the panel.
        #[test]
        fn a_pixels_area_is_that_of_the_derivative(corners in quadrilateral(), u in 0.1..0.9, v in 0.1..0.9) {
            let panel = Homography::from_unit_square(corners).unwrap();
            let step = 1e-5;
            let (left, right) = (panel.to_image(u - step, v), panel.to_image(u + step, v));
            let (low, high) = (panel.to_image(u, v - step), panel.to_image(u, v + step));
            let numeric = ((right.x - left.x) * (high.y - low.y)
                - (right.y - left.y) * (high.x - low.x))
                / (4.0 * step * step);
            let (_, _, area) = panel.to_panel_with_area(panel.to_image(u, v));
            prop_assert!((area * numeric.abs() - 1.0).abs() < 1e-5, "{area} {numeric}");
        }
    }
}
