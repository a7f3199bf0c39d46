//! A symmetric matrix most of whose rows are empty in long stretches.

use std::ops::Range;

/// The entries right of the diagonal, in runs of neighbours that are not zero, in single precision: 6e-8 of
/// an entry is below what any mesh is worth, and half the memory is twice the facets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    /// Row and column at which each run begins, and where its entries are.
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
    /// Adds a row from its column `start` on.
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

    /// Number of entries kept.
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

    /// Adds a row of the matrix, as far as these rows or the columns that mirror them have it, to `out`.
    pub fn add_row(&self, row: usize, out: &mut [f64]) {
        for (own, start, entries) in self.runs() {
            if own == row {
                out[start..].iter_mut().zip(entries).for_each(|(out, entry)| *out += f64::from(*entry));
            } else if let Some(entry) = row.checked_sub(start).and_then(|n| entries.get(n)) {
                out[own] += f64::from(*entry);
            }
        }
    }

    /// Adds the product of these rows, and of the columns that mirror them, with `x` to `out`.
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
