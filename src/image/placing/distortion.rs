//! Radial distortion of straight lines by a lens, relative to the picture's centre.
//!
//! A point of the ideal picture at distance r from the centre is seen at r (1 + k1 r² + k2 r⁴), in the same
//! direction; the unit of r is half the picture's shorter side. This is D. C. Brown's radial model
//! (*Close-Range Camera Calibration*, Photogrammetric Engineering 37, 1971, p. 855) in the direction and unit
//! of lensfun (`poly5`), Hugin and ImageMagick (`-distort barrel "0 K1 0 1"`, which straightens). OpenCV's
//! unit is the focal length: multiply its k1 by s² and its k2 by s⁴, where s is half the shorter side over
//! the focal length, both in px.

use super::point::Point;
use crate::{Error, Result};

/// The distortion of an ideal picture by a lens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lens {
    centre: Point,
    /// Half the shorter side of the picture, px.
    unit_px: f64,
    k1: f64,
    k2: f64,
}

/// Steps of the search for radii at which the picture folds back on itself, in the lens's unit of length.
const RADIUS_STEP: f64 = 1e-3;
/// Most Newton steps for the radius; at ten percent distortion it takes five.
const ITERATIONS: usize = 30;
/// The radius has converged when a step is smaller than this.
const CONVERGED: f64 = 1e-13;

impl Lens {
    /// A lens without distortion.
    pub const STRAIGHT: Self = Self { centre: Point::new(0.0, 0.0), unit_px: 1.0, k1: 0.0, k2: 0.0 };

