//! Flat parts of a surface as a few large polygons: shadows do not require the division into facets.

use std::collections::HashMap;

use super::polygon::{Corners, Polygon, edges};
use crate::geometry::Vec3;

/// Sine of an angle, and relative length, below which it counts as zero.
const NONE: f64 = 1e-9;
/// Most corners of a merged polygon.
const CORNERS_MAX: usize = 6;

/// The same surface with coplanar neighbours joined along entire edges, where the result is convex.
///
/// Edges are tried one after the other in the order of corners, so that a grid of facets becomes strips, and
/// the strips become one polygon.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold};
/// use vfold::surfaces::{Accordion, merged};
/// let valley = Fold::new(60.0, 1.0, 1.0, FacetGrid { rows: 7, cols: 5 })?;
/// let v = Accordion { valley, creases: 1, ridge_deg: 60.0, bow_deg: 0.0 }.shape()?;
/// assert_eq!(merged(v.facets()).len(), 2);
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn merged<'a>(facets: impl Iterator<Item = &'a Polygon>) -> Vec<Polygon> {
    let mut all: Vec<Polygon> = facets.cloned().collect();
    loop {
        let before = all.len();
        for edge in 0..CORNERS_MAX {
            while let Some(fewer) = joined_along(edge, &all) {
                all = fewer;
            }
        }
        if all.len() == before {
            return all;
        }
    }
}

type Key = [u64; 3];

fn key(point: &Vec3) -> Key {
    [point.x, point.y, point.z].map(|x| (x + 0.0).to_bits())
}

/// One pass: each polygon absorbs at most one neighbour across its side number `edge`; none if none does.
fn joined_along(edge: usize, all: &[Polygon]) -> Option<Vec<Polygon>> {
    let mut beyond = HashMap::new();
    for (n, polygon) in all.iter().enumerate() {
        beyond.extend(polygon.edges().map(|(from, to)| ((key(&to), key(&from)), n)));
    }
    let mut taken = vec![false; all.len()];
    let mut grown: Vec<Option<Polygon>> = vec![None; all.len()];
    for (n, polygon) in all.iter().enumerate().filter(|(_, polygon)| edge < polygon.corners().len()) {
        let (from, to) = (polygon.corners()[edge], polygon.corners()[(edge + 1) % polygon.corners().len()]);
        let Some(&other) = beyond.get(&(key(&from), key(&to))) else { continue };
        if other == n || taken[n] || taken[other] {
            continue;
        }
        grown[n] = join(polygon, edge, &all[other], &to);
        if grown[n].is_some() {
            (taken[n], taken[other]) = (true, true);
        }
    }
    if !grown.iter().any(Option::is_some) {
        return None;
    }
    let kept = all.iter().zip(taken).zip(grown);
    Some(
        kept.filter_map(|((polygon, taken), grown)| if taken { grown } else { Some(polygon.clone()) })
            .collect(),
    )
}

/// `a` joined with `b` beyond its side number `edge`, which ends in `to`, if both are coplanar and the result
/// is convex.
fn join(a: &Polygon, edge: usize, b: &Polygon, to: &Vec3) -> Option<Polygon> {
    if a.normal().cross(&b.normal()).norm() > NONE || a.normal().dot(&b.normal()) < 0.0 {
        return None;
    }
    let first = b.corners().iter().position(|corner| key(corner) == key(to))?;
    // b traverses this side backwards from `to`: its remaining corners are new
    let others = b.corners().len();
    let new = (2..others).map(|step| b.corners()[(first + step) % others]);
    let mut corners: Vec<Vec3> = a.corners()[..=edge].to_vec();
    corners.extend(new);
    corners.extend_from_slice(&a.corners()[edge + 1..]);
    let corners = turning(&corners, &a.normal())?;
    (corners.len() <= CORNERS_MAX).then(|| Polygon::new(&corners))
}

/// The corners at which an outline turns left; none if it turns right anywhere.
fn turning(corners: &[Vec3], normal: &Vec3) -> Option<Corners> {
    let count = corners.len();
    let mut kept = Corners::new();
    for ((from, corner), n) in edges(corners).zip(1..) {
        let (arrive, leave) = (corner - from, corners[(n + 1) % count] - corner);
        let turn = arrive.cross(&leave).dot(normal) / (arrive.norm() * leave.norm());
        if turn < -NONE {
            return None;
        }
        if turn > NONE {
            kept.push(corner);
        }
    }
    // restores the original first corner
    if kept.last() == Some(&corners[0]) {
        kept.rotate_right(1);
    }
    (kept.len() >= 3).then_some(kept)
}
