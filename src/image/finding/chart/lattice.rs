//! Lattices of blobs in arbitrary perspective.

use std::collections::BTreeMap;

use nalgebra::Matrix3;

use super::super::outline::{Place, cross};
use super::blobs::Blob;
use super::plane_map::{affine, projective, seen};

/// Blobs from which lattices are grown, those with most neighbours first.
const SEEDS: usize = 80;
/// Nearest blobs that are considered as neighbours.
const NEIGHBOURS: usize = 9;
/// Largest distance between neighbours, in longer sides of the first, and largest ratio of their sizes.
const NEAR: f64 = 2.6;
const ALIKE: f64 = 2.0;
/// Largest ratio of a blob's size to that of the lattice's first: distant blobs look smaller.
const ALIKE_IN_ALL: f64 = 2.3;
/// The least sine of the angle between the steps to two neighbours.
const LEAST_SINE: f64 = 0.3;
/// Area of a lattice cell, in areas of the blob: patches lie close to each other, and edges take some of a
/// blob.
const CELL: [f64; 2] = [0.9, 8.0];
/// Largest distance of a blob from its node, in cells.
const OFF: f64 = 0.22;
/// Reach of each round, in nodes; a chart has six in a row.
const ROUNDS: [i32; 5] = [1, 2, 4, 6, 6];
/// Fewest blobs that determine perspective.
const ENOUGH: usize = 8;
/// Lattices of this many blobs, as many as a chart has, are not grown again from each of them. Smaller ones
/// may be bent by steep perspective, and another seed may grow the straight one.
const WHOLE: usize = 24;

/// A node of a lattice: column and row.
pub(super) type Node = [i32; 2];

/// A lattice and the blobs on its nodes.
#[derive(Debug, Clone)]
pub(super) struct Lattice {
    /// From nodes to the picture, px. Never mirrored: rows follow columns clockwise as seen.
    pub to_picture: Matrix3<f64>,
    /// Which blob is on a node.
    pub nodes: BTreeMap<Node, usize>,
}

/// Lattices of blobs, one at a time, until `is_enough` accepts one.
pub(super) fn lattices(blobs: &[Blob], mut is_enough: impl FnMut(&Lattice) -> bool) {
    let neighbours: Vec<Vec<usize>> = (0..blobs.len()).map(|k| neighbours(blobs, k)).collect();
    let mut seeds: Vec<usize> = (0..blobs.len()).collect();
    seeds.sort_by_key(|k| (std::cmp::Reverse(neighbours[*k].len()), *k));
    let mut is_used = vec![false; blobs.len()];
    for seed in seeds.into_iter().take(SEEDS) {
        for (right, down) in pairs(blobs, seed, &neighbours[seed]) {
            if is_used[seed] {
                break;
            }
            let Some(lattice) = grow(blobs, seed, right, down) else { continue };
            if is_enough(&lattice) {
                return;
            }
            if lattice.nodes.len() >= WHOLE {
                lattice.nodes.values().for_each(|k| is_used[*k] = true);
            }
        }
    }
}

/// The similar blobs next to one.
fn neighbours(blobs: &[Blob], k: usize) -> Vec<usize> {
    let this = &blobs[k];
    let distance = |other: &Blob| (other.centre - this.centre).norm();
    let is_alike = |other: &Blob| (1.0 / ALIKE..ALIKE).contains(&(other.side_px / this.side_px));
    let mut near: Vec<usize> = (0..blobs.len())
        .filter(|n| *n != k && distance(&blobs[*n]) < NEAR * this.long_px && is_alike(&blobs[*n]))
        .collect();
    near.sort_by(|a, b| distance(&blobs[*a]).total_cmp(&distance(&blobs[*b])));
    near.truncate(NEIGHBOURS);
    near
}

/// Steps to the next column and row that a blob's neighbours may define, shortest first; of a lattice's four
/// turns only one is returned.
fn pairs(blobs: &[Blob], seed: usize, neighbours: &[usize]) -> Vec<(Place, Place)> {
    let this = &blobs[seed];
    let steps: Vec<Place> = neighbours.iter().map(|k| blobs[*k].centre - this.centre).collect();
    let all = steps.iter().flat_map(|right| steps.iter().map(move |down| (*right, *down)));
    let may_be_cell = |(right, down): &(Place, Place)| {
        let area = cross(*right, *down);
        let is_first_turn = right.x > 0.0 && right.y.abs() <= 1.3 * right.x;
        let cell = CELL.map(|part| part * this.side_px * this.side_px);
        is_first_turn && area > LEAST_SINE * right.norm() * down.norm() && (cell[0]..cell[1]).contains(&area)
    };
    let mut pairs: Vec<_> = all.filter(may_be_cell).collect();
    let length = |(right, down): &(Place, Place)| right.norm_squared() + down.norm_squared();
    pairs.sort_by(|a, b| length(a).total_cmp(&length(b)));
    pairs
}

/// The lattice that continues from a blob and its neighbours.
fn grow(blobs: &[Blob], seed: usize, right: Place, down: Place) -> Option<Lattice> {
    let first = &blobs[seed];
    let mut to_picture = Matrix3::from_columns(&[right.push(0.0), down.push(0.0), first.centre.push(1.0)]);
    let mut nodes = BTreeMap::new();
    for reach in ROUNDS {
        nodes = taken_in(blobs, first, &to_picture, reach)?;
        let pairs: Vec<_> = nodes
            .iter()
            .map(|([i, j], k)| (Place::new(f64::from(*i), f64::from(*j)), blobs[*k].centre))
            .collect();
        let fit = if pairs.len() < ENOUGH { affine } else { projective };
        to_picture = fit(&pairs)?;
    }
    (nodes.len() >= ENOUGH).then_some(Lattice { to_picture, nodes })
}

/// The nearest blob to each node within `reach` of the first.
fn taken_in(
    blobs: &[Blob],
    first: &Blob,
    to_picture: &Matrix3<f64>,
    reach: i32,
) -> Option<BTreeMap<Node, usize>> {
    let to_nodes = to_picture.try_inverse()?;
    let mut nearest: BTreeMap<Node, (f64, usize)> = BTreeMap::new();
    for (k, blob) in blobs.iter().enumerate() {
        let place = seen(&to_nodes, blob.centre);
        let node = place.map(f64::round);
        let off = (place - node).amax();
        let is_alike = (1.0 / ALIKE_IN_ALL..ALIKE_IN_ALL).contains(&(blob.side_px / first.side_px));
        if !(off < OFF && node.amax() <= f64::from(reach) && is_alike) {
            continue;
        }
        let held = nearest.entry([node.x as i32, node.y as i32]).or_insert((off, k));
        if off < held.0 {
            *held = (off, k);
        }
    }
    (nearest.len() >= 3).then(|| nearest.into_iter().map(|(node, (_, k))| (node, k)).collect())
}
