//! Flat convex polygons: area, centroid, normal, and clipping by a plane.

use smallvec::SmallVec;

use crate::geometry::Vec3;

/// Corners of a polygon, most of which are quadrilaterals.
pub type Corners = SmallVec<[Vec3; 6]>;

/// A flat convex polygon, its corners counter-clockwise seen from the side of its normal.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    corners: Corners,
    normal: Vec3,
    area: f64,
}

/// A plane: points `x` with `normal · x = offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Normal, of any length.
    pub normal: Vec3,
    /// `normal · x` of its points.
    pub offset: f64,
}

impl Plane {
    /// Distance of a point in front of the plane, in units of the normal's length; negative behind it.
    #[must_use]
    pub fn height(&self, point: &Vec3) -> f64 {
        self.normal.dot(point) - self.offset
    }

    /// A parallel plane in front of this one.
    #[must_use]
    pub fn raised(&self, height: f64) -> Self {
        Self { offset: self.offset + height, ..*self }
    }

    /// The same plane seen from behind.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { normal: -self.normal, offset: -self.offset }
    }
}

impl Polygon {
    /// A polygon with these corners.
    #[must_use]
    pub fn new(corners: &[Vec3]) -> Self {
        let spin = spin(corners);
        let length = spin.norm();
        Self { corners: corners.into(), normal: spin / length, area: 0.5 * length }
    }

    /// Corners in order.
    #[must_use]
    pub fn corners(&self) -> &[Vec3] {
        &self.corners
    }

    /// Sides from corner to corner.
    pub fn edges(&self) -> impl Iterator<Item = (Vec3, Vec3)> + '_ {
        edges(&self.corners)
    }

    /// Unit normal on the reflecting side; NaN if the area is zero.
    #[must_use]
    pub fn normal(&self) -> Vec3 {
        self.normal
    }

    /// Area in the unit of the corners squared.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Its plane.
    #[must_use]
    pub fn plane(&self) -> Plane {
        let middle = self.corners.iter().sum::<Vec3>() / self.corners.len() as f64;
        Plane { normal: self.normal, offset: self.normal.dot(&middle) }
    }

    /// Centre of its area.
    #[must_use]
    pub fn centroid(&self) -> Vec3 {
        let first = self.corners[0];
        let (mut weighted, mut total) = (Vec3::zeros(), 0.0);
        for pair in self.corners[1..].windows(2) {
            let area = (pair[0] - first).cross(&(pair[1] - first)).dot(&self.normal);
            weighted += area * (first + pair[0] + pair[1]) / 3.0;
            total += area;
        }
        weighted / total
    }

    /// Largest distance between two corners.
    #[must_use]
    pub fn diameter(&self) -> f64 {
        let from = |n: usize| self.corners[n + 1..].iter().map(move |b| (b - self.corners[n]).norm());
        (0..self.corners.len()).flat_map(from).fold(0.0, f64::max)
    }

    /// The same polygon with its sides swapped.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { corners: self.corners.iter().rev().copied().collect(), normal: -self.normal, area: self.area }
    }

    /// The part in front of `plane`; none if it has no area.
    ///
    /// # Example
    /// ```
    /// use vfold::surfaces::{Plane, Polygon};
    /// use vfold::geometry::Vec3;
    /// let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    /// let right = Plane { normal: Vec3::x(), offset: 1.5 };
    /// assert_eq!(Polygon::new(&square).in_front_of(&right).unwrap().area(), 1.0);
    /// ```
    #[must_use]
    pub fn in_front_of(&self, plane: &Plane) -> Option<Self> {
        let corners = clip(&self.corners, plane);
        let area = 0.5 * spin(&corners).dot(&self.normal);
        (corners.len() >= 3 && area > 0.0).then_some(Self { corners, normal: self.normal, area })
    }

    /// The point at `u`, `v` in [0, 1] and the area element there, with the corners at (0,0), (1,0), (1,1),
    /// (0,1); a triangle's third corner is at both of the latter.
    ///
    /// Only for polygons with three or four corners.
    #[must_use]
    pub fn at(&self, u: f64, v: f64) -> (Vec3, f64) {
        let [a, b, c, d] = self.four_corners();
        let (along_u, along_v) = ((1.0 - v) * (b - a) + v * (c - d), (1.0 - u) * (d - a) + u * (c - b));
        let point = (1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * d + u * c);
        (point, along_u.cross(&along_v).dot(&self.normal))
    }

    /// Corners of a triangle or quadrilateral, the last of a triangle twice.
    #[must_use]
    pub fn four_corners(&self) -> [Vec3; 4] {
        let last = self.corners.len() - 1;
        [0, 1, 2, 3].map(|n: usize| self.corners[n.min(last)])
    }
}

/// Twice the area along the normal.
fn spin(corners: &[Vec3]) -> Vec3 {
    let Some(first) = corners.first() else { return Vec3::zeros() };
    corners[1..].windows(2).map(|pair| (pair[0] - first).cross(&(pair[1] - first))).sum()
}

/// Sides from corner to corner, including that from the last to the first.
pub fn edges(corners: &[Vec3]) -> impl Iterator<Item = (Vec3, Vec3)> + '_ {
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}

/// Corners of the part in front of `plane` (Sutherland and Hodgman 1974).
#[must_use]
pub fn clip(corners: &[Vec3], plane: &Plane) -> Corners {
    let mut out = Corners::new();
    for (a, b) in edges(corners) {
        let (height_a, height_b) = (plane.height(&a), plane.height(&b));
        if height_a >= 0.0 {
            out.push(a);
        }
        if (height_a > 0.0 && height_b < 0.0) || (height_a < 0.0 && height_b > 0.0) {
            out.push(a + (b - a) * (height_a / (height_a - height_b)));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_is_a_quadrilateral_with_two_corners_in_one() {
        let triangle = Polygon::new(&[Vec3::zeros(), Vec3::x(), Vec3::y()]);
        assert_eq!(triangle.at(0.5, 1.0).0, Vec3::y());
        assert!((triangle.centroid() - Vec3::new(1.0, 1.0, 0.0) / 3.0).norm() < 1e-15);
        assert!((triangle.at(0.3, 0.5).1 - 0.5).abs() < 1e-15); // twice the area times 1 − v
    }

    #[test]
    fn a_plane_through_an_edge_leaves_all_or_nothing() {
        let square = Polygon::new(&[Vec3::zeros(), Vec3::x(), Vec3::new(1.0, 1.0, 0.0), Vec3::y()]);
        let plane = Plane { normal: Vec3::x(), offset: 0.0 };
        assert_eq!(square.in_front_of(&plane).unwrap().corners().len(), 4);
        assert!(square.in_front_of(&plane.reversed()).is_none());
    }
}
