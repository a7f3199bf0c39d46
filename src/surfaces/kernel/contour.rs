//! Form factors of two mutually visible polygons, as integrals around their edges.
//!
//! Stokes' theorem converts the two area integrals of eq. (2) into `A·F = (1/2π) ∮∮ ln r dl·dl'` (Sparrow
//! 1963). Around one polygon the integral has a closed form, and for parallel edges so does the other. The
//! remaining one is computed by a Gauss rule of the order required by the nearest singularity, on intervals
//! that shrink towards points where edges meet.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::geometry::Vec3;
use crate::kernel::quadrature::Rule;
use crate::surfaces::polygon::Polygon;

/// Highest order of a rule; if the integrand requires more, the interval is halved.
const ORDER_MAX: usize = 16;
/// Truncation error of the rules, relative to the integral along an edge.
const TOLERANCE: f64 = 1e-13;
/// Intervals shorter than this, relative to the edge, are negligible.
const SHORTEST: f64 = 1e-8;
/// Sine of an angle below which edges count as parallel.
const PARALLEL: f64 = 1e-10;

static RULES: LazyLock<Vec<Rule>> = LazyLock::new(|| (1..=ORDER_MAX).map(Rule::gauss_legendre).collect());

/// Area times form factor between `a` and `b`, each wholly in front of the other, in the unit of length
/// squared.
///
/// # Example
/// ```
/// use vfold::surfaces::Polygon;
/// use vfold::geometry::Vec3;
/// use vfold::surfaces::kernel::contour::exchange;
/// let [o, x, y, z] = [Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()];
/// let floor = Polygon::new(&[o, x, x + y, y]);
/// let wall = Polygon::new(&[o, y, y + z, z]);
/// // Two squares at a right angle exchange 0.20004 of their light (Howell, configuration C-14).
/// assert!((exchange(&floor, &wall) - 0.20004377607540316).abs() < 1e-12);
/// ```
#[must_use]
pub fn exchange(a: &Polygon, b: &Polygon) -> f64 {
    // ln r is arbitrary up to a constant, which cancels along a closed contour: in units of the distance it
    // is small
    let unit = (a.corners()[0] - b.corners()[0]).norm().max(a.diameter()).max(b.diameter());
    let edges =
        |polygon: &Polygon| polygon.edges().map(|(from, to)| Edge::new(from, to, unit)).collect::<Vec<_>>();
    let (a, b) = (edges(a), edges(b));
    let pairs = a.iter().flat_map(|along| b.iter().map(move |other| along.with(other)));
    unit * unit * pairs.sum::<f64>() / (2.0 * PI)
}

/// One side of a polygon.
struct Edge {
    start: Vec3,
    direction: Vec3,
    length: f64,
}

impl Edge {
    fn new(from: Vec3, to: Vec3, unit: f64) -> Self {
        let along = (to - from) / unit;
        let length = along.norm();
        Self { start: from / unit, direction: along / length.max(f64::MIN_POSITIVE), length }
    }

    /// `∫∫ ln r dl·dl'` along both edges.
    fn with(&self, other: &Self) -> f64 {
        let cos = self.direction.dot(&other.direction);
        if self.length < SHORTEST * SHORTEST || other.length < SHORTEST * SHORTEST || cos.abs() < PARALLEL {
            return 0.0;
        }
        if self.direction.cross(&other.direction).norm() < PARALLEL {
            return cos * self.with_parallel(other, cos.signum());
        }
        // the longer edge in closed form: the shorter one needs fewer nodes
        let (outer, inner) = if self.length < other.length { (self, other) } else { (other, self) };
        let singularities = outer.singularities(inner);
        cos * outer.integrate(inner, &singularities, 0.0, outer.length)
    }

