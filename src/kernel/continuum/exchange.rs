//! Products with the matrix of the exchange: reading it is what takes time, so that half of a symmetric one is left out, and what is small.

use rayon::prelude::*;

use super::compressed::{Compressed, PIECE, Product};

/// What panel 0 gives to panel 1, functions of panel 0 by functions of panel 1.
pub(super) struct Exchange {
    /// Whether the panels are alike: the upper triangle with half the diagonal is then all there is, which with its transpose is the matrix.
    pub(super) alike: bool,
    /// The blocks of each strip of panel 1: always the same ones, so that sums do not depend on the number of threads.
    pub(super) strips: Vec<Vec<Compressed>>,
}

impl Exchange {
    /// `out = F·x`: what `panel` gets from function `x` of the other.
    pub(super) fn apply(&self, panel: usize, x: &[f64], out: &mut [f64]) {
        let product = match (self.alike, panel) {
            (true, _) => Product::Both,
            (false, 0) => Product::Straight,
            (false, _) => Product::Transposed,
        };
        let x = [x, &[0.0; PIECE]].concat();
        let add = |strip: &Vec<Compressed>| {
            let mut sums = vec![0.0; out.len() + PIECE];
            strip.iter().for_each(|block| block.add_product(product, &x, &mut sums));
            sums
        };
        let all: Vec<_> = self.strips.par_iter().map(add).collect();
        out.fill(0.0);
        for sums in all {
            out.iter_mut().zip(sums).for_each(|(out, sum)| *out += sum);
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    /// Two strips of two blocks each, their entries from 1e-6 on.
    fn strips(matrix: &DMatrix<f64>) -> Vec<Vec<Compressed>> {
        let half = matrix.ncols() / 2;
        let block = |i: usize, j: usize| {
            let place = [i * half, j * half];
            Compressed::new(&matrix.view(place.into(), (half, half)).into_owned(), place, 1e-6)
        };
        (0..2).map(|j| (0..2).map(|i| block(i, j)).collect()).collect()
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
        let differing = Exchange { alike: false, strips: strips(&matrix) };
        assert!((product(&differing, 0) - &matrix * &x).amax() < 1e-5);
        assert!((product(&differing, 1) - matrix.transpose() * &x).amax() < 1e-5);
        let mut half = matrix.upper_triangle();
        half.set_diagonal(&(0.5 * half.diagonal()));
        let whole = &half + half.transpose();
        assert!((product(&Exchange { alike: true, strips: strips(&half) }, 0) - whole * &x).amax() < 1e-5);
    }
}
