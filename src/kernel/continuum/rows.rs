//! Across the crease: pairs of strips, one on each panel.
//!
//! Relative to a point at distance s, the other panel's points are `t = s·(cosθ + sinθ·sinh w)`, at the
//! distance `q = s·sinθ·cosh w`; in w the kernel's singularities stay `π/2` away from the real axis, however
//! narrow the fold.

use std::borrow::Cow;
use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::Range;

use nalgebra::{DMatrix, DMatrixView, DVectorView};

use super::nodes::Nodes;
use super::strips::polynomials;
use crate::geometry::Fold;
use crate::kernel::quadrature::{Rule, bernstein_rho};

/// Longest Gauss panel in w, for which the singularities leave ρ = 4.4.
const INNER_PANEL: f64 = 1.5;
/// Minimum ρ of a Gauss panel in s.
const OUTER_RHO: f64 = 3.0;
/// Halvings of a strip that ends at the crease, after which terms in s·ln s are small.
const HALVINGS: usize = 4;

/// Integrals over pairs of strips across the crease of a fold.
pub(super) struct Rows<'a> {
    sin: f64,
    cos: f64,
    /// `1 − cosθ`, computed without cancellation for small θ.
    one_minus_cos: f64,
    nodes: &'a Nodes,
    /// Number of polynomials on the strips of each panel.
    orders: [usize; 2],
}

/// Weights of the values at consecutive nodes.
pub(super) struct RowWeights {
    /// The first of the nodes.
    pub(super) first: usize,
    /// Node by pair of polynomials (m, n), m varying fastest.
    pub(super) weights: DMatrix<f64>,
}

impl<'a> Rows<'a> {
    pub(super) fn new(fold: &Fold, orders: [usize; 2], nodes: &'a Nodes) -> Self {
        let theta = fold.angle_rad();
        Self {
            sin: theta.sin(),
            cos: theta.cos(),
            one_minus_cos: 2.0 * (theta / 2.0).sin().powi(2),
            nodes,
            orders,
        }
    }

