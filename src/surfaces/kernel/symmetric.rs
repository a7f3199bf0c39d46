//! A symmetric matrix with long runs of zeros in most rows.

use std::ops::Range;

/// The entries right of the diagonal, in runs of adjacent non-zero ones, in single precision: 6e-8 of an
/// entry is below the accuracy of any mesh, and half the memory allows twice the entries.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    /// First row and column of each run, and the range of its entries.
    runs: Vec<Run>,
    values: Vec<f32>,
}

#[derive(Clone, Debug, PartialEq)]
struct Run {
    row: usize,
    start: usize,
    values: Range<usize>,
}

impl Rows {
    /// Adds a row, starting at column `start`.
    pub fn push(&mut self, row: usize, start: usize, entries: &[f64]) {
        let mut column = start;
        for run in entries.chunk_by(|a, b| (*a == 0.0) == (*b == 0.0)) {
            if run[0] != 0.0 {
                let first = self.values.len();
                self.values.extend(run.iter().map(|entry| *entry as f32));
                self.runs.push(Run { row, start: column, values: first..self.values.len() });
            }
            column += run.len();
        }
    }

    /// Number of stored entries.
    #[must_use]
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Every run: its row, its first column, its entries.
    pub fn runs(&self) -> impl Iterator<Item = (usize, usize, &[f32])> {
        self.runs.iter().map(|run| (run.row, run.start, &self.values[run.values.clone()]))
    }

    /// Adds the entries of a row of the matrix, stored here directly or as mirrored columns, to `out`.
    pub fn add_row(&self, row: usize, out: &mut [f64]) {
        for (own, start, entries) in self.runs() {
            if own == row {
                out[start..].iter_mut().zip(entries).for_each(|(out, entry)| *out += f64::from(*entry));
            } else if let Some(entry) = row.checked_sub(start).and_then(|n| entries.get(n)) {
                out[own] += f64::from(*entry);
            }
        }
    }

    /// Adds the product of these rows, and of their mirrored columns, with `x` to `out`.
    pub fn add_product(&self, x: &[f64], out: &mut [f64]) {
        for (row, start, entries) in self.runs() {
            let (mut sum, own) = (0.0, x[row]);
            let columns = start..start + entries.len();
            for ((entry, x), out) in entries.iter().zip(&x[columns.clone()]).zip(&mut out[columns]) {
                let entry = f64::from(*entry);
                sum += entry * x;
                *out += entry * own;
            }
            out[row] += sum;
        }
    }
}
