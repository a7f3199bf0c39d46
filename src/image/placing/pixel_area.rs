//! The part of a pixel inside a convex quadrilateral.
//!
//! For each row, the pixels that a quadrilateral touches and those that it covers are known in closed form;
//! only the few in between are clipped (I. Sutherland, G. Hodgman, *Reentrant Polygon Clipping*, CACM 17,
//! 1974).

use std::ops::Range;

use super::point::{Point, cross};

/// Tolerance for rounding with which a pixel whose edge lies on a side counts as inside, px.
const ROUNDING_PX: f64 = 1e-9;

/// The points with a x + b y >= c, where (a, b) is a unit vector.
#[derive(Debug, Clone, Copy)]
struct HalfPlane {
    a: f64,
    b: f64,
    c: f64,
}

impl HalfPlane {
    /// Signed distance from the border, positive inside, px.
    fn depth(&self, p: Point) -> f64 {
        self.a * p.x + self.b * p.y - self.c
    }

    /// Half the extent of a pixel across the border, px.
    fn pixel_reach(&self) -> f64 {
        (self.a.abs() + self.b.abs()) / 2.0
    }

    /// The range of x in which a x >= `rest`, for pixels whose corner at `x + offset` is decisive.
    fn columns(&self, rest: f64, offset: f64) -> (f64, f64) {
        let border = rest / self.a - offset;
        match self.a {
            a if a > 0.0 => (border, f64::INFINITY),
            a if a < 0.0 => (f64::NEG_INFINITY, border),
            _ if rest <= 0.0 => (f64::NEG_INFINITY, f64::INFINITY),
            _ => (f64::INFINITY, f64::NEG_INFINITY),
        }
    }

    /// Columns of the pixels of `row` that are entirely inside.
    fn whole(&self, row: f64) -> (f64, f64) {
        let y = if self.b > 0.0 { row } else { row + 1.0 };
        let (low, high) =
            self.columns(self.c - self.b * y - ROUNDING_PX, if self.a > 0.0 { 0.0 } else { 1.0 });
        (low.ceil(), high.floor() + 1.0)
    }

    /// Columns of the pixels of `row` that have a corner inside.
    fn touched(&self, row: f64) -> (f64, f64) {
        let y = if self.b > 0.0 { row + 1.0 } else { row };
        let (low, high) = self.columns(self.c - self.b * y, if self.a > 0.0 { 1.0 } else { 0.0 });
        (low.floor(), high.ceil() + 1.0)
    }
}

/// The intersection of four half-planes.
#[derive(Debug, Clone)]
pub(in crate::image) struct Sides([HalfPlane; 4]);

impl Sides {
    /// Inside four directed lines, each from one point to the next, in order around it: clockwise in the
    /// picture if `sense` is 1, anticlockwise if -1. All are moved inwards by `margin_px`.
    pub fn new(lines: [[Point; 2]; 4], sense: f64, margin_px: f64) -> Self {
        Self(lines.map(|[p, q]| {
            let length = p.distance(q) * sense;
            let (a, b) = ((p.y - q.y) / length, (q.x - p.x) / length);
            HalfPlane { a, b, c: a * p.x + b * p.y + margin_px }
        }))
    }

    /// Columns of the pixels of `row` entirely inside, in a picture of `width` columns.
    pub fn whole_columns(&self, row: usize, width: usize) -> Range<usize> {
        clamp(intersect(self.0.map(|side| side.whole(row as f64))), width)
    }
}

/// A convex quadrilateral in the picture.
#[derive(Debug, Clone)]
pub(in crate::image) struct Quadrilateral {
    sides: Sides,
    corners: [Point; 4],
}

impl Quadrilateral {
    /// The quadrilateral with these corners, in order around it in either sense.
    pub fn new(corners: &[Point; 4]) -> Self {
        let lines = [0, 1, 2, 3].map(|k| [corners[k], corners[(k + 1) % 4]]);
        Self { sides: Sides::new(lines, sense(corners), 0.0), corners: *corners }
    }

