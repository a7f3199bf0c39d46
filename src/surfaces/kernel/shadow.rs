//! The part of a polygon that other polygons do not hide from an eye: exact, by cutting out their shadows.
//!
//! A polygon between the eye and the target hides the target's part inside the pyramid through its outline (a
//! prism if the eye is a direction). The parts outside of its sides remain, as convex pieces, so that grazing
//! light varies continuously with areas: an edge exactly on the line of sight hides nothing or leaves
//! nothing, and never switches a pair from dark to bright.

use std::f64::consts::PI;

use smallvec::SmallVec;

use crate::geometry::Vec3;
use crate::surfaces::polygon::{Plane, Polygon, edges};

/// Pieces smaller than this, relative to the target, are dropped.
const CRUMB: f64 = 1e-14;

/// The viewpoint or direction from which a target is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Eye {
    /// A point.
    Point(Vec3),
    /// Parallel light; the direction towards it.
    Direction(Vec3),
}

impl Eye {
    /// The plane through the eye and an edge.
    fn plane(&self, from: &Vec3, to: &Vec3) -> Plane {
        let normal = match self {
            Self::Point(eye) => (from - eye).cross(&(to - eye)),
            Self::Direction(towards) => (to - from).cross(towards),
        };
        Plane { normal, offset: normal.dot(from) }
    }
}

/// The part of `target` that remains visible past polygons that cast shadows, all in front of its plane.
///
/// # Returns
/// Convex pieces; empty if everything is hidden.
///
/// # Example
/// ```
/// use vfold::surfaces::Polygon;
/// use vfold::geometry::Vec3;
/// use vfold::surfaces::kernel::shadow::{Eye, visible};
/// let square = |z: f64, size: f64| {
///     Polygon::new(&[[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]].map(|[x, y]| Vec3::new(x, y, z)))
/// };
/// let lamp = Eye::Point(Vec3::new(0.0, 0.0, 2.0)); // the shadow at half the height is twice as large
/// let lit = visible(&square(0.0, 1.0), &[square(1.0, 0.25)], lamp);
/// assert!((lit.iter().map(Polygon::area).sum::<f64>() - 0.75).abs() < 1e-15);
/// ```
#[must_use]
pub fn visible(target: &Polygon, casters: &[Polygon], eye: Eye) -> Vec<Polygon> {
    let mut pieces = vec![target.clone()];
    for caster in casters {
        let Some(sides) = sides(caster.corners(), eye) else { continue };
        let mut left = Vec::with_capacity(pieces.len() + 1);
        for piece in pieces {
            cut(piece, &sides, CRUMB * target.area(), &mut left);
        }
        pieces = left;
        if pieces.is_empty() {
            break;
        }
    }
    pieces
}

/// Planes that bound the shadow, facing inwards; none for a polygon seen edge-on.
fn sides(caster: &[Vec3], eye: Eye) -> Option<SmallVec<[Plane; 6]>> {
    let middle = caster.iter().sum::<Vec3>() / caster.len() as f64;
    let inside = |(from, to): (Vec3, Vec3)| {
        let plane = eye.plane(&from, &to);
        if plane.height(&middle) < 0.0 { plane.reversed() } else { plane }
    };
    let planes: SmallVec<[Plane; 6]> = edges(caster).map(inside).collect();
    planes.iter().any(|plane| plane.height(&middle) > 0.0).then_some(planes)
}

/// Adds the parts of `piece` outside the planes to `left`.
fn cut(piece: Polygon, planes: &[Plane], crumb: f64, left: &mut Vec<Polygon>) {
    let outside = |plane: &Plane| piece.corners().iter().all(|corner| plane.height(corner) <= 0.0);
    if planes.iter().any(outside) {
        return left.push(piece);
    }
    let mut rest = piece;
    for plane in planes {
        left.extend(rest.in_front_of(&plane.reversed()).filter(|part| part.area() > crumb));
        match rest.in_front_of(plane) {
            Some(inside) => rest = inside,
            None => return,
        }
    }
}

/// Fraction of the light leaving a Lambertian point with this `normal` that lands on `target`, entirely above
/// its horizon.
///
/// # Source
/// Lambert, *Photometria* (1760).
#[must_use]
pub fn point_factor(point: &Vec3, normal: &Vec3, target: &[Vec3]) -> f64 {
    let edge = |(from, to): (Vec3, Vec3)| {
        let (from, to) = (from - point, to - point);
        let cross = from.cross(&to);
        let sin = cross.norm();
        if sin > 0.0 { sin.atan2(from.dot(&to)) * cross.dot(normal) / sin } else { 0.0 }
    };
    (edges(target).map(edge).sum::<f64>() / (2.0 * PI)).abs()
}
