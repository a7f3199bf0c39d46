//! Form factors of two polygons that others hide from each other in part.
//!
//! From a point on one the visible part of the other is exact (`shadow`); what is left is a function with
//! kinks, integrated on quarters of the polygon until they agree with the whole. The visible share multiplies
//! the exact unhidden exchange, so that nothing is lost where nothing is hidden and nothing is left where all
//! is.

use super::far::nodes;
use super::shadow::{Eye, point_factor, visible};
use crate::geometry::Vec3;
use crate::surfaces::polygon::Polygon;

/// How often a polygon is quartered.
const DEPTH_MAX: u32 = 4;
/// Error of a rule on quarters, relative to its difference from that on the whole, of a function with kinks.
const GAIN: f64 = 0.25;
/// Order of the rule on each part.
const ORDER: usize = 2;

/// Light that arrives, and that would if nothing stood between.
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

/// Share in [0, 1] of the unhidden exchange between `a` and `b`, each wholly in front of the other, that
/// `casters` between them let pass; wrong by about `tolerance`.
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

    /// The light of a part whose rule gave `coarse`, on quarters until it changes by no more than
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
        // Errors of the quarters have either sign: they add up as their root of squares.
        let refined =
            quarters.iter().map(|(quarter, light)| self.refine(quarter, *light, 0.5 * tolerance, depth - 1));
        refined.fold(Light::default(), Light::plus)
    }
}

/// A polygon as triangles or quadrilaterals.
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

/// The four parts between the middles of the sides; of a triangle two are quadrilaterals and two triangles.
fn quarters(polygon: &Polygon) -> Vec<Polygon> {
    let corner = |u: f64, v: f64| polygon.at(u, v).0;
    let quarter = |u: f64, v: f64| {
        let corners = [corner(u, v), corner(u + 0.5, v), corner(u + 0.5, v + 0.5), corner(u, v + 0.5)];
        Polygon::new(&corners)
    };
    [(0.0, 0.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)].map(|(u, v)| quarter(u, v)).into()
}
