//! Conditions for a list of corners to be a facet, and for faces to be equal.

use std::collections::HashMap;

use super::polygon::Polygon;
use crate::error::{Error, Result, counted};
use crate::geometry::Vec3;

/// Largest deviation of a quadrilateral from a plane, relative to its longer diagonal.
const UNEVEN: f64 = 1e-4;
/// Facets narrower than this, relative to their length, are degenerate.
const DEGENERATE: f64 = 1e-9;

/// The face as a polygon, if its corners exist and are coplanar.
pub(super) fn flat(vertices: &[[f64; 3]], corners: &[usize], n: usize) -> Result<Polygon> {
    if !(3..=4).contains(&corners.len()) {
        let problem = format!("face {n} has {}", counted(corners.len(), "corner"));
        return Err(Error::shape(problem, "divide it into triangles or quadrilaterals"));
    }
    let mut points = Vec::new();
    for corner in corners {
        let Some(point) = vertices.get(*corner) else {
            let problem = format!("face {n} uses vertex {corner} of only {}", vertices.len());
            return Err(Error::shape(problem, "count vertices from 0"));
        };
        points.push(Vec3::from(*point));
    }
    let polygon = Polygon::new(&points);
    let height = |point: &Vec3| (point - points[0]).dot(&polygon.normal()).abs();
    let uneven = points.iter().map(height).fold(0.0, f64::max) / polygon.diameter();
    if uneven > UNEVEN {
        let problem = format!("face {n} is not flat: a corner is {uneven:.1e} of its size off the plane");
        return Err(Error::shape(problem, "divide it into two triangles"));
    }
    Ok(polygon)
}

/// Whether its area is negligible.
pub(super) fn is_degenerate(polygon: &Polygon) -> bool {
    let length = polygon.diameter();
    polygon.area().is_nan() || polygon.area() <= DEGENERATE * length * length
}

/// Refuses face `n` if it is not convex.
pub(super) fn convex(polygon: &Polygon, n: usize) -> Result<()> {
    let corners = polygon.corners();
    let turn = |k: usize| {
        let at = |k: usize| corners[k % corners.len()];
        (at(k + 1) - at(k)).cross(&(at(k + 2) - at(k + 1))).dot(&polygon.normal())
    };
    let least = (0..corners.len()).map(turn).fold(f64::INFINITY, f64::min);
    if least < -DEGENERATE * polygon.diameter().powi(2) {
        return Err(Error::shape(format!("face {n} is not convex"), "divide it into two triangles"));
    }
    Ok(())
}

/// Bits of a point, with −0 replaced by 0.
pub(super) type Bits = [u64; 3];

fn bits(point: &Vec3) -> Bits {
    [point.x, point.y, point.z].map(|x| (x + 0.0).to_bits())
}

/// Corners in cyclic order from the smallest, which identifies duplicate faces.
pub(super) fn canonical(polygon: &Polygon) -> Vec<Bits> {
    let mut corners: Vec<Bits> = polygon.corners().iter().map(bits).collect();
    let first = corners.iter().enumerate().min_by_key(|(_, corner)| **corner).map_or(0, |(n, _)| n);
    corners.rotate_left(first);
    corners
}

/// A message on edges that more than two faces share: where surfaces meet or cross.
pub(super) fn crowded_edges<'a>(facets: impl Iterator<Item = &'a Polygon>) -> Option<String> {
    let mut faces = HashMap::<[Bits; 2], usize>::new();
    for facet in facets {
        for (a, b) in facet.edges() {
            let mut ends = [bits(&a), bits(&b)];
            ends.sort_unstable();
            *faces.entry(ends).or_default() += 1;
        }
    }
    let crowded = faces.values().filter(|count| **count > 2).count();
    (crowded > 0).then(|| format!("more than two faces meet at {}", counted(crowded, "edge")))
}
