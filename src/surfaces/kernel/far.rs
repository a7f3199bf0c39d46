//! Form factors of two polygons that are far apart relative to their size, by Gauss rules on both.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::geometry::Vec3;
use crate::kernel::quadrature::Rule;
use crate::surfaces::polygon::Polygon;

/// Beyond this order of Gauss rule the contour integral is cheaper.
const ORDER_MAX: usize = 6;
/// Default truncation error, relative.
pub const TOLERANCE: f64 = 1e-10;

static RULES: LazyLock<Vec<Rule>> = LazyLock::new(|| (1..=ORDER_MAX).map(Rule::gauss_legendre).collect());

/// Area times form factor between mutually visible triangles or quadrilaterals, to a relative `tolerance`;
/// none if they are too near.
///
/// `a` and `b` lie in spheres of radii `radii` whose centres are `distance` apart.
#[must_use]
pub fn exchange(a: &Polygon, b: &Polygon, radii: [f64; 2], distance: f64, tolerance: f64) -> Option<f64> {
    if a.corners().len() > 4 || b.corners().len() > 4 {
        return None;
    }
    let gap = distance - radii[0] - radii[1];
    let [nodes_a, nodes_b] =
        [nodes(a, order(radii[0], gap, tolerance)?), nodes(b, order(radii[1], gap, tolerance)?)];
    let mut sum = 0.0;
    for (p, weight_p) in &nodes_a {
        for (q, weight_q) in &nodes_b {
            let ray = q - p;
            let square = ray.norm_squared();
            sum -= weight_p * weight_q * ray.dot(&a.normal()) * ray.dot(&b.normal()) / (square * square);
        }
    }
    Some(sum / PI)
}

/// Gauss order for a polygon of this radius at this gap from its neighbour, if moderate (Trefethen,
/// *Approximation Theory and Approximation Practice*, theorem 19.3).
fn order(radius: f64, gap: f64, tolerance: f64) -> Option<usize> {
    if gap <= 0.0 {
        return None;
    }
    let order = (-tolerance.ln() / (2.0 * (gap / radius).asinh())).ceil() as usize;
    (order <= ORDER_MAX).then_some(order.max(1))
}

/// Points of a tensor Gauss rule on a triangle or quadrilateral, weighted by area.
#[must_use]
pub fn nodes(polygon: &Polygon, order: usize) -> Vec<(Vec3, f64)> {
    let rule = &RULES[order.clamp(1, ORDER_MAX) - 1];
    let node = |(u, weight_u): (f64, f64)| {
        rule.on(0.0, 1.0).map(move |(v, weight_v)| {
            let (point, area) = polygon.at(u, v);
            (point, weight_u * weight_v * area)
        })
    };
    rule.on(0.0, 1.0).flat_map(node).collect()
}
