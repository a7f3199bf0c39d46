//! The form factors of all pairs of patches, each by the formula that suits it.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use super::casters::{Between, Bounds, Casters};
use super::patches::Patch;
use super::symmetric::Rows;
use super::{contour, far, partial};
use crate::geometry::polygon::{Plane, Polygon, Vec3};
use crate::geometry::shape::Shape;

/// Patches that look for their casters together.
pub(super) const BLOCK: usize = 32;
/// Shares of exchange below this are rounding: what is seen along a line of sight that an edge just touches.
const NOTHING: f64 = 1e-7;

/// How many pairs of patches were dealt with in which way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// In one plane or behind each other: they exchange nothing.
    pub averted: usize,
    /// Nothing can stand between them.
    pub open: usize,
    /// One facet hides all of one from all of the other.
    pub walled: usize,
    /// Others may stand between them: their shadows were cut out.
    pub hidden: usize,
}

/// A patch with what is asked of it for every pair.
struct Site {
    polygon: Polygon,
    plane: Plane,
    centre: Vec3,
    radius: f64,
}

impl Site {
    fn new(patch: &Patch) -> Self {
        let (plane, centre) = (patch.polygon.plane(), patch.polygon.centroid());
        let radius =
            patch.polygon.corners().iter().map(|corner| (corner - centre).norm()).fold(0.0, f64::max);
        Self { polygon: patch.polygon.clone(), plane, centre, radius }
    }

    /// The part of this patch in front of the other's plane.
    fn in_front_of(&self, other: &Self, margin: f64) -> Option<Polygon> {
        let height = other.plane.height(&self.centre);
        if height >= self.radius {
            return Some(self.polygon.clone());
        }
        if height <= -self.radius {
            return None;
        }
        let heights = self.polygon.corners().iter().map(|corner| other.plane.height(corner));
        let (low, high) =
            heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        match (low >= -margin, high > margin) {
            (_, false) => None,
            (true, true) => Some(self.polygon.clone()),
            (false, true) => self.polygon.in_front_of(&other.plane),
        }
    }
}

/// All pairs of patches, block by block.
pub(super) struct Assembly {
    sites: Vec<Site>,
    casters: Casters,
    pub(super) bounds: Vec<Bounds>,
    tolerance: f64,
    averted: AtomicUsize,
    open: AtomicUsize,
    walled: AtomicUsize,
    hidden: AtomicUsize,
}

impl Assembly {
    pub(super) fn new(shape: &Shape, patches: &[Patch], tolerance: f64) -> Self {
        let sites: Vec<Site> = patches.iter().map(Site::new).collect();
        let bounds = |sites: &[Site]| Bounds::of(sites.iter().flat_map(|site| site.polygon.corners()));
        let bounds = sites.chunks(BLOCK).map(bounds).collect();
        let casters = Casters::new(shape.facets(), shape.size());
        let none = AtomicUsize::default;
        Self {
            sites,
            casters,
            bounds,
            tolerance,
            averted: none(),
            open: none(),
            walled: none(),
            hidden: none(),
        }
    }

    pub(super) fn census(&self) -> Census {
        let counts = [&self.averted, &self.open, &self.walled, &self.hidden];
        let [averted, open, walled, hidden] = counts.map(|count| count.load(Relaxed));
        Census { averted, open, walled, hidden }
    }

    /// The rows of a block, right of the diagonal.
    pub(super) fn rows(&self, block: usize) -> Rows {
        let first = block * BLOCK;
        let own = first..(first + BLOCK).min(self.sites.len());
        let mut entries = vec![vec![0.0; self.sites.len() - first]; own.len()];
        let all = self.casters.numbers();
        for (other, bounds) in self.bounds.iter().enumerate().skip(block) {
            let casters = self.casters.between_boxes(&self.bounds[block], bounds, &all);
            let others = other * BLOCK..((other + 1) * BLOCK).min(self.sites.len());
            for (row, i) in entries.iter_mut().zip(own.clone()) {
                for j in others.clone().filter(|j| *j > i) {
                    row[j - first] = self.exchange(i, j, &casters);
                }
            }
        }
        let mut rows = Rows::default();
        own.zip(&entries).for_each(|(i, entries)| rows.push(i, first, entries));
        rows
    }

    /// `√A_i·K_ij/√A_j`.
    fn exchange(&self, i: usize, j: usize, casters: &[usize]) -> f64 {
        let (a, b, margin) = (&self.sites[i], &self.sites[j], self.casters.margin());
        let (Some(part_a), Some(part_b)) = (a.in_front_of(b, margin), b.in_front_of(a, margin)) else {
            self.averted.fetch_add(1, Relaxed);
            return 0.0;
        };
        let between = if casters.is_empty() {
            Between::Nothing
        } else {
            self.casters.between(&part_a, &part_b, casters)
        };
        let (count, share) = match &between {
            Between::Nothing => (&self.open, 1.0),
            Between::Wall => (&self.walled, 0.0),
            Between::Some(casters) => {
                (&self.hidden, partial::visible_share(&part_a, &part_b, casters, self.tolerance))
            }
        };
        count.fetch_add(1, Relaxed);
        if share < NOTHING {
            return 0.0;
        }
        let distance = (a.centre - b.centre).norm();
        let exchange = far::exchange(&part_a, &part_b, [a.radius, b.radius], distance)
            .unwrap_or_else(|| contour::exchange(&part_a, &part_b));
        share * exchange.max(0.0) / (a.polygon.area() * b.polygon.area()).sqrt()
    }
}
