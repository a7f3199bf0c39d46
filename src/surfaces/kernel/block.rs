//! Parts of a symmetric matrix, entry by entry.

use std::ops::Range;

use super::symmetric::Rows;

/// Entries of some rows right of the diagonal in a range of columns, representing their mirror image as well.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) rows: Range<usize>,
    pub(super) columns: Range<usize>,
    pub(super) entries: Rows,
}

impl Block {
    /// Adds the entries of this block, or of its mirror image, in one row of the matrix to `out`.
    pub(super) fn add_row(&self, row: usize, out: &mut [f64]) {
        if self.rows.contains(&row) || self.columns.contains(&row) {
            self.entries.add_row(row, out);
        }
    }
}
