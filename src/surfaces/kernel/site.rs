//! Patches with the data needed for their form factors.

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
}

impl Site {
    pub(super) fn new(patch: &Patch) -> Self {
        let polygon = &patch.polygon;
        let (plane, centre) = (polygon.plane(), polygon.centroid());
        let radius = polygon.corners().iter().map(|corner| (corner - centre).norm()).fold(0.0, f64::max);
        Self { polygon: polygon.clone(), plane, centre, radius }
    }

    /// The part of this patch in front of the other's plane.
    pub(super) fn in_front_of(&self, other: &Self, margin: f64) -> Option<Polygon> {
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
