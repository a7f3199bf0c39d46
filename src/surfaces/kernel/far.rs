//! Form factors of two polygons that are far apart relative to their size, by Gauss rules on both.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::geometry::Vec3;
use crate::kernel::quadrature::Rule;
use crate::surfaces::polygon::Polygon;

/// Beyond this order of Gauss rule the contour integral is cheaper.
pub(super) const ORDER_MAX: usize = 6;
/// Default truncation error, relative.
pub(super) const TOLERANCE: f64 = 1e-10;

static RULES: LazyLock<Vec<Rule>> = LazyLock::new(|| (1..=ORDER_MAX).map(Rule::gauss_legendre).collect());

/// Points of a Gauss rule on a polygon, weighted by area.
pub(super) type Nodes = Vec<(Vec3, f64)>;

/// Area times form factor between mutually visible polygons with these unit normals, by their nodes.
pub(super) fn exchange([a, b]: [&[(Vec3, f64)]; 2], [normal_a, normal_b]: [Vec3; 2]) -> f64 {
    let mut sum = 0.0;
    for (p, weight_p) in a {
        for (q, weight_q) in b {
            let ray = q - p;
            let square = ray.norm_squared();
            sum -= weight_p * weight_q * ray.dot(&normal_a) * ray.dot(&normal_b) / (square * square);
        }
    }
    sum / PI
}

/// Gauss orders with which [`exchange`] reaches a relative `tolerance` for two polygons in spheres of radii
/// `radii` whose centres are `distance` apart; none if they are too near, or have more than four corners.
pub(super) fn orders(
    polygons: [&Polygon; 2],
    radii: [f64; 2],
    distance: f64,
    tolerance: f64,
) -> Option<[usize; 2]> {
    if polygons.iter().any(|polygon| polygon.corners().len() > 4) {
        return None;
    }
    let gap = distance - radii[0] - radii[1];
    Some([order(radii[0], gap, tolerance)?, order(radii[1], gap, tolerance)?])
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

/// Nodes of a tensor rule on a triangle or quadrilateral.
pub(super) fn nodes(polygon: &Polygon, order: usize) -> Nodes {
    let rule = &RULES[order.clamp(1, ORDER_MAX) - 1];
    let node = |(u, weight_u): (f64, f64)| {
        rule.on(0.0, 1.0).map(move |(v, weight_v)| {
            let (point, area) = polygon.at(u, v);
            (point, weight_u * weight_v * area)
        })
    };
    rule.on(0.0, 1.0).flat_map(node).collect()
}
