//! What functions on one panel give to functions on the other.

use nalgebra::{DMatrix, DMatrixViewMut};
use rayon::prelude::*;

use super::rows::{RowWeights, Rows};
use super::space::Space;
use super::table::Nodes;
use crate::geometry::Fold;

/// The exchange of `fold`, functions on panel 0 by functions on panel 1, from the `table` of their strips along the crease; of
/// panels that are `alike` the upper triangle alone.
pub(super) fn assemble(
    fold: &Fold,
    [of, with]: [&Space; 2],
    alike: bool,
    nodes: &Nodes,
    table: &DMatrix<f64>,
) -> DMatrix<f64> {
    let rows = Rows::new(fold, [of.order(), with.order()], nodes);
    let (height, width) = (of.len(), with.of_strip());
    // Zeros that nobody wrote take no memory: what is never set costs nothing.
    let mut matrix = DMatrix::from_vec(height, with.len(), vec![0.0; height * with.len()]);
    // Columns of one strip of panel 1 each.
    let strips = matrix.as_mut_slice().par_chunks_exact_mut(width * height).enumerate();
    strips.for_each(|(j, columns)| {
        let mut columns = DMatrixViewMut::from_slice(columns, height, width);
        for (i, strip) in of.across.ends.iter().enumerate() {
            // Of panels that are alike, what strip i gives to j is the transpose of what j gives to i.
            if alike && i > j {
                continue;
            }
            let weights = rows.weights(*strip, with.across.ends[j]);
            let block = columns.rows_mut(i * of.of_strip(), of.of_strip());
            set([of, with], &weights, table, block);
        }
    });
    matrix
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
