//! Facets that may be between two others: cheap tests without false negatives, so that most pairs need no
//! search for shadows.

use crate::geometry::Vec3;
use crate::surfaces::merged::merged;
use crate::surfaces::polygon::{Plane, Polygon, edges};

/// Distances below this, relative to the surface's size, count as zero: a facet that touches the line of
/// sight hides nothing.
pub const TOUCHING: f64 = 1e-9;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    low: Vec3,
    high: Vec3,
}

impl Bounds {
    /// The bounding box of points.
    pub fn of<'a>(points: impl IntoIterator<Item = &'a Vec3>) -> Self {
        let empty = Self { low: Vec3::repeat(f64::INFINITY), high: Vec3::repeat(f64::NEG_INFINITY) };
        points
            .into_iter()
            .fold(empty, |all, point| Self { low: all.low.inf(point), high: all.high.sup(point) })
    }

    /// The bounding box of two boxes.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    /// Whether two boxes intersect.
    fn overlaps(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    /// Largest extent along an axis.
    #[must_use]
    pub fn size(&self) -> f64 {
        (self.high - self.low).max()
    }

    /// Least and greatest height of the box above a plane with a unit normal.
    #[must_use]
    pub fn heights(&self, plane: &Plane) -> [f64; 2] {
        let middle = plane.height(&(0.5 * (self.low + self.high)));
        let reach = 0.5 * (self.high - self.low).dot(&plane.normal.abs());
        [middle - reach, middle + reach]
    }
}

/// Facets between two polygons.
#[derive(Clone, Debug, PartialEq)]
pub enum Between {
    /// None are possible.
    Nothing,
    /// One facet that hides the polygons completely from each other.
    Wall,
    /// These are possible.
    Some(Vec<Polygon>),
}

/// A flat part of the surface that may cast a shadow.
pub struct Caster {
    polygon: Polygon,
    plane: Plane,
    bounds: Bounds,
}

impl Caster {
    /// Whether everything between the corners `a` is hidden from everything between the corners `b`, or
    /// nothing is; none if neither is certain.
    ///
    /// Lines from a hull on one side of a plane to one on the other cross it within the hull of the crossings
    /// of lines between corners.
    fn hides(&self, a: &[Vec3], b: &[Vec3], margin: f64) -> Option<bool> {
        let heights = |corners: &[Vec3]| {
            let heights = corners.iter().map(|corner| self.plane.height(corner));
            heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)))
        };
        let ((low_a, high_a), (low_b, high_b)) = (heights(a), heights(b));
        if low_a.min(low_b) >= -margin || high_a.max(high_b) <= margin {
            return Some(false);
        }
        if !((high_a < -margin && low_b > margin) || (high_b < -margin && low_a > margin)) {
            return None;
        }
        let crossing = |p: &Vec3, q: &Vec3| {
            let (h, k) = (self.plane.height(p), self.plane.height(q));
            p + (q - p) * (h / (h - k))
        };
        let crossings = a.iter().flat_map(|p| b.iter().map(move |q| crossing(p, q)));
        self.holds(&crossings.collect::<Vec<_>>(), margin)
    }

    /// Whether all points in its plane are inside it, or all beyond one of its sides; none if neither.
    fn holds(&self, points: &[Vec3], margin: f64) -> Option<bool> {
        let mut inside = true;
        for (from, to) in edges(self.polygon.corners()) {
            let inwards = self.plane.normal.cross(&(to - from)).normalize();
            let heights = points.iter().map(|point| inwards.dot(&(point - from)));
            let (low, high) =
                heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
            if high <= margin {
                return Some(false);
            }
            inside &= low >= -margin;
        }
        inside.then_some(true)
    }
}

/// All facets of a surface as casters of shadows.
pub struct Casters {
    all: Vec<Caster>,
    margin: f64,
}

impl Casters {
    /// The casters of a surface with largest extent `size`.
    pub fn new<'a>(facets: impl Iterator<Item = &'a Polygon>, size: f64) -> Self {
        let caster = |polygon: Polygon| Caster {
            plane: polygon.plane(),
            bounds: Bounds::of(polygon.corners()),
            polygon,
        };
        Self { all: merged(facets).into_iter().map(caster).collect(), margin: TOUCHING * size }
    }

    /// Length below which a distance counts as zero.
    #[must_use]
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// Numbers of all casters.
    #[must_use]
    pub fn numbers(&self) -> Vec<usize> {
        (0..self.all.len()).collect()
    }

    /// The plane of a caster.
    #[must_use]
    pub fn plane(&self, number: usize) -> &Plane {
        &self.all[number].plane
    }

    /// Those among `candidates` that may be between the contents of two boxes: they intersect the common
    /// bounding box, which extends to both sides of their plane.
    #[must_use]
    pub fn between_boxes(&self, a: &Bounds, b: &Bounds, candidates: &[usize]) -> Vec<usize> {
        let both = a.with(b);
        let stands = |caster: &Caster| {
            let [low, high] = both.heights(&caster.plane);
            caster.bounds.overlaps(&both) && low < -self.margin && high > self.margin
        };
        candidates.iter().copied().filter(|n| stands(&self.all[*n])).collect()
    }

    /// Those of `candidates` that may be between two polygons: their parts in front of both planes.
    #[must_use]
    pub fn between(&self, a: &Polygon, b: &Polygon, candidates: &[usize]) -> Between {
        let [box_a, box_b] = [a, b].map(|polygon| Bounds::of(polygon.corners()));
        let planes = [a.plane(), b.plane()];
        let mut parts = Vec::new();
        for n in self.between_boxes(&box_a, &box_b, candidates) {
            match self.all[n].hides(a.corners(), b.corners(), self.margin) {
                Some(true) => return Between::Wall,
                Some(false) => {}
                None => parts.extend(self.in_front(n, &planes)),
            }
        }
        if parts.is_empty() { Between::Nothing } else { Between::Some(parts) }
    }

    /// Those of `candidates` that may hide part of the hull of corners `a` from part of the hull of corners
    /// `b`; none if one hides everything.
    #[must_use]
    pub fn between_hulls(&self, a: &[Vec3], b: &[Vec3], candidates: &[usize]) -> Option<Vec<usize>> {
        let mut may = Vec::new();
        for n in candidates {
            match self.all[*n].hides(a, b, self.margin) {
                Some(true) => return None,
                Some(false) => {}
                None => may.push(*n),
            }
        }
        Some(may)
    }

    /// The parts of all facets in front of a plane, which may be between it and a light.
    #[must_use]
    pub fn in_front_of(&self, plane: &Plane) -> Vec<Polygon> {
        (0..self.all.len()).filter_map(|n| self.in_front(n, &[*plane])).collect()
    }

    /// The part of a facet in front of planes, by more than a margin.
    fn in_front(&self, n: usize, planes: &[Plane]) -> Option<Polygon> {
        let polygon = self.all[n].polygon.clone();
        planes.iter().try_fold(polygon, |rest, plane| rest.in_front_of(&plane.raised(self.margin)))
    }
}