    /// Rows of a picture of `height` rows that the quadrilateral may touch.
    pub fn rows(&self, height: usize) -> Range<usize> {
        clamp(extent(self.corners.map(|p| p.y)), height)
    }

    /// Columns of a picture of `width` columns that the quadrilateral may touch.
    pub fn columns(&self, width: usize) -> Range<usize> {
        clamp(extent(self.corners.map(|p| p.x)), width)
    }

    /// Columns of the pixels of `row` entirely inside, in a picture of `width` columns.
    pub fn whole_columns(&self, row: usize, width: usize) -> Range<usize> {
        self.sides.whole_columns(row, width)
    }

    /// Columns of the pixels of `row` that may be touched, in a picture of `width` columns.
    pub fn touched_columns(&self, row: usize, width: usize) -> Range<usize> {
        clamp(intersect(self.sides.0.map(|side| side.touched(row as f64))), width)
    }

    /// The area, px², that the quadrilateral shares with the pixel in column `x` and row `y`.
    pub fn overlap(&self, x: usize, y: usize) -> f64 {
        let (x, y) = (x as f64, y as f64);
        let centre = Point::new(x + 0.5, y + 0.5);
        // most pixels are crossed by one side only
        let met_by = |side: &&HalfPlane| side.depth(centre).abs() < side.pixel_reach();
        if self.sides.0.iter().any(|side| side.depth(centre) <= -side.pixel_reach()) {
            return 0.0;
        }
        let pixel = [(x, y), (x + 1.0, y), (x + 1.0, y + 1.0), (x, y + 1.0)].map(|(x, y)| Point::new(x, y));
        area(&self.sides.0.iter().filter(met_by).fold(pixel.to_vec(), |polygon, side| clip(&polygon, side)))
    }
}

/// 1 if the corners are in clockwise order in the picture, else -1.
pub(in crate::image) fn sense(corners: &[Point; 4]) -> f64 {
    cross(corners[0], corners[1], corners[2]).signum()
}

/// The whole pixels from the least to the greatest coordinate.
fn extent(coordinates: [f64; 4]) -> (f64, f64) {
    let least = coordinates.into_iter().fold(f64::INFINITY, f64::min);
    (least.floor(), coordinates.into_iter().fold(f64::NEG_INFINITY, f64::max).ceil())
}

fn intersect(ranges: [(f64, f64); 4]) -> (f64, f64) {
    ranges
        .into_iter()
        .fold((f64::NEG_INFINITY, f64::INFINITY), |(low, high), range| (low.max(range.0), high.min(range.1)))
}

/// A range of integers, clamped to 0..size and empty if it is reversed.
fn clamp((low, high): (f64, f64), size: usize) -> Range<usize> {
    // `as` converts negative numbers to 0 and infinity to the largest integer
    let low = (low as usize).min(size);
    low..(high as usize).clamp(low, size)
}

/// The part of a convex polygon inside a half-plane.
fn clip(polygon: &[Point], side: &HalfPlane) -> Vec<Point> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, &p) in polygon.iter().enumerate() {
        let q = polygon[(k + 1) % polygon.len()];
        let (p_depth, q_depth) = (side.depth(p), side.depth(q));
        if p_depth >= 0.0 {
            kept.push(p);
        }
        if (p_depth >= 0.0) != (q_depth >= 0.0) {
            let t = p_depth / (p_depth - q_depth);
            kept.push(Point::new(p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)));
        }
    }
    kept
}

