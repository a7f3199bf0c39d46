//! Which facets may stand between two others: cheap tests that never miss one, so that most pairs need no look for shadows.

use crate::geometry::polygon::{Plane, Polygon, Vec3};

/// Distances below this, relative to the surface's size, are none: a facet touching the line of sight hides nothing.
pub const TOUCHING: f64 = 1e-9;

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    low: Vec3,
    high: Vec3,
}

impl Bounds {
    /// The box round points.
    pub fn of<'a>(points: impl IntoIterator<Item = &'a Vec3>) -> Self {
        let empty = Self { low: Vec3::repeat(f64::INFINITY), high: Vec3::repeat(f64::NEG_INFINITY) };
        points
            .into_iter()
            .fold(empty, |all, point| Self { low: all.low.inf(point), high: all.high.sup(point) })
    }

    /// The box round two.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    /// Whether two boxes share a point.
    fn overlaps(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    /// Least and greatest height of the box over a plane with a unit normal.
    fn heights(&self, plane: &Plane) -> [f64; 2] {
        let middle = plane.height(&(0.5 * (self.low + self.high)));
        let reach = 0.5 * (self.high - self.low).dot(&plane.normal.abs());
        [middle - reach, middle + reach]
    }
}

/// A facet as something that may cast a shadow.
pub struct Caster {
    polygon: Polygon,
    plane: Plane,
    bounds: Bounds,
}

/// All facets of a surface as casters of shadows.
pub struct Casters {
    all: Vec<Caster>,
    margin: f64,
}

impl Casters {
    /// Those of a surface of largest extent `size`.
    pub fn new<'a>(facets: impl Iterator<Item = &'a Polygon>, size: f64) -> Self {
        let caster = |polygon: &Polygon| Caster {
            polygon: polygon.clone(),
            plane: polygon.plane(),
            bounds: Bounds::of(polygon.corners()),
        };
        Self { all: facets.map(caster).collect(), margin: TOUCHING * size }
    }

    /// Length below which a distance is none.
    #[must_use]
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// Numbers of all.
    #[must_use]
    pub fn numbers(&self) -> Vec<usize> {
        (0..self.all.len()).collect()
    }

    /// Those among `candidates` that may stand between things in two boxes: which reach into the box round both, and have not both
    /// on the same side of their plane.
    #[must_use]
    pub fn between_boxes(&self, a: &Bounds, b: &Bounds, candidates: &[usize]) -> Vec<usize> {
        let both = a.with(b);
        let stands = |caster: &Caster| {
            let [low, high] = both.heights(&caster.plane);
            caster.bounds.overlaps(&both) && low < -self.margin && high > self.margin
        };
        candidates.iter().copied().filter(|n| stands(&self.all[*n])).collect()
    }

    /// The parts of `candidates` that may stand between two polygons: in front of both planes.
    #[must_use]
    pub fn between(&self, a: &Polygon, b: &Polygon, candidates: &[usize]) -> Vec<Polygon> {
        let [box_a, box_b] = [a, b].map(|polygon| Bounds::of(polygon.corners()));
        let near = self.between_boxes(&box_a, &box_b, candidates).into_iter();
        let parted = near.filter(|n| {
            let heights =
                a.corners().iter().chain(b.corners()).map(|corner| self.all[*n].plane.height(corner));
            let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(low, high), h| (low.min(h), high.max(h)));
            low < -self.margin && high > self.margin
        });
        let planes = [a.plane(), b.plane()];
        parted.filter_map(|n| self.in_front(n, &planes)).collect()
    }

    /// The parts of all facets in front of a plane: those that may stand between it and a light.
    #[must_use]
    pub fn in_front_of(&self, plane: &Plane) -> Vec<Polygon> {
        (0..self.all.len()).filter_map(|n| self.in_front(n, &[*plane])).collect()
    }

    /// The part of a facet that is in front of planes, by more than a margin.
    fn in_front(&self, n: usize, planes: &[Plane]) -> Option<Polygon> {
        let polygon = self.all[n].polygon.clone();
        planes.iter().try_fold(polygon, |rest, plane| rest.in_front_of(&plane.raised(self.margin)))
    }
}
