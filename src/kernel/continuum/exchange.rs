//! Products with the matrix of the exchange: reading it is what takes time, so that half of a symmetric one is left out, and what is small.

use rayon::prelude::*;

use super::compressed::Compressed;

/// What panel 0 gives to panel 1, functions of panel 0 by functions of panel 1, in columns of one strip each: always the same ones, so that
/// sums do not depend on the number of threads.
pub(super) enum Exchange {
    /// Of panels that are alike: the upper triangle with half the diagonal, which with its transpose is all.
    Alike(Vec<Compressed>),
    /// Of panels that differ.
    Differing(Vec<Compressed>),
}

impl Exchange {
    /// `out = F·x`: what `panel` gets from function `x` of the other.
    pub(super) fn apply(&self, panel: usize, x: &[f64], out: &mut [f64]) {
        match self {
            Self::Alike(half) => sum(half, out, |strip, sums| strip.add_both_products(x, sums)),
            Self::Differing(all) if panel == 0 => sum(all, out, |strip, sums| strip.add_product(x, sums)),
            Self::Differing(all) => {
                // All strips have as many functions.
                let strips = out.par_chunks_exact_mut(all[0].len()).zip(all);
                strips.for_each(|(out, strip)| strip.set_transposed_product(x, out));
            }
        }
    }
}

/// Sets `out` to the sum of what each strip adds.
fn sum(strips: &[Compressed], out: &mut [f64], add: impl Fn(&Compressed, &mut [f64]) + Sync) {
    let add = |strip| {
        let mut sums = vec![0.0; out.len()];
        add(strip, &mut sums);
        sums
    };
    let all: Vec<_> = strips.par_iter().map(add).collect();
    out.fill(0.0);
    for sums in all {
        out.iter_mut().zip(sums).for_each(|(out, sum)| *out += sum);
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    /// Two strips of a matrix, its entries from 1e-6 on.
    fn compressed(matrix: &DMatrix<f64>) -> Vec<Compressed> {
        let width = matrix.ncols() / 2;
        let strip = |j: usize| matrix.columns(j * width, width).into_owned();
        (0..2).map(|j| Compressed::new(&strip(j), j * width, 1e-6)).collect()
    }

    #[test]
    fn products_are_those_of_all_entries() {
        let size = 60;
        let matrix = DMatrix::from_fn(size, size, |i, j| {
            let far = if i.abs_diff(j) > 20 { 1e-8 } else { 1.0 };
            far * ((i * j + i + j) as f64).sin()
        });
        let x = DVector::from_fn(size, |n, _| (n as f64).cos());
        let product = |exchange: &Exchange, panel: usize| {
            let mut out = DVector::zeros(size);
            exchange.apply(panel, x.as_slice(), out.as_mut_slice());
            out
        };
        let differing = Exchange::Differing(compressed(&matrix));
        assert!((product(&differing, 0) - &matrix * &x).amax() < 1e-6);
        assert!((product(&differing, 1) - matrix.transpose() * &x).amax() < 1e-6);
        let mut half = matrix.upper_triangle();
        half.set_diagonal(&(0.5 * half.diagonal()));
        let whole = &half + half.transpose();
        assert!((product(&Exchange::Alike(compressed(&half)), 0) - whole * &x).amax() < 1e-6);
    }
}
