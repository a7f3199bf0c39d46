//! Across the crease: pairs of strips, one on each panel.
//!
//! For a point at distance s the other panel's points are `t = s·(cosθ + sinθ·sinh w)`, at the distance
//! `q = s·sinθ·cosh w`; in w the kernel's singularities stay `π/2` away from the real axis, however narrow the fold.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DMatrixView, DMatrixViewMut, DVector};

use super::strips::polynomials;
use super::table::Nodes;
use crate::geometry::Fold;
use crate::kernel::quadrature::Rule;

/// Longest Gauss panel in w.
const INNER_PANEL: f64 = 1.5;
/// Least sum of distances to a singularity, relative to the length of a Gauss panel in s: ρ = 3.
const OUTER_AXIS: f64 = 1.7;
/// Gauss points beyond those that the polynomials need.
const SPARE_POINTS: usize = 5;
/// Halvings of a strip that ends at the crease, where logarithms of s are small.
const HALVINGS: usize = 4;

/// Integrals over pairs of strips across the crease of a fold.
pub(super) struct Rows {
    sin: f64,
    cos: f64,
    /// `1 − cosθ`, which would lose digits as a difference when θ is small.
    one_minus_cos: f64,
    order: usize,
    rule: Rule,
}

impl Rows {
    pub(super) fn new(fold: &Fold, order: usize) -> Self {
        let theta = fold.angle_rad();
        Self {
            sin: theta.sin(),
            cos: theta.cos(),
            one_minus_cos: 2.0 * (theta / 2.0).sin().powi(2),
            order,
            rule: Rule::gauss_legendre(order + SPARE_POINTS),
        }
    }

    /// `∫∫ φ_m(s) φ_n(t) sin²θ·s·t/(π q³) f(q) ds dt` over strips `a` and `b` as weights of the values of f at the nodes:
    /// node by (m, n), n fast.
    pub(super) fn weights(&self, a: [f64; 2], b: [f64; 2], nodes: &Nodes) -> DMatrix<f64> {
        let order = self.order;
        let pieces = self.pieces(a, b).into_iter();
        let points: Vec<_> = pieces.flat_map(|[low, high]| self.rule.on(low, high)).collect();
        // One column per point s: φ_m(s), and the integrals over t, n by node.
        let mut of_a = DMatrix::zeros(order, points.len());
        let mut inner = DMatrix::zeros(order * nodes.len(), points.len());
        let columns = of_a.column_iter_mut().zip(inner.column_iter_mut());
        for ((s, weight), (mut of_a, mut inner)) in points.into_iter().zip(columns) {
            polynomials(a, s, of_a.as_mut_slice());
            of_a *= weight;
            let inner = DMatrixViewMut::from_slice(inner.as_mut_slice(), order, nodes.len());
            self.integrate(s, b, nodes, inner);
        }
        let weights = inner * of_a.transpose();
        let mut of_pairs = DMatrix::zeros(nodes.len(), order * order);
        for (m, weights) in weights.column_iter().enumerate() {
            let weights = DMatrixView::from_slice(weights.as_slice(), order, nodes.len());
            of_pairs.columns_mut(m * order, order).tr_copy_from(&weights);
        }
        of_pairs
    }

    /// Adds to `out` the integral over t for one s: n by node.
    fn integrate(&self, s: f64, b: [f64; 2], nodes: &Nodes, mut out: DMatrixViewMut<f64>) {
        let w = |t: f64| (((t - s) + s * self.one_minus_cos) / (s * self.sin)).asinh();
        let (low, high) = (w(b[0]), w(b[1]));
        let panels = ((high - low) / INNER_PANEL).ceil().max(1.0);
        let length = (high - low) / panels;
        let (mut of_b, mut at_nodes) = (DVector::zeros(self.order), DVector::zeros(nodes.on_panel()));
        for panel in 0..panels as usize {
            let start = low + panel as f64 * length;
            for (w, weight) in self.rule.on(start, start + length) {
                let (sinh, cosh) = (w.sinh(), w.cosh());
                let t = (s * (self.cos + self.sin * sinh)).clamp(b[0], b[1]);
                polynomials(b, t, of_b.as_mut_slice());
                // What is left of sin²θ·s·t/(π q³) dt, where dt = q dw and q = s·sinθ·cosh w.
                let factor = weight * t / (PI * s * cosh * cosh);
                let first = nodes.place(s * self.sin * cosh, at_nodes.as_mut_slice());
                // Columns are so short that nalgebra's update of rank one would take longer.
                for (mut out, at_node) in
                    out.columns_mut(first, nodes.on_panel()).column_iter_mut().zip(&at_nodes)
                {
                    out.as_mut_slice()
                        .iter_mut()
                        .zip(&of_b)
                        .for_each(|(out, p)| *out += factor * at_node * p);
                }
            }
        }
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
