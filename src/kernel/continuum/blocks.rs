//! What functions on one panel give to functions on the other.

use nalgebra::{DMatrix, DMatrixViewMut};
use rayon::prelude::*;

use super::compressed::Compressed;
use super::rows::{RowWeights, Rows};
use super::space::Space;
use super::table::Nodes;
use crate::geometry::Fold;

/// What functions on one panel give to functions on the other, from the `table` of their strips along the crease.
pub(super) struct Blocks<'a> {
    spaces: [&'a Space; 2],
    rows: Rows<'a>,
    table: &'a DMatrix<f64>,
}

impl<'a> Blocks<'a> {
    /// Of functions on panel 0 of `fold` by functions on panel 1.
    pub(super) fn new(
        fold: &Fold,
        spaces: [&'a Space; 2],
        nodes: &'a Nodes,
        table: &'a DMatrix<f64>,
    ) -> Self {
        Self { spaces, rows: Rows::new(fold, spaces.map(Space::order), nodes), table }
    }

    /// All of them.
    pub(super) fn dense(&self) -> DMatrix<f64> {
        let [of, with] = self.spaces;
        let (height, width) = (of.len(), with.of_strip());
        let mut matrix = DMatrix::zeros(height, with.len());
        let strips = matrix.as_mut_slice().par_chunks_exact_mut(width * height).enumerate();
        strips.for_each(|(j, columns)| self.set(j, DMatrixViewMut::from_slice(columns, height, width)));
        matrix
    }

    /// Those that are not below `negligible`, one strip of panel 1 after the other.
    pub(super) fn compressed(&self, negligible: f64) -> Vec<Compressed> {
        let [of, with] = self.spaces;
        let strip = |j: usize| {
            let mut columns = DMatrix::zeros(of.len(), with.of_strip());
            self.set(j, columns.as_view_mut());
            Compressed::new(&columns, j * with.of_strip(), negligible)
        };
        (0..with.across.ends.len()).into_par_iter().map(strip).collect()
    }

    /// As [`Blocks::compressed`], of panels that are alike: the upper triangle with half the diagonal.
    pub(super) fn compressed_half(&self, negligible: f64) -> Vec<Compressed> {
        let [of, with] = self.spaces;
        let strip = |j: usize| {
            let (height, width) = ((j + 1) * of.of_strip(), with.of_strip());
            let mut columns = DMatrix::zeros(height, width);
            self.set(j, columns.as_view_mut());
            let mut square = columns.rows_mut(height - width, width);
            square.fill_lower_triangle(0.0, 1);
            square.set_diagonal(&(0.5 * square.diagonal()));
            Compressed::new(&columns, j * width, negligible)
        };
        (0..with.across.ends.len()).into_par_iter().map(strip).collect()
    }

    /// Sets the columns of a strip of panel 1, as many rows as there are in `columns`.
    fn set(&self, j: usize, mut columns: DMatrixViewMut<f64>) {
        let [of, with] = self.spaces;
        for (i, strip) in of.across.ends.iter().enumerate().take(columns.nrows() / of.of_strip()) {
            let weights = self.rows.weights(*strip, with.across.ends[j]);
            set(self.spaces, &weights, self.table, columns.rows_mut(i * of.of_strip(), of.of_strip()));
        }
    }
}

/// Sets what two strips across the crease exchange.
fn set([of, with]: [&Space; 2], rows: &RowWeights, table: &DMatrix<f64>, mut out: DMatrixViewMut<f64>) {
    let table = table.columns(rows.first, rows.weights.nrows());
    let (strips_of, strips_with) = (of.along.ends.len(), with.along.ends.len());
    let (order, pairs) = (of.order(), strips_of * strips_with);
    for d in 0..with.order() {
        // As many degrees along the crease go with one across it as the other way round.
        let degrees = with.degrees(d);
        let of_d = table.rows(d * order * pairs, order * pairs);
        let block = of_d * rows.weights.columns(0, order * degrees);
        for (mn, values) in block.column_iter().enumerate() {
            let (m, n) = (mn % order, mn / order);
            for f in 0..strips_with {
                let mut column = out.column_mut(with.first(n) + d * strips_with + f);
                let column = &mut column.as_mut_slice()[of.first(m)..of.first(m + 1)];
                for (b, column) in column.chunks_exact_mut(strips_of).enumerate() {
                    column.copy_from_slice(&values.as_slice()[b * pairs + f * strips_of..][..strips_of]);
                }
            }
        }
    }
}
