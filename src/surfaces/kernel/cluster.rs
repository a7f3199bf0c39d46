//! Patches that are near to each other and similarly oriented, in a binary tree.

use std::ops::Range;

use super::casters::Bounds;
use super::cuboid::Cuboid;
use super::site::Site;
use crate::geometry::Vec3;
use crate::surfaces::polygon::Plane;

/// Clusters of at most this many patches are not divided.
const LEAF: usize = 64;
/// Cosine of the largest angle between patches of an even cluster and their mean normal.
const EVEN: f64 = 0.9;

/// Consecutive patches in the order of the tree.
pub(super) struct Cluster {
    pub(super) patches: Range<usize>,
    pub(super) bounds: Bounds,
    /// The bounding box: for an even cluster, along the axes of the largest even cluster that contains it, so
    /// that a polynomial along the axes of one is a polynomial in all of its parts.
    pub(super) cuboid: Cuboid,
    /// Whether the patches are coplanar or, with no flat part large enough to be treated alone, similarly
    /// oriented.
    pub(super) is_even: bool,
    /// Planes of the patches, without adjacent duplicates.
    planes: Vec<Plane>,
    /// Both halves, further down in the list of clusters; none if the cluster is not divided.
    pub(super) halves: Option<[usize; 2]>,
}

/// Position of one cluster relative to another.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// Entirely in front of every patch of the other.
    Front,
    /// Nowhere in front of any.
    Behind,
    /// Neither is certain.
    Between,
}

impl Cluster {
    fn new(own: &[&Site], patches: Range<usize>, axes: Option<[Vec3; 3]>, margin: f64) -> Self {
        let normal = own.iter().map(|site| site.plane.normal).sum::<Vec3>();
        let up = normal.try_normalize(1e-6).unwrap_or_else(|| own[0].plane.normal);
        let corners = own.iter().flat_map(|site| site.polygon.corners());
        let in_one_plane = |a: &&Site, b: &&Site| {
            let (a, b) = (a.plane, b.plane);
            (a.normal - b.normal).norm() < 1e-12 && (a.offset - b.offset).abs() < margin
        };
        let flat: Vec<&[&Site]> = own.chunk_by(in_one_plane).collect();
        let is_curved = || flat.iter().all(|part| part.len() < LEAF && part[0].plane.normal.dot(&up) > EVEN);
        Self {
            patches,
            bounds: Bounds::of(corners.clone()),
            cuboid: Cuboid::round(axes.unwrap_or_else(|| axes_along(own[0], up)), corners),
            is_even: axes.is_some() || flat.len() == 1 || is_curved(),
            planes: flat.iter().map(|part| part[0].plane).collect(),
            halves: None,
        }
    }

    /// The position of this cluster relative to the patches of `other`.
    pub(super) fn side(&self, other: &Self, margin: f64) -> Side {
        let corners = self.cuboid.corners();
        let heights = other.planes.iter().flat_map(|plane| corners.iter().map(|corner| plane.height(corner)));
        let (low, high) =
            heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        match (low >= -margin, high <= margin) {
            (_, true) => Side::Behind,
            (true, false) => Side::Front,
            (false, false) => Side::Between,
        }
    }
}

/// All patches in clusters, each before its halves: the first contains all.
pub(super) struct Tree {
    pub(super) clusters: Vec<Cluster>,
    /// The patch at each position: clusters are ranges of positions.
    pub(super) order: Vec<usize>,
}

impl Tree {
    /// The tree of these patches; lengths below `margin` count as zero.
    pub(super) fn new(sites: &[Site], margin: f64) -> Self {
        let size = Bounds::of(sites.iter().flat_map(|site| site.polygon.corners())).size();
        // a quarter turn counts as much as the length of the surface: panels are separated before they are
        // divided
        let key = |site: &Site| {
            let (place, turn) = (site.centre, size * site.plane.normal);
            [place.x, place.y, place.z, turn.x, turn.y, turn.z]
        };
        let keys: Vec<[f64; 6]> = sites.iter().map(key).collect();
        let mut tree = Self { clusters: Vec::new(), order: (0..sites.len()).collect() };
        tree.grow(sites, &keys, 0..sites.len(), None, margin);
        tree
    }

    /// Adds the cluster of the patches at some positions, and all of its parts; returns its number.
    fn grow(
        &mut self,
        sites: &[Site],
        keys: &[[f64; 6]],
        places: Range<usize>,
        axes: Option<[Vec3; 3]>,
        margin: f64,
    ) -> usize {
        let own: Vec<&Site> = self.order[places.clone()].iter().map(|n| &sites[*n]).collect();
        let cluster = Cluster::new(&own, places.clone(), axes, margin);
        let axes = cluster.is_even.then_some(cluster.cuboid.axes);
        let number = self.clusters.len();
        self.clusters.push(cluster);
        if places.len() > LEAF {
            let middle = places.start + divide(&mut self.order[places.clone()], keys);
            let halves = [places.start..middle, middle..places.end];
            self.clusters[number].halves =
                Some(halves.map(|half| self.grow(sites, keys, half, axes, margin)));
        }
        number
    }

    /// Whether any corner in a cluster is behind `plane` by more than `margin`.
    pub(super) fn is_behind(&self, number: usize, sites: &[Site], plane: &Plane, margin: f64) -> bool {
        let cluster = &self.clusters[number];
        if cluster.bounds.heights(plane)[0] >= -margin {
            return false;
        }
        match cluster.halves {
            Some(halves) => halves.iter().any(|half| self.is_behind(*half, sites, plane, margin)),
            None => {
                let mut corners =
                    sites[cluster.patches.clone()].iter().flat_map(|site| site.polygon.corners());
                corners.any(|corner| plane.height(corner) < -margin)
            }
        }
    }
}

/// Moves the patches on one side of the middle of the longest axis to the front, and counts them.
fn divide(order: &mut [usize], keys: &[[f64; 6]]) -> usize {
    let span = |axis: usize| {
        let along = order.iter().map(|n| keys[*n][axis]);
        along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    };
    let spans = [0, 1, 2, 3, 4, 5].map(span);
    let extent = |axis: &usize| spans[*axis][1] - spans[*axis][0];
    let axis = (0..6).max_by(|a, b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
    let middle = 0.5 * (spans[axis][0] + spans[axis][1]);
    order.sort_by_key(|n| (keys[*n][axis] > middle, *n));
    match order.partition_point(|n| keys[*n][axis] <= middle) {
        // all at the same position
        count if count == order.len() => count / 2,
        count => count,
    }
}

/// Axes along the first edge of a patch and along `up`.
fn axes_along(site: &Site, up: Vec3) -> [Vec3; 3] {
    let edge = site.polygon.corners()[1] - site.polygon.corners()[0];
    let along = (edge - up * up.dot(&edge)).try_normalize(f64::MIN_POSITIVE).unwrap_or_else(|| {
        // any direction will do
        up.cross(&up.map(|x| if x.abs() < 0.6 { 1.0 } else { 0.0 })).normalize()
    });
    [along, up.cross(&along), up]
}