    /// The same in closed form, by the second antiderivative of `½ ln(h² + z²)` at the differences of the
    /// ends.
    fn with_parallel(&self, other: &Self, sign: f64) -> f64 {
        let apart = other.start - self.start;
        let (z, h) = (apart.dot(&self.direction), apart.cross(&self.direction).norm());
        let end = z + sign * other.length;
        let g = |z: f64| second_antiderivative(z, h);
        sign * ((g(end) - g(z)) - (g(end - self.length) - g(z - self.length)))
    }

    /// `∫ ln r dl` along this edge, seen from `point`.
    fn logarithm(&self, point: &Vec3) -> f64 {
        let apart = self.start - point;
        let (t, h) = (apart.dot(&self.direction), apart.cross(&self.direction).norm());
        antiderivative(t + self.length, h) - antiderivative(t, h)
    }

    /// Complex positions `re ± i·im` along this edge at which the integral around `inner` is singular.
    fn singularities(&self, inner: &Self) -> [(f64, f64); 3] {
        let end = |distance: f64| {
            let apart = inner.start + distance * inner.direction - self.start;
            (apart.dot(&self.direction), apart.cross(&self.direction).norm())
        };
        [end(0.0), end(inner.length), self.crossing(inner).unwrap_or_else(|| end(0.0))]
    }

    /// The point nearest to the line of `inner`, if the nearest point on that line is on `inner` itself.
    fn crossing(&self, inner: &Self) -> Option<(f64, f64)> {
        let normal = self.direction.cross(&inner.direction);
        let apart = (self.start - inner.start).cross(&inner.direction);
        let square = normal.norm_squared();
        let re = -apart.dot(&normal) / square;
        let foot = (self.start + re * self.direction - inner.start).dot(&inner.direction);
        (0.0..=inner.length).contains(&foot).then(|| (re, apart.cross(&normal).norm() / square))
    }

    /// `∫ ∫ ln r` over `inner` and the part of this edge from `low` to `high`.
    fn integrate(&self, inner: &Self, singularities: &[(f64, f64)], low: f64, high: f64) -> f64 {
        let order = |(re, im): &(f64, f64)| gauss_order(low - re, high - re, *im);
        let order = singularities.iter().map(order).fold(1.0, f64::max);
        if order > ORDER_MAX as f64 && high - low > SHORTEST * self.length {
            let middle = 0.5 * (low + high);
            let near = singularities.iter().map(|(re, _)| *re).filter(|re| *re > low && *re < high);
            // halved, unless a singularity inside is a better end
            let cut = near.min_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs())).unwrap_or(middle);
            let cut = if (cut - low).min(high - cut) < 1e-3 * (high - low) { middle } else { cut };
            return self.integrate(inner, singularities, low, cut)
                + self.integrate(inner, singularities, cut, high);
        }
        let rule = &RULES[(order.min(ORDER_MAX as f64) as usize).max(1) - 1];
        rule.on(low, high)
            .map(|(s, weight)| weight * inner.logarithm(&(self.start + s * self.direction)))
            .sum()
    }
}

/// Order of the Gauss rule on `[low, high]` for singularities at `±i·im` (Trefethen, *Approximation Theory
/// and Approximation Practice*, theorem 19.3).
fn gauss_order(low: f64, high: f64, im: f64) -> f64 {
    let axis = (low.hypot(im) + high.hypot(im)) / (high - low);
    let rho = axis + (axis * axis - 1.0).max(0.0).sqrt();
    (-TOLERANCE.ln() / (2.0 * rho.ln())).ceil()
}

/// `∫ ½ ln(h² + t²) dt`.
fn antiderivative(t: f64, h: f64) -> f64 {
    let square = h * h + t * t;
    if square == 0.0 { 0.0 } else { 0.5 * t * square.ln() - t + h * t.atan2(h) }
}

/// `∫∫ ½ ln(h² + z²) dz²`.
fn second_antiderivative(z: f64, h: f64) -> f64 {
    let square = h * h + z * z;
    let logarithm = if square == 0.0 { 0.0 } else { 0.25 * (z * z - h * h) * square.ln() };
    logarithm - 0.75 * z * z + h * z * z.atan2(h)
}
