//! Columns of a matrix without their small entries.
//!
//! Cells that are far from each other, measured by their size, exchange little but their lowest degrees: of the entries of a 45° fold that
//! is solved to 1e-8, four of five are below a thousandth of that. What is left stands in runs, as degrees do.

use std::ops::Range;

use nalgebra::DMatrix;

use crate::solve::dot;

/// Rows that are kept or left out together: so many products take less time than another run.
const PIECE: usize = 8;

/// Consecutive columns of runs.
pub(super) struct Compressed {
    /// The first of the columns.
    first: usize,
    /// The runs of each column, in the order of columns.
    columns: Vec<Vec<Run>>,
    /// The entries of all runs, one after the other.
    values: Vec<f64>,
}

/// Consecutive rows of a column.
struct Run {
    rows: Range<usize>,
    /// Where its values begin.
    start: usize,
}

impl Compressed {
    /// Those entries of `matrix` that are not below `negligible`; its columns are those from `first` on.
    pub(super) fn new(matrix: &DMatrix<f64>, first: usize, negligible: f64) -> Self {
        let mut values = Vec::new();
        let mut compress = |column: &[f64]| {
            let keep = |rows: Range<usize>| {
                let start = values.len();
                values.extend(&column[rows.clone()]);
                Run { rows, start }
            };
            runs(column, negligible).into_iter().map(keep).collect()
        };
        let columns = matrix.column_iter().map(|column| compress(column.as_slice())).collect();
        Self { first, columns, values }
    }

    /// Number of columns.
    pub(super) fn len(&self) -> usize {
        self.columns.len()
    }

    /// Adds these columns' share of `A·x` to `sums`.
    pub(super) fn add_product(&self, x: &[f64], sums: &mut [f64]) {
        for (runs, x) in self.columns.iter().zip(&x[self.first..]) {
            for run in runs {
                self.add(run, *x, sums);
            }
        }
    }

    /// Sets `out` to these columns' rows of `Aᵀ·x`.
    pub(super) fn set_transposed_product(&self, x: &[f64], out: &mut [f64]) {
        for (runs, out) in self.columns.iter().zip(out) {
            *out = runs.iter().map(|run| self.dot(run, x)).sum();
        }
    }

    /// Adds these columns' share of `(A + Aᵀ)·x` to `sums`: what is read serves both.
    pub(super) fn add_both_products(&self, x: &[f64], sums: &mut [f64]) {
        for (n, runs) in (self.first..).zip(&self.columns) {
            for run in runs {
                self.add(run, x[n], sums);
                sums[n] += self.dot(run, x);
            }
        }
    }

    fn add(&self, run: &Run, x: f64, sums: &mut [f64]) {
        sums[run.rows.clone()].iter_mut().zip(self.values(run)).for_each(|(sum, a)| *sum += a * x);
    }

    fn dot(&self, run: &Run, x: &[f64]) -> f64 {
        dot(self.values(run), &x[run.rows.clone()])
    }

    fn values(&self, run: &Run) -> &[f64] {
        &self.values[run.start..][..run.rows.len()]
    }
}

/// The pieces of a column with an entry that is not below `negligible`, neighbours as one.
fn runs(column: &[f64], negligible: f64) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (piece, start) in column.chunks(PIECE).zip((0..).step_by(PIECE)) {
        // All are looked at, which takes less time than to stop at the first; what is not a number is kept, so that it shows.
        let is_negligible = piece.iter().fold(true, |all, entry| all & (entry.abs() < negligible));
        if !is_negligible {
            let end = start + piece.len();
            match runs.last_mut() {
                Some(run) if run.end == start => run.end = end,
                _ => runs.push(start..end),
            }
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_hold_all_but_what_is_negligible() {
        let mut column = vec![1e-9; 42];
        for row in [0, 5, 30, 39, 41] {
            column[row] = -1.0;
        }
        assert_eq!(runs(&column, 1e-6), [0..8, 24..42]);
        assert_eq!(runs(&column, 0.0).first(), Some(&(0..42)));
        assert!(runs(&column, 2.0).is_empty());
        assert_eq!(runs(&[0.0, f64::NAN], 1e-6).first(), Some(&(0..2)));
    }
}
