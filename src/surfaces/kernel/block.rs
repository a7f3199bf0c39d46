//! Parts of a symmetric matrix, entry by entry.

use std::ops::Range;

use super::symmetric::Rows;

/// What some rows have right of the diagonal in a range of columns, which stands for its mirror image too.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) rows: Range<usize>,
    pub(super) columns: Range<usize>,
    pub(super) entries: Rows,
}

impl Block {
    /// Adds what this block, or its mirror image, has of one row of the matrix to `out`.
    pub(super) fn add_row(&self, row: usize, out: &mut [f64]) {
        if self.rows.contains(&row) || self.columns.contains(&row) {
            self.entries.add_row(row, out);
        }
    }
}