    /// The rule for polynomials on one panel's strips times a function whose singularities leave this `rho`.
    fn rule(&self, panel: usize, rho: f64) -> Cow<'static, Rule> {
        Rule::kept_legendre(self.orders[panel].div_ceil(2) + self.nodes.points(rho))
    }

    /// `∫∫ φ_m(s) φ_n(t) sin²θ·s·t/(π q³) f(q) ds dt` over strips `a` and `b`, as weights of the values of f
    /// at the nodes.
    pub(super) fn weights(&self, a: [f64; 2], b: [f64; 2]) -> RowWeights {
        let [order_a, order_b] = self.orders;
        let (mut points, mut of_points) = (Vec::new(), Vec::new());
        for ([low, high], rho) in self.pieces(a, b) {
            let rule = self.rule(0, rho);
            for (point, weight) in rule.on(low, high) {
                points.push(point);
                of_points.push(weight);
            }
        }
        let mut of_a = polynomials(a, &points, order_a);
        let of_points = DVectorView::from_slice(&of_points, of_points.len());
        of_a.column_iter_mut().for_each(|mut of_a| of_a.component_mul_assign(&of_points));
        let range = self.nodes.between(self.distances(a, b));
        let (first, count) = (range.start, range.len());
        let by_degree = self.inner_integrals(&points, b, range) * of_a;
        let mut weights = DMatrix::zeros(count, order_a * order_b);
        for (m, of_m) in by_degree.column_iter().enumerate() {
            let of_m = DMatrixView::from_slice(of_m.as_slice(), count, order_b);
            for (n, of_pair) in of_m.column_iter().enumerate() {
                weights.set_column(n * order_a + m, &of_pair);
            }
        }
        RowWeights { first, weights }
    }

    /// The integrals over t for each of the points s: (node in the range, n) by point.
    fn inner_integrals(&self, points: &[f64], b: [f64; 2], nodes: Range<usize>) -> DMatrix<f64> {
        let (mut t, mut distances, mut factors, mut ends) = (vec![], vec![], vec![], vec![]);
        for s in points {
            let w = |t: f64| (((t - s) + s * self.one_minus_cos) / (s * self.sin)).asinh();
            let (low, high) = (w(b[0]), w(b[1]));
            let panels = ((high - low) / INNER_PANEL).ceil().max(1.0);
            let length = (high - low) / panels;
            let rule = self.rule(1, bernstein_rho([-0.5 * length, 0.5 * length], [0.0, FRAC_PI_2]));
            for panel in 0..panels as usize {
                let start = low + panel as f64 * length;
                for (w, weight) in rule.on(start, start + length) {
                    let (grown, shrunk) = (0.5 * w.exp(), 0.5 * (-w).exp());
                    let (sinh, cosh) = (grown - shrunk, grown + shrunk);
                    t.push((s * (self.cos + self.sin * sinh)).clamp(b[0], b[1]));
                    distances.push(s * self.sin * cosh);
                    // The factors of sin²θ·s·t/(π q³) dt other than t, where dt = q dw and q = s·sinθ·cosh w.
                    factors.push(weight / (PI * s * cosh * cosh));
                }
            }
            ends.push(t.len());
        }
        let mut of_b = polynomials(b, &t, self.orders[1]);
        factors.iter_mut().zip(&t).for_each(|(factor, t)| *factor *= t);
        let factors = DVectorView::from_slice(&factors, factors.len());
        of_b.column_iter_mut().for_each(|mut of_b| of_b.component_mul_assign(&factors));
        let (firsts, at_nodes) = self.nodes.place(&distances);
        let mut integrals = DMatrix::zeros(nodes.len() * self.orders[1], points.len());
        let mut at_node = vec![0.0; self.nodes.on_panel()];
        let mut start = 0;
        for (mut of_point, end) in integrals.column_iter_mut().zip(ends) {
            for p in start..end {
                at_node
                    .iter_mut()
                    .zip(at_nodes[p..].iter().step_by(t.len()))
                    .for_each(|(to, from)| *to = *from);
                let place = firsts[p] - nodes.start;
                // Columns are so short that nalgebra's rank-one update would be slower.
                let of_degrees = of_point.as_mut_slice().chunks_exact_mut(nodes.len());
                for (out, of_b) in of_degrees.zip(&of_b.row(p)) {
                    let out = &mut out[place..place + at_node.len()];
                    out.iter_mut().zip(&at_node).for_each(|(out, at_node)| *out += of_b * at_node);
                }
            }
            start = end;
        }
        integrals
    }

    /// Smallest and largest distance between points of two strips.
    fn distances(&self, a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
        let q = |s: f64, t: f64| ((s - t).powi(2) + 2.0 * s * t * self.one_minus_cos).sqrt();
        let nearest = |s: f64, other: [f64; 2]| q(s, (s * self.cos).clamp(other[0], other[1]));
        let near = [nearest(a[0], b), nearest(a[1], b), nearest(b[0], a), nearest(b[1], a)];
        let far = [q(a[0], b[0]), q(a[0], b[1]), q(a[1], b[0]), q(a[1], b[1])];
        [near.into_iter().fold(f64::INFINITY, f64::min), far.into_iter().fold(0.0, f64::max)]
    }

    /// Divides strip `a` where the inner integral over `b` varies, near the ends of `b` and the crease;
    /// returns the pieces with the ρ that the singularities leave each.
    fn pieces(&self, a: [f64; 2], b: [f64; 2]) -> Vec<([f64; 2], f64)> {
        let mut pieces = vec![a];
        // Towards the crease the integrals behave like s·ln s, which no polynomial follows; repeated halving
        // makes the remainder harmless.
        for _ in 0..if a[0] > 0.0 { 0 } else { HALVINGS } {
            let [low, high] = pieces[0];
            pieces.splice(0..1, [[low, 0.5 * high], [0.5 * high, high]]);
        }
        let mut done = Vec::new();
        while let Some([low, high]) = pieces.pop() {
            let rho = |t: f64| bernstein_rho([low, high], [t * self.cos, t * self.sin]);
            let of_ends = b.into_iter().filter(|t| *t > 0.0).map(rho).fold(f64::INFINITY, f64::min);
            if of_ends < OUTER_RHO {
                let middle = 0.5 * (low + high);
                pieces.extend([[low, middle], [middle, high]]);
            } else {
                done.push(([low, high], of_ends.min(rho(0.0)).max(OUTER_RHO)));
            }
        }
        done
    }
}
