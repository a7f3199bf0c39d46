//! Patches with the data needed for their form factors.

use std::borrow::Cow;
use std::ptr;
use std::sync::OnceLock;

use super::far::{Nodes, ORDER_MAX, nodes};
use super::patches::Patch;
use crate::geometry::Vec3;
use crate::surfaces::polygon::{Plane, Polygon};

/// A patch with the data needed for every pair.
pub(super) struct Site {
    pub(super) polygon: Polygon,
    pub(super) plane: Plane,
    pub(super) centre: Vec3,
    /// Largest distance of a corner from the centre.
    pub(super) radius: f64,
    /// Its Gauss nodes of every order that any pair needed.
    nodes: [OnceLock<Nodes>; ORDER_MAX],
}

impl Site {
    pub(super) fn new(patch: &Patch) -> Self {
        let polygon = &patch.polygon;
        let (plane, centre) = (polygon.plane(), polygon.centroid());
        let radius = polygon.corners().iter().map(|corner| (corner - centre).norm()).fold(0.0, f64::max);
        Self { polygon: polygon.clone(), plane, centre, radius, nodes: Default::default() }
    }

    /// The part of this patch in front of the other's plane.
    pub(super) fn in_front_of(&self, other: &Self, margin: f64) -> Option<Cow<'_, Polygon>> {
        let height = other.plane.height(&self.centre);
        if height >= self.radius {
            return Some(Cow::Borrowed(&self.polygon));
        }
        if height <= -self.radius {
            return None;
        }
        let heights = self.polygon.corners().iter().map(|corner| other.plane.height(corner));
        let (low, high) =
            heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        match (low >= -margin, high > margin) {
            (_, false) => None,
            (true, true) => Some(Cow::Borrowed(&self.polygon)),
            (false, true) => self.polygon.in_front_of(&other.plane).map(Cow::Owned),
        }
    }

    /// Gauss nodes on a part of this patch, computed once if it is the whole.
    pub(super) fn nodes(&self, part: &Polygon, order: usize) -> Cow<'_, [(Vec3, f64)]> {
        if ptr::eq(part, &self.polygon) {
            Cow::Borrowed(self.nodes[order - 1].get_or_init(|| nodes(part, order)))
        } else {
            Cow::Owned(nodes(part, order))
        }
    }
}
