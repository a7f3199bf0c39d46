//! Products with the exchange matrix. Reading it takes most of the time, so half of a symmetric matrix is
//! omitted, as are small entries.

use rayon::prelude::*;

use super::compressed::{Compressed, PIECE, Product};

/// The exchange matrix from panel 1 to panel 0: functions of panel 0 by functions of panel 1.
pub(super) struct Exchange {
    /// Numbers of functions on the panels. `None` if the panels are alike: only the upper triangle with half
    /// the diagonal is stored, and adding its transpose gives the matrix.
    pub(super) unlike: Option<[usize; 2]>,
    /// The blocks by strip of panel 1, a fixed partition, so that sums do not depend on the number of
    /// threads. If the panels differ, column numbers continue after those of the rows.
    pub(super) strips: Vec<Vec<Compressed>>,
}

impl Exchange {
    /// `out = F·x`: the light on `panel` from function `x` of the other.
    pub(super) fn apply(&self, panel: usize, x: &[f64], out: &mut [f64]) {
        match (self.unlike, panel) {
            (None, _) => out.copy_from_slice(&self.product(Product::Both, &[x])[..out.len()]),
            (Some([of_0, _]), 0) => {
                out.copy_from_slice(&self.product(Product::Straight, &[&vec![0.0; of_0], x])[..of_0]);
            }
            (Some([of_0, of_1]), _) => {
                let product = self.product(Product::Transposed, &[x, &vec![0.0; of_1]]);
                out.copy_from_slice(&product[of_0..of_0 + of_1]);
            }
        }
    }

    /// The light on both panels from functions of each other, `[F·x₁, Fᵀ·x₀]`, reading the matrix once.
    pub(super) fn apply_both(&self, x: [&[f64]; 2], out: [&mut [f64]; 2]) {
        let [out_0, out_1] = out;
        if self.unlike.is_none() {
            self.apply(0, x[1], out_0);
            self.apply(1, x[0], out_1);
            return;
        }
        let product = self.product(Product::Both, &x);
        let (of_0, rest) = product.split_at(out_0.len());
        out_0.copy_from_slice(of_0);
        out_1.copy_from_slice(&rest[..out_1.len()]);
    }

    /// The product of all blocks with the concatenated parts of a vector, followed by a few unused numbers.
    fn product(&self, product: Product, x: &[&[f64]]) -> Vec<f64> {
        let x = [&x.concat()[..], &[0.0; PIECE]].concat();
        let add = |strip: &Vec<Compressed>| {
            let mut sums = vec![0.0; x.len()];
            strip.iter().for_each(|block| block.add_product(product, &x, &mut sums));
            sums
        };
        let all: Vec<_> = self.strips.par_iter().map(add).collect();
        let mut total = vec![0.0; x.len()];
        for sums in all {
            total.iter_mut().zip(sums).for_each(|(total, sum)| *total += sum);
        }
        total
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    /// Two strips of two blocks each, with their entries from 1e-6; column numbers start at `first`.
    fn strips(matrix: &DMatrix<f64>, first: usize) -> Vec<Vec<Compressed>> {
        let half = matrix.ncols() / 2;
        let block = |i: usize, j: usize| {
            let view = matrix.view((i * half, j * half), (half, half)).into_owned();
            Compressed::new(&view, [i * half, first + j * half], 1e-6)
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
        let differing = Exchange { unlike: Some([size; 2]), strips: strips(&matrix, size) };
        let (of_0, of_1) = (product(&differing, 0), product(&differing, 1));
        assert!((&of_0 - &matrix * &x).amax() < 1e-5);
        assert!((&of_1 - matrix.transpose() * &x).amax() < 1e-5);
        let mut both = [DVector::zeros(size), DVector::zeros(size)];
        let [out_0, out_1] = &mut both;
        differing.apply_both([x.as_slice(); 2], [out_0.as_mut_slice(), out_1.as_mut_slice()]);
        assert!((&both[0] - of_0).amax() < 1e-12 && (&both[1] - of_1).amax() < 1e-12);
        let mut half = matrix.upper_triangle();
        half.set_diagonal(&(0.5 * half.diagonal()));
        let whole = &half + half.transpose();
        let alike = Exchange { unlike: None, strips: strips(&half, 0) };
        let [out_0, out_1] = &mut both;
        alike.apply_both([x.as_slice(); 2], [out_0.as_mut_slice(), out_1.as_mut_slice()]);
        assert!((&both[0] - &whole * &x).amax() < 1e-5 && (&both[1] - whole * &x).amax() < 1e-5);
    }
}
