//! A block of a matrix without its small entries.
//!
//! Cells that are far apart relative to their size exchange little beyond their lowest degrees: of the
//! entries of a 45° fold solved to 1e-8, four in five are below a thousandth of that. Most of the others are
//! small enough for single precision, which pays, as products are limited by reading the matrix.

use nalgebra::DMatrix;
use pulp::{Arch, Simd, WithSimd};

/// Rows kept or dropped together: as many numbers as the widest vectors of a processor hold.
pub(super) const PIECE: usize = 8;
/// Largest relative rounding error of single precision.
const SINGLE_ROUNDING: f64 = 0.5 * f32::EPSILON as f64;

/// The entries of a block, at their places in the matrix.
pub(super) struct Compressed {
    exact: Pieces<f64>,
    rounded: Pieces<f32>,
}

/// Which product of a matrix A with a vector is computed.
#[derive(Clone, Copy)]
pub(super) enum Product {
    /// `A·x`.
    Straight,
    /// `Aᵀ·x`.
    Transposed,
    /// `(A + Aᵀ)·x`, reading A once.
    Both,
}

/// Pieces of consecutive columns.
struct Pieces<T> {
    /// The first of the columns.
    first_column: usize,
    /// The end index of each column's pieces.
    ends: Vec<usize>,
    /// The first row of every piece; a matrix that fits into memory has at most 2³² rows.
    rows: Vec<u32>,
    values: Vec<[T; PIECE]>,
}

impl Compressed {
    /// The entries of `block` that are not below `negligible`, the accuracy to which all are rounded; `place`
    /// is the row and column of its first entry.
    pub(super) fn new(block: &DMatrix<f64>, place: [usize; 2], negligible: f64) -> Self {
        let (mut exact, mut rounded) = (Pieces::new(place[1]), Pieces::new(place[1]));
        for column in block.column_iter() {
            for (piece, row) in column.as_slice().chunks(PIECE).zip((place[0]..).step_by(PIECE)) {
                let mut values = [0.0; PIECE];
                values[..piece.len()].copy_from_slice(piece);
                // All entries are checked, which is faster than stopping at the first. NaNs are kept so that
                // they surface.
                let below = |limit: f64| values.iter().fold(true, |all, entry| all & (entry.abs() < limit));
                if !below(negligible) {
                    match below(negligible / SINGLE_ROUNDING) {
                        true => rounded.push(row, values.map(|value| value as f32)),
                        false => exact.push(row, values),
                    }
                }
            }
            exact.end_column();
            rounded.end_column();
        }
        Self { exact, rounded }
    }

    /// Adds this block's contribution to a product with `x` to `sums`.
    ///
    /// # Panics
    /// If `x` and `sums` do not extend [`PIECE`] numbers beyond the last row; the values there are
    /// irrelevant.
    pub(super) fn add_product(&self, product: Product, x: &[f64], sums: &mut [f64]) {
        Arch::new().dispatch(AddProduct { block: self, product, x, sums });
    }
}

/// The computation of [`Compressed::add_product`].
struct AddProduct<'a> {
    block: &'a Compressed,
    product: Product,
    x: &'a [f64],
    sums: &'a mut [f64],
}

impl WithSimd for AddProduct<'_> {
    type Output = ();

    // Inlined functions are compiled for the processor's widest vectors; called ones are not.
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { block: Compressed { exact, rounded }, product, x, sums } = self;
        match product {
            Product::Straight => {
                exact.add::<true, false>(x, sums);
                rounded.add::<true, false>(x, sums);
            }
            Product::Transposed => {
                exact.add::<false, true>(x, sums);
                rounded.add::<false, true>(x, sums);
            }
            Product::Both => {
                exact.add::<true, true>(x, sums);
                rounded.add::<true, true>(x, sums);
            }
        }
    }
}

impl<T: Copy + Into<f64>> Pieces<T> {
    fn new(first_column: usize) -> Self {
        Self { first_column, ends: Vec::new(), rows: Vec::new(), values: Vec::new() }
    }

    fn push(&mut self, row: usize, values: [T; PIECE]) {
        self.rows.push(row as u32);
        self.values.push(values);
    }

    fn end_column(&mut self) {
        self.ends.push(self.rows.len());
    }

    #[inline(always)]
    fn add<const STRAIGHT: bool, const TRANSPOSED: bool>(&self, x: &[f64], sums: &mut [f64]) {
        let mut start = 0;
        for (n, end) in (self.first_column..).zip(&self.ends) {
            let x_n = if STRAIGHT { x[n] } else { 0.0 };
            let mut of_column = [0.0; PIECE];
            for (row, values) in self.rows[start..*end].iter().zip(&self.values[start..*end]) {
                let rows = *row as usize..*row as usize + PIECE;
                let values: [f64; PIECE] = values.map(Into::into);
                if TRANSPOSED {
                    let x = &x[rows.clone()];
                    of_column.iter_mut().zip(&values).zip(x).for_each(|((sum, value), x)| *sum += value * x);
                }
                if STRAIGHT {
                    sums[rows].iter_mut().zip(&values).for_each(|(sum, value)| *sum += value * x_n);
                }
            }
            if TRANSPOSED {
                sums[n] += of_column.iter().sum::<f64>();
            }
            start = *end;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_hold_all_but_what_is_negligible() {
        let mut block = DMatrix::from_element(42, 2, 1e-9);
        for row in [0, 5, 30, 39, 41] {
            block[(row, 1)] = -1.0;
        }
        let kept = |block: &DMatrix<f64>, negligible: f64| {
            let Compressed { exact, rounded } = Compressed::new(block, [100, 7], negligible);
            [exact.rows, rounded.rows]
        };
        let none = Vec::<u32>::new();
        assert_eq!(kept(&block, 1e-8), [vec![100, 124, 132, 140], none.clone()]);
        assert_eq!(kept(&block, 1e-7), [none.clone(), vec![100, 124, 132, 140]]);
        assert_eq!(kept(&block, 0.0)[0].len(), 12);
        assert_eq!(kept(&block, 2.0), [none.clone(), none.clone()]);
        assert_eq!(kept(&DMatrix::from_vec(2, 1, vec![0.0, f64::NAN]), 1e-6), [vec![100], none]);
    }
}