    /// A lens with these coefficients, for a picture of `width` x `height` px.
    ///
    /// # Errors
    /// [`Error::Usage`] if a coefficient is not finite, or if two points of the ideal picture would coincide.
    ///
    /// # Example
    /// ```
    /// use vfold::image::{Lens, Point};
    /// let lens = Lens::new([-0.02, 0.0], 640, 480)?; // a barrel: the unit is 240 px
    /// let seen = lens.distort(Point::new(320.0 + 240.0, 240.0));
    /// assert!((seen.x - (320.0 + 240.0 * 0.98)).abs() < 1e-12);
    /// assert!((lens.undistort(seen).x - 560.0).abs() < 1e-9);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new([k1, k2]: [f64; 2], width: usize, height: usize) -> Result<Self> {
        let (width, height) = (width as f64, height as f64);
        let unit_px = width.min(height) / 2.0;
        let lens = Self { centre: Point::new(width / 2.0, height / 2.0), unit_px, k1, k2 };
        let corner = width.hypot(height) / 2.0 / unit_px;
        let mut radii = (1..).map(|step| f64::from(step) * RADIUS_STEP);
        let ends = radii.find(|&r| lens.seen_radius(r).is_none_or(|seen| seen >= corner));
        match ends.and_then(|r| lens.seen_radius(r)) {
            Some(_) => Ok(lens),
            None => Err(Error::usage(
                "--distortion",
                format!("{k1},{k2} bends the picture back on itself before its corners"),
                "give k1,k2 for radii in units of half the picture's shorter side, with k2 0 if unknown",
            )),
        }
    }

    /// The same lens with more distortion, by k1, for a picture of `width` x `height` px.
    ///
    /// # Errors
    /// As [`Lens::new`].
    pub(in crate::image) fn with_k1_more(&self, k1: f64, [width, height]: [usize; 2]) -> Result<Self> {
        Self::new([self.k1 + k1, self.k2], width, height)
    }

    /// The coefficients k1 and k2.
    #[must_use]
    pub fn coefficients(&self) -> [f64; 2] {
        [self.k1, self.k2]
    }

    /// Whether straight lines stay straight.
    #[must_use]
    pub fn is_straight(&self) -> bool {
        self.k1.abs() + self.k2.abs() <= 0.0
    }

    /// Where a point of the ideal picture is seen.
    #[must_use]
    pub fn distort(&self, ideal: Point) -> Point {
        let (x, y) = self.centred(ideal);
        let scale = self.magnification(x.hypot(y)).0;
        self.at(x * scale, y * scale)
    }

    /// The point of the ideal picture that is seen here; NaN if there is none.
    #[must_use]
    pub fn undistort(&self, seen: Point) -> Point {
        self.undistort_with_area(seen).0
    }

    /// The point of the ideal picture that is seen here, and the ideal area per pixel there, px².
    pub(super) fn undistort_with_area(&self, seen: Point) -> (Point, f64) {
        if self.is_straight() {
            return (seen, 1.0);
        }
        let (x, y) = self.centred(seen);
        let radius = self.ideal_radius(x.hypot(y));
        let (along, across) = self.magnification(radius);
        (self.at(x / along, y / along), 1.0 / (along * across))
    }

    fn centred(&self, p: Point) -> (f64, f64) {
        ((p.x - self.centre.x) / self.unit_px, (p.y - self.centre.y) / self.unit_px)
    }

    fn at(&self, x: f64, y: f64) -> Point {
        Point::new(self.centre.x + x * self.unit_px, self.centre.y + y * self.unit_px)
    }

    /// Ratios of seen to ideal lengths at this ideal radius: of the radius itself, and of a short length
    /// along it.
    fn magnification(&self, radius: f64) -> (f64, f64) {
        let (r2, k1, k2) = (radius * radius, self.k1, self.k2);
        (1.0 + r2 * (k1 + k2 * r2), 1.0 + r2 * (3.0 * k1 + 5.0 * k2 * r2))
    }

    /// Where an ideal radius is seen; none if the picture is folded back there.
    fn seen_radius(&self, radius: f64) -> Option<f64> {
        let (scale, slope) = self.magnification(radius);
        (slope > 0.0 && slope.is_finite()).then_some(radius * scale)
    }

    fn ideal_radius(&self, seen: f64) -> f64 {
        let mut radius = seen;
        for _ in 0..ITERATIONS {
            let (scale, slope) = self.magnification(radius);
            let step = (radius * scale - seen) / slope;
            radius -= step;
            if step.abs() < CONVERGED {
                return radius;
            }
        }
        f64::NAN
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_straight_lens_changes_nothing() {
        let p = Point::new(12.3, 45.6);
        assert_eq!((Lens::STRAIGHT.undistort_with_area(p), Lens::STRAIGHT.distort(p)), ((p, 1.0), p));
    }

    /// OpenCV 5.0, f = 500 px, k1 = -0.12, k2 = 0.03: cv2.projectPoints of (0.6, -0.4, 1) with centre (320,
    /// 240).
    #[test]
    fn distortion_agrees_with_opencv() {
        let s = 240.0_f64 / 500.0;
        let lens = Lens::new([-0.12 * s.powi(2), 0.03 * s.powi(4)], 640, 480).unwrap();
        let seen = lens.distort(Point::new(320.0 + 300.0, 240.0 - 200.0));
        assert!((seen.x - 603.7136).abs() < 1e-9 && (seen.y - 50.8576).abs() < 1e-9, "{seen:?}");
    }

    #[test]
    fn coefficients_that_fold_the_picture_are_refused() {
        for bad in [[-0.5, 0.0], [0.0, -0.2], [f64::NAN, 0.0], [0.0, f64::INFINITY]] {
            assert_eq!(Lens::new(bad, 640, 480).unwrap_err().exit_status(), 2, "{bad:?}");
        }
    }

    proptest! {
        #[test]
        fn there_and_back(x in 0.0..640.0, y in 0.0..480.0, k1 in -0.04..0.3, k2 in 0.0..0.1) {
            let lens = Lens::new([k1, k2], 640, 480).unwrap();
            let seen = Point::new(x, y);
            let (ideal, area) = lens.undistort_with_area(seen);
            let back = lens.distort(ideal);
            prop_assert!((back.x - x).hypot(back.y - y) < 1e-9);
            let step = 1e-4;
            let right = lens.undistort(Point::new(x + step, y));
            let below = lens.undistort(Point::new(x, y + step));
            let numeric = ((right.x - ideal.x) * (below.y - ideal.y)
                - (right.y - ideal.y) * (below.x - ideal.x))
                / (step * step);
            prop_assert!((area / numeric - 1.0).abs() < 1e-4, "{area} {numeric}");
        }
    }
}
