//! Form factors of two polygons that are partly hidden from each other.
//!
//! From a point on one polygon the visible part of the other is exact (`shadow`); the remaining integrand has
//! kinks, and is integrated on quarters of the polygon until they agree with the whole. The visible fraction
//! multiplies the exact unhidden exchange, so that the result is exact where nothing or everything is hidden.

use super::far::nodes;
use super::shadow::{Eye, point_factor, visible};
use crate::geometry::Vec3;
use crate::surfaces::polygon::Polygon;

/// Most levels of quartering.
const DEPTH_MAX: u32 = 4;
/// Error of a rule on quarters, relative to its difference from that on the whole, for a function with kinks.
const GAIN: f64 = 0.25;
/// Order of the rule on each part.
const ORDER: usize = 2;

/// Light that arrives, and light that would arrive unobstructed.
#[derive(Clone, Copy, Default)]
struct Light {
    seen: f64,
    open: f64,
}

impl Light {
    fn plus(self, other: Self) -> Self {
        Self { seen: self.seen + other.seen, open: self.open + other.open }
    }

    fn is_whole(self) -> bool {
        self.seen <= 0.0 || self.seen >= self.open
    }
}

/// Fraction in [0, 1] of the unhidden exchange between `a` and `b`, each entirely in front of the other, that
/// passes the `casters` between them; accurate to approximately `tolerance`.
#[must_use]
pub fn visible_share(a: &Polygon, b: &Polygon, casters: &[Polygon], tolerance: f64) -> f64 {
    let (from, to) = if a.area() <= b.area() { (a, b) } else { (b, a) };
    let pair = Pair { to, casters, normal: from.normal() };
    let parts: Vec<(Polygon, Light)> =
        fan(from).into_iter().map(|part| (part.clone(), pair.light(&part))).collect();
    let open: f64 = parts.iter().map(|(_, light)| light.open).sum();
    let refined =
        parts.into_iter().map(|(part, light)| pair.refine(&part, light, tolerance * open, DEPTH_MAX));
    let Light { seen, open } = refined.fold(Light::default(), Light::plus);
    if open > 0.0 { (seen / open).clamp(0.0, 1.0) } else { 0.0 }
}

struct Pair<'a> {
    to: &'a Polygon,
    casters: &'a [Polygon],
    normal: Vec3,
}

impl Pair<'_> {
    fn light(&self, part: &Polygon) -> Light {
        nodes(part, ORDER).iter().fold(Light::default(), |light, (point, weight)| {
            let factor = |target: &Polygon| point_factor(point, &self.normal, target.corners());
            let open = factor(self.to);
            let pieces = visible(self.to, self.casters, Eye::Point(*point));
            let seen = if pieces.len() == 1 && pieces[0].area() >= self.to.area() {
                open
            } else {
                pieces.iter().map(factor).sum::<f64>().min(open)
            };
            light.plus(Light { seen: weight * seen, open: weight * open })
        })
    }

    /// The light of a part whose rule returned `coarse`, on quarters until it changes by no more than
    /// `tolerance`.
    fn refine(&self, part: &Polygon, coarse: Light, tolerance: f64, depth: u32) -> Light {
        let quarters: Vec<(Polygon, Light)> =
            quarters(part).into_iter().map(|quarter| (quarter.clone(), self.light(&quarter))).collect();
        let fine = quarters.iter().fold(Light::default(), |sum, (_, light)| sum.plus(*light));
        let settled =
            (fine.is_whole() && coarse.is_whole()) || GAIN * (fine.seen - coarse.seen).abs() <= tolerance;
        if settled || depth == 0 {
            return fine;
        }
        // errors of the quarters have either sign, so they add in quadrature
        let refined =
            quarters.iter().map(|(quarter, light)| self.refine(quarter, *light, 0.5 * tolerance, depth - 1));
        refined.fold(Light::default(), Light::plus)
    }
}

/// A polygon divided into triangles or quadrilaterals.
fn fan(polygon: &Polygon) -> Vec<Polygon> {
    let corners = polygon.corners();
    if corners.len() <= 4 {
        return vec![polygon.clone()];
    }
    corners[1..]
        .windows(2)
        .map(|pair| Polygon::new(&[corners[0], pair[0], pair[1]]))
        .filter(|part| part.area() > 0.0)
        .collect()
}

/// The four parts between the middles of the sides; for a triangle, two quadrilaterals and two triangles.
fn quarters(polygon: &Polygon) -> Vec<Polygon> {
    let corner = |u: f64, v: f64| polygon.at(u, v).0;
    let quarter = |u: f64, v: f64| {
        let corners = [corner(u, v), corner(u + 0.5, v), corner(u + 0.5, v + 0.5), corner(u, v + 0.5)];
        Polygon::new(&corners)
    };
    [(0.0, 0.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)].map(|(u, v)| quarter(u, v)).into()
}
