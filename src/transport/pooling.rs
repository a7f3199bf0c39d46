//! Facet means from values on a grid of points on both panels.

use ndarray::{Array2, Array3, ArrayView1, Axis};

use crate::geometry::Fold;
use crate::kernel::quadrature::{Lagrange, Rule};

/// Quadrature points of a facet in either direction.
const PLACES: usize = 3;

/// Weights of the grid values in the facet means, away from the crease and along it, the same for both
/// panels.
pub(super) struct Pooling {
    out: Array2<f64>,
    along: Array2<f64>,
}

impl Pooling {
    /// Means of the polynomials through all points, which are given as fractions of the panel's sides.
    pub fn smooth(fold: &Fold, out: &[f64], along: &[f64]) -> Self {
        let polynomial = |nodes: &[f64]| {
            let lagrange = Lagrange::new(nodes);
            move |x: f64, weights: &mut [f64]| lagrange.at(x, weights)
        };
        Self::new(fold, [out.len(), along.len()], polynomial(out), polynomial(along))
    }

    /// Means of linear interpolation between neighbouring points, extrapolated at the ends.
    pub fn straight(fold: &Fold, out: &[f64], along: &[f64]) -> Self {
        let lines = |nodes: Vec<f64>| {
            move |x: f64, weights: &mut [f64]| {
                weights.fill(0.0);
                let low = nodes.partition_point(|node| *node < x).clamp(1, nodes.len() - 1) - 1;
                let into = (x - nodes[low]) / (nodes[low + 1] - nodes[low]);
                weights[low] = 1.0 - into;
                weights[low + 1] = into;
            }
        };
        Self::new(fold, [out.len(), along.len()], lines(out.to_vec()), lines(along.to_vec()))
    }

    fn new(
        fold: &Fold,
        [out_nodes, along_nodes]: [usize; 2],
        out: impl Fn(f64, &mut [f64]),
        along: impl Fn(f64, &mut [f64]),
    ) -> Self {
        let cols = fold.facets().cols;
        let col_edges: Vec<f64> = (0..=cols).map(|edge| edge as f64 / cols as f64).collect();
        let row_edges = fold.spacing().edges(fold.facets().rows);
        Self { out: means(&row_edges, out_nodes, out), along: means(&col_edges, along_nodes, along) }
    }

    /// Facet means of the rows of `values`, which are points in the order panel, away from the crease, along
    /// it. Columns are kept.
    pub fn pool(&self, values: &Array2<f64>) -> Array2<f64> {
        let [rows, out] = [self.out.nrows(), self.out.ncols()];
        let [cols, along] = [self.along.nrows(), self.along.ncols()];
        let others = values.ncols();
        let mut pooled = Array2::zeros((2 * rows * cols, others));
        for panel in 0..2 {
            // along the crease first
            let mut lines = Array3::<f64>::zeros((out, cols, others));
            for ((line, col), weights) in (0..out).flat_map(|line| {
                self.along.outer_iter().enumerate().map(move |(col, weights)| ((line, col), weights))
            }) {
                for (place, weight) in counting(weights) {
                    let value = values.row((panel * out + line) * along + place);
                    lines.index_axis_mut(Axis(0), line).row_mut(col).scaled_add(*weight, &value);
                }
            }
            for (row, weights) in self.out.outer_iter().enumerate() {
                for (line, weight) in counting(weights) {
                    for col in 0..cols {
                        let value = lines.index_axis(Axis(0), line);
                        pooled
                            .row_mut((panel * rows + row) * cols + col)
                            .scaled_add(*weight, &value.row(col));
                    }
                }
            }
        }
        pooled
    }
}

/// Nonzero weights with their indices.
fn counting(weights: ArrayView1<'_, f64>) -> impl Iterator<Item = (usize, &f64)> {
    weights.into_iter().enumerate().filter(|(_, weight)| **weight != 0.0)
}

/// Mean weights over each interval between `edges`.
fn means(edges: &[f64], nodes: usize, at: impl Fn(f64, &mut [f64])) -> Array2<f64> {
    let rule = Rule::gauss_legendre(PLACES);
    let mut means = Array2::zeros((edges.len() - 1, nodes));
    let mut weights = vec![0.0; nodes];
    for (mut mean, ends) in means.outer_iter_mut().zip(edges.windows(2)) {
        for (x, weight) in rule.on(ends[0], ends[1]) {
            at(x, &mut weights);
            let share = weight / (ends[1] - ends[0]);
            mean.iter_mut().zip(&weights).for_each(|(mean, value)| *mean += share * value);
        }
    }
    means
}
