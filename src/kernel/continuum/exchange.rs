//! Products with the matrix of the exchange: reading it is what takes time, so that half of a symmetric one is left out.

use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::solve::dot;

/// Columns of a symmetric matrix that are multiplied as one piece: always the same ones, so that sums do not depend on the
/// number of threads.
const PIECE: usize = 256;
/// Fewest products that are worth a thread of their own.
const WORK: usize = 100_000;

/// What panel 0 gives to panel 1, functions of panel 0 by functions of panel 1.
pub(super) enum Exchange {
    /// Of panels that are alike: a symmetric matrix whose lower triangle is not set.
    Alike(DMatrix<f64>),
    /// Of panels that differ: its transpose, then itself.
    Differing([DMatrix<f64>; 2]),
}

impl Exchange {
    /// `out = F·x`: what `panel` gets from function `x` of the other.
    pub(super) fn apply(&self, panel: usize, x: &[f64], out: &mut [f64]) {
        match self {
            Self::Alike(upper) => multiply_symmetric(upper, x, out),
            Self::Differing(exchange) => {
                // Columns are contiguous, so that the transpose is the one to multiply with.
                let columns = exchange[panel].as_slice().par_chunks_exact(x.len()).zip(out);
                columns.with_min_len(WORK / x.len()).for_each(|(column, out)| *out = dot(column, x));
            }
        }
    }
}

/// `out = A·x` from the upper triangle of A.
fn multiply_symmetric(upper: &DMatrix<f64>, x: &[f64], out: &mut [f64]) {
    let multiply = |(piece, columns): (usize, &[f64])| {
        let mut sums = vec![0.0; x.len()];
        for (n, column) in (piece * PIECE..).zip(columns.chunks_exact(x.len())) {
            sums[..n].iter_mut().zip(column).for_each(|(sum, a)| *sum += a * x[n]);
            sums[n] += dot(&column[..=n], &x[..=n]);
        }
        sums
    };
    let pieces: Vec<_> = upper.as_slice().par_chunks(PIECE * x.len()).enumerate().map(multiply).collect();
    out.fill(0.0);
    for sums in pieces {
        out.iter_mut().zip(sums).for_each(|(out, sum)| *out += sum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_symmetric_matrix_is_enough() {
        let size = PIECE + 3;
        let whole = DMatrix::from_fn(size, size, |i, j| ((i * j + i + j) as f64).sin());
        let x: Vec<f64> = (0..size).map(|n| (n as f64).cos()).collect();
        let (mut out, mut want) = (vec![0.0; size], vec![0.0; size]);
        Exchange::Alike(whole.upper_triangle()).apply(0, &x, &mut out);
        Exchange::Differing([whole.transpose(), whole]).apply(0, &x, &mut want);
        assert!(out.iter().zip(&want).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}
