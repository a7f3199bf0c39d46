//! Blocks of the exchange matrix between functions on the two panels.

use nalgebra::{DMatrix, DMatrixViewMut};
use rayon::prelude::*;

use super::compressed::Compressed;
use super::exchange::Exchange;
use super::nodes::Nodes;
use super::rows::{RowWeights, Rows};
use super::space::Space;
use crate::geometry::Fold;

/// Blocks of the exchange matrix, computed from the `table` of strip pairs along the crease.
pub(super) struct Blocks<'a> {
    spaces: [&'a Space; 2],
    rows: Rows<'a>,
    table: &'a DMatrix<f64>,
}

impl<'a> Blocks<'a> {
    /// For functions on panel 0 of `fold` by functions on panel 1.
    pub(super) fn new(
        fold: &Fold,
        spaces: [&'a Space; 2],
        nodes: &'a Nodes,
        table: &'a DMatrix<f64>,
    ) -> Self {
        Self { spaces, rows: Rows::new(fold, spaces.map(Space::order), nodes), table }
    }

    /// The full matrix.
    pub(super) fn dense(&self) -> DMatrix<f64> {
        let [of, with] = self.spaces;
        let (height, width) = (of.len(), with.of_strip());
        let mut matrix = DMatrix::zeros(height, with.len());
        let strips = matrix.as_mut_slice().par_chunks_exact_mut(width * height).enumerate();
        strips.for_each(|(j, columns)| {
            let mut columns = DMatrixViewMut::from_slice(columns, height, width);
            for i in 0..of.across.ends.len() {
                self.set([i, j], columns.rows_mut(i * of.of_strip(), of.of_strip()));
            }
        });
        matrix
    }

    /// The blocks without entries below `negligible`; for panels that are `alike`, the upper triangle with
    /// half the diagonal.
    pub(super) fn exchange(&self, alike: bool, negligible: f64) -> Exchange {
        let [of, with] = self.spaces;
        let first_column = if alike { 0 } else { of.len() };
        let strip = |j: usize| {
            let mut block = DMatrix::zeros(of.of_strip(), with.of_strip());
            let last = if alike { j } else { of.across.ends.len() - 1 };
            let mut compressed = |i: usize| {
                self.set([i, j], block.as_view_mut());
                if alike && i == j {
                    block.fill_lower_triangle(0.0, 1);
                    block.set_diagonal(&(0.5 * block.diagonal()));
                }
                Compressed::new(&block, [i * of.of_strip(), first_column + j * with.of_strip()], negligible)
            };
            (0..=last).map(&mut compressed).collect()
        };
        Exchange {
            unlike: (!alike).then(|| [of.len(), with.len()]),
            strips: (0..with.across.ends.len()).into_par_iter().map(strip).collect(),
        }
    }

    /// Computes the light on strip `i` of panel 0 from strip `j` of panel 1.
    fn set(&self, [i, j]: [usize; 2], mut out: DMatrixViewMut<f64>) {
        let [of, with] = self.spaces;
        let RowWeights { first, weights } = self.rows.weights(of.across.ends[i], with.across.ends[j]);
        let (strips_of, strips_with) = (of.along.ends.len(), with.along.ends.len());
        let (order, of_degree) = (of.order(), of.order() * strips_of * strips_with);
        for d in 0..with.order() {
            // The same number of degrees along the crease goes with one across it as the other way round.
            let of_pairs = weights.columns(0, order * with.degrees(d));
            let block = self.table.view((d * of_degree, first), (of_degree, weights.nrows())) * of_pairs;
            for (mn, values) in block.column_iter().enumerate() {
                let (m, n) = (mn % order, mn / order);
                for f in 0..strips_with {
                    let mut column = out.column_mut(with.first(n) + d * strips_with + f);
                    // Degrees along the crease that are too high come last.
                    let column = &mut column.as_mut_slice()[of.first(m)..of.first(m + 1)];
                    column.copy_from_slice(&values.as_slice()[f * order * strips_of..][..column.len()]);
                }
            }
        }
    }
}