/// Area of a convex polygon, px².
fn area(polygon: &[Point]) -> f64 {
    polygon.windows(2).map(|edge| cross(polygon[0], edge[0], edge[1])).sum::<f64>().abs() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Homography;
    use proptest::prelude::*;

    fn points(corners: [(f64, f64); 4]) -> [Point; 4] {
        corners.map(|(x, y)| Point::new(x, y))
    }

    #[test]
    fn a_margin_leaves_out_the_pixels_along_the_sides() {
        let corners = points([(1.0, 1.0), (9.0, 1.0), (9.0, 9.0), (1.0, 9.0)]);
        let inside = |margin_px| {
            Sides::new([0, 1, 2, 3].map(|k| [corners[k], corners[(k + 1) % 4]]), sense(&corners), margin_px)
        };
        assert_eq!(inside(0.0).whole_columns(1, 100), 1..9);
        assert_eq!(inside(1.0).whole_columns(2, 100), 2..8);
        assert!(inside(1.0).whole_columns(1, 100).is_empty());
        assert_eq!(inside(0.0).whole_columns(1, 5), 1..5);
    }

    #[test]
    fn a_diamond_covers_half_of_the_pixel_at_each_side() {
        let diamond = Quadrilateral::new(&points([(3.0, 0.0), (6.0, 3.0), (3.0, 6.0), (0.0, 3.0)]));
        assert!((diamond.overlap(0, 2) - 0.5).abs() < 1e-14);
        assert_eq!(diamond.whole_columns(2, 6), 1..5);
        assert!(diamond.overlap(0, 0) < 1e-14);
    }

    /// The area of a polygon by the shoelace formula, for comparison.
    fn shoelace(c: &[Point; 4]) -> f64 {
        (0..4).map(|k| c[k].x * c[(k + 1) % 4].y - c[(k + 1) % 4].x * c[k].y).sum::<f64>().abs() / 2.0
    }

    fn quadrilateral() -> impl Strategy<Value = [Point; 4]> {
        (prop::array::uniform8(-4.0..4.0), any::<bool>()).prop_map(|(d, mirrored)| {
            let mut corners = points([(5.0, 5.0), (25.0, 5.0), (25.0, 25.0), (5.0, 25.0)]);
            for (k, p) in corners.iter_mut().enumerate() {
                *p = Point::new(p.x + d[2 * k], p.y + d[2 * k + 1]);
            }
            if mirrored {
                corners.reverse();
            }
            corners
        })
    }

    proptest! {
        #[test]
        fn overlaps_add_up_to_the_area(corners in quadrilateral()) {
            let quadrilateral = Quadrilateral::new(&corners);
            let mut sum = 0.0;
            for y in quadrilateral.rows(30) {
                let whole = quadrilateral.whole_columns(y, 30);
                for x in quadrilateral.touched_columns(y, 30) {
                    let overlap = quadrilateral.overlap(x, y);
                    prop_assert!(!whole.contains(&x) || (overlap - 1.0).abs() < 1e-8, "({x}, {y}) {overlap}");
                    // One that an edge just touches is whole up to rounding.
                    prop_assert!(overlap < 1.0 + 1e-8, "({x}, {y}) {overlap}");
                    sum += overlap;
                }
            }
            prop_assert!((sum - shoelace(&corners)).abs() < 1e-9, "{sum} {}", shoelace(&corners));
        }

        /// The facets of a panel partition every pixel entirely inside the panel.
        #[test]
        fn facets_share_out_a_pixel(corners in quadrilateral(), rows in 1_usize..5, cols in 1_usize..5) {
            let panel = Homography::from_unit_square(corners).unwrap();
            let ends = |k: usize, count: usize| [k as f64 / count as f64, (k + 1) as f64 / count as f64];
            let facet = |k: usize| panel.rectangle(ends(k % cols, cols), ends(k / cols, rows));
            let facets: Vec<_> = (0..rows * cols).map(|k| Quadrilateral::new(&facet(k))).collect();
            let whole_panel = Quadrilateral::new(&corners);
            for y in whole_panel.rows(30) {
                for x in whole_panel.whole_columns(y, 30) {
                    let sum: f64 = facets.iter().map(|facet| facet.overlap(x, y)).sum();
                    prop_assert!((sum - 1.0).abs() < 1e-9, "({x}, {y}) {sum}");
                }
            }
        }
    }
}
