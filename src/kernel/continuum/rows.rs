//! Across the crease: pairs of strips, one on each panel.
//!
//! For a point at distance s the other panel's points are `t = s·(cosθ + sinθ·sinh w)`, at the distance
//! `q = s·sinθ·cosh w`; in w the kernel's singularities stay `π/2` away from the real axis, however narrow the fold.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DMatrixView};

use super::strips::polynomials;
use super::table::Nodes;
use crate::geometry::Fold;
use crate::kernel::quadrature::Rule;

/// Longest Gauss panel in w, which the singularities leave with ρ = 4.4.
const INNER_PANEL: f64 = 1.5;
/// Least sum of distances to a singularity, relative to the length of a Gauss panel in s: ρ = 3.
const OUTER_AXIS: f64 = 1.7;
/// Halvings of a strip that ends at the crease, where logarithms of s are small.
const HALVINGS: usize = 4;

/// Integrals over pairs of strips across the crease of a fold.
pub(super) struct Rows<'a> {
    sin: f64,
    cos: f64,
    /// `1 − cosθ`, which would lose digits as a difference when θ is small.
    one_minus_cos: f64,
    nodes: &'a Nodes,
    /// Polynomials on the strips of either panel.
    orders: [usize; 2],
    outer: Rule,
    inner: Rule,
}

/// Weights of the values at consecutive nodes.
pub(super) struct RowWeights {
    /// The first of the nodes.
    pub(super) first: usize,
    /// Node by pair of polynomials (m, n), m fast.
    pub(super) weights: DMatrix<f64>,
}

impl<'a> Rows<'a> {
    pub(super) fn new(fold: &Fold, orders: [usize; 2], nodes: &'a Nodes) -> Self {
        let theta = fold.angle_rad();
        let rule = |order: usize, rho: f64| Rule::gauss_legendre(order.div_ceil(2) + nodes.points(rho));
        Self {
            sin: theta.sin(),
            cos: theta.cos(),
            one_minus_cos: 2.0 * (theta / 2.0).sin().powi(2),
            nodes,
            orders,
            outer: rule(orders[0], 3.0),
            inner: rule(orders[1], 4.4),
        }
    }

    /// `∫∫ φ_m(s) φ_n(t) sin²θ·s·t/(π q³) f(q) ds dt` over strips `a` and `b` as weights of the values of f at the nodes.
    pub(super) fn weights(&self, a: [f64; 2], b: [f64; 2]) -> RowWeights {
        let [order_a, order_b] = self.orders;
        let pieces = self.pieces(a, b).into_iter();
        let points: Vec<_> = pieces.flat_map(|[low, high]| self.outer.on(low, high)).collect();
        let range = self.nodes.between(self.distances(a, b));
        let (first, count) = (range.start, range.len());
        // One column per point s: φ_m(s), and the integrals over t, node by n.
        let mut of_a = DMatrix::zeros(order_a, points.len());
        let mut inner = DMatrix::zeros(count * order_b, points.len());
        let columns = of_a.column_iter_mut().zip(inner.column_iter_mut());
        for ((s, weight), (mut of_a, mut inner)) in points.into_iter().zip(columns) {
            polynomials(a, s, of_a.as_mut_slice());
            of_a *= weight;
            self.integrate(s, b, first, inner.as_mut_slice());
        }
        let by_degree = inner * of_a.transpose();
        let mut weights = DMatrix::zeros(count, order_a * order_b);
        for (m, of_m) in by_degree.column_iter().enumerate() {
            let of_m = DMatrixView::from_slice(of_m.as_slice(), count, order_b);
            for (n, of_pair) in of_m.column_iter().enumerate() {
                weights.set_column(n * order_a + m, &of_pair);
            }
        }
        RowWeights { first, weights }
    }

    /// Adds to `out` the integral over t for one s: node, from `first` on, by n.
    fn integrate(&self, s: f64, b: [f64; 2], first: usize, out: &mut [f64]) {
        let w = |t: f64| (((t - s) + s * self.one_minus_cos) / (s * self.sin)).asinh();
        let (low, high) = (w(b[0]), w(b[1]));
        let panels = ((high - low) / INNER_PANEL).ceil().max(1.0);
        let length = (high - low) / panels;
        let (mut of_b, mut at_nodes) = (vec![0.0; self.orders[1]], vec![0.0; self.nodes.on_panel()]);
        let count = out.len() / self.orders[1];
        for panel in 0..panels as usize {
            let start = low + panel as f64 * length;
            for (w, weight) in self.inner.on(start, start + length) {
                let (grown, shrunk) = (0.5 * w.exp(), 0.5 * (-w).exp());
                let (sinh, cosh) = (grown - shrunk, grown + shrunk);
                let t = (s * (self.cos + self.sin * sinh)).clamp(b[0], b[1]);
                polynomials(b, t, &mut of_b);
                // What is left of sin²θ·s·t/(π q³) dt, where dt = q dw and q = s·sinθ·cosh w.
                let factor = weight * t / (PI * s * cosh * cosh);
                let place = self.nodes.place(s * self.sin * cosh, &mut at_nodes) - first;
                // Columns are so short that nalgebra's update of rank one would take longer.
                for (out, p) in out.chunks_exact_mut(count).zip(&of_b) {
                    let out = &mut out[place..place + at_nodes.len()];
                    out.iter_mut().zip(&at_nodes).for_each(|(out, at_node)| *out += factor * p * at_node);
                }
            }
        }
    }

    /// Least and largest distance between points of two strips.
    fn distances(&self, a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
        let q = |s: f64, t: f64| ((s - t).powi(2) + 2.0 * s * t * self.one_minus_cos).sqrt();
        let nearest = |s: f64, other: [f64; 2]| q(s, (s * self.cos).clamp(other[0], other[1]));
        let near = [nearest(a[0], b), nearest(a[1], b), nearest(b[0], a), nearest(b[1], a)];
        let far = [q(a[0], b[0]), q(a[0], b[1]), q(a[1], b[0]), q(a[1], b[1])];
        [near.into_iter().fold(f64::INFINITY, f64::min), far.into_iter().fold(0.0, f64::max)]
    }

    /// Cuts strip `a` where the inner integral over `b` varies: near the ends of `b` and the crease.
    fn pieces(&self, a: [f64; 2], b: [f64; 2]) -> Vec<[f64; 2]> {
        let mut pieces = vec![a];
        // Towards the crease integrals go as s·ln s, which no polynomial follows: halves of halves make the rest harmless.
        for _ in 0..if a[0] > 0.0 { 0 } else { HALVINGS } {
            let [low, high] = pieces[0];
            pieces.splice(0..1, [[low, 0.5 * high], [0.5 * high, high]]);
        }
        let mut done = Vec::new();
        while let Some([low, high]) = pieces.pop() {
            let singular = |t: f64| {
                let (re, im) = (t * self.cos, t * self.sin);
                t > 0.0 && (low - re).hypot(im) + (high - re).hypot(im) < OUTER_AXIS * (high - low)
            };
            if b.into_iter().any(singular) {
                let middle = 0.5 * (low + high);
                pieces.extend([[low, middle], [middle, high]]);
            } else {
                done.push([low, high]);
            }
        }
        done
    }
}
