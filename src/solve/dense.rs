//! Products and factors of dense matrices of ten to two hundred rows, computed with the widest vectors of the
//! processor. General libraries first pack matrices into blocks, which pays for larger ones alone.

use std::ops::Range;
use std::slice::ChunksExact;

use nalgebra::{Cholesky, DMatrix, DVector, Dim, Dyn, Matrix, VecStorage};
use pulp::{Arch, Simd, WithSimd};

/// A matrix or, with one column, a vector.
pub type Columns<C> = Matrix<f64, Dyn, C, VecStorage<f64, Dyn, C>>;

/// Adds a multiple of other values.
pub fn add(sum: &mut [f64], share: f64, values: &[f64]) {
    Arch::new().dispatch(|| sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += share * value));
}

/// One vector above another.
#[must_use]
pub fn stacked(above: &DVector<f64>, below: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(above.len() + below.len(), above.iter().chain(below).copied())
}

/// Root mean square of values.
#[must_use]
pub fn rms(values: &DVector<f64>) -> f64 {
    (values.norm_squared() / values.len() as f64).sqrt()
}

/// Columns as slices, which compile to faster loops than matrices.
pub fn columns<C: Dim>(matrix: &Columns<C>) -> ChunksExact<'_, f64> {
    matrix.as_slice().chunks_exact(matrix.nrows().max(1))
}

/// Adds the product of two matrices, the second with few columns.
pub fn add_product<C: Dim>(sum: &mut Columns<C>, a: &DMatrix<f64>, b: &Columns<C>) {
    Arch::new().dispatch(|| {
        for (sum, shares) in sum.as_mut_slice().chunks_exact_mut(a.nrows().max(1)).zip(columns(b)) {
            for (column, share) in columns(a).zip(shares) {
                sum.iter_mut().zip(column).for_each(|(sum, value)| *sum += share * value);
            }
        }
    });
}

/// The product of two matrices.
///
/// # Panics
/// If the first has not as many columns as the second has rows.
#[must_use]
pub fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    product_with_transposed(a, &b.transpose())
}

/// The product `aᵀ·b`.
///
/// # Panics
/// If both have not as many rows.
#[must_use]
pub fn transposed_product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    product_with_transposed(&a.transpose(), &b.transpose())
}

/// The product `a·bᵀ`.
///
/// # Panics
/// If both have not as many columns.
#[must_use]
pub fn product_with_transposed(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut product = DMatrix::zeros(a.nrows(), b.nrows());
    add_rows(product.as_mut_slice(), 0..a.nrows(), (a, b), 0..a.ncols());
    product
}

/// The product `aᵀ·b` of two matrices, the second with few columns.
///
/// # Panics
/// If both have not as many rows.
#[must_use]
pub fn dot_products<C: Dim>(a: &DMatrix<f64>, b: &Columns<C>) -> Columns<C> {
    assert_eq!(a.nrows(), b.nrows(), "rows of factors");
    let (_, columns) = b.shape_generic();
    let mut products = vec![0.0; a.ncols() * columns.value()];
    Arch::new().dispatch(DotProducts { a, b: b.as_slice(), products: &mut products });
    Matrix::from_data(VecStorage::new(Dyn(a.ncols()), columns, products))
}

struct DotProducts<'a> {
    a: &'a DMatrix<f64>,
    b: &'a [f64],
    products: &'a mut [f64],
}

impl WithSimd for DotProducts<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { a, b, products } = self;
        let b = b.chunks_exact(a.nrows().max(1));
        for (products, b) in products.chunks_exact_mut(a.ncols().max(1)).zip(b) {
            let (vectors_b, rest_b) = S::as_simd_f64s(b);
            let rest_b = simd.partial_load_f64s(rest_b);
            for (product, a) in products.iter_mut().zip(columns(a)) {
                let (vectors_a, rest_a) = S::as_simd_f64s(a);
                let mut sum = simd.mul_f64s(simd.partial_load_f64s(rest_a), rest_b);
                for (a, b) in vectors_a.iter().zip(vectors_b) {
                    sum = simd.mul_add_e_f64s(*a, *b, sum);
                }
                *product = simd.reduce_sum_f64s(sum);
            }
        }
    }
}

/// Adds some rows of `a·bᵀ`, summed over some columns of both, to the same rows of `sum`, which is stored
/// column by column.
///
/// # Panics
/// If rows or columns are not there, or `sum` has not as many rows as `a` and columns as `b` has rows.
pub fn add_rows(
    sum: &mut [f64],
    rows: Range<usize>,
    (a, b): (&DMatrix<f64>, &DMatrix<f64>),
    inner: Range<usize>,
) {
    assert!(rows.end <= a.nrows() && sum.len() == a.nrows() * b.nrows(), "rows of a product");
    assert!(inner.end <= a.ncols().min(b.ncols()), "columns of a product");
    let (height, width) = (a.nrows(), b.nrows());
    let factors = Factors { left: a.as_slice(), heights: [height, width], right: b.as_slice(), inner };
    Arch::new().dispatch(Product { sum, height, factors, rows, columns: 0..width });
}

/// The lower triangle of `aᵀa`; what is above the diagonal means nothing.
#[must_use]
pub fn squares(a: &DMatrix<f64>) -> DMatrix<f64> {
    squares_of_rows(&a.transpose())
}

/// The lower triangle of `a·aᵀ`; what is above the diagonal means nothing.
#[must_use]
pub fn squares_of_rows(a: &DMatrix<f64>) -> DMatrix<f64> {
    let (count, values) = (a.nrows(), a.as_slice());
    let mut squares = DMatrix::zeros(count, count);
    let factors = Factors { left: values, right: values, heights: [count; 2], inner: 0..a.ncols() };
    for (sum, first) in
        squares.as_mut_slice().chunks_mut((BLOCK * count).max(1)).zip((0..count).step_by(BLOCK))
    {
        let columns = first..count.min(first + BLOCK);
        Arch::new().dispatch(Product {
            sum,
            height: count,
            factors: factors.clone(),
            rows: first..count,
            columns,
        });
    }
    squares
}

/// The Cholesky factor of a symmetric matrix, of which the lower triangle is given; `None` if it is not
/// positive definite.
#[must_use]
pub fn cholesky(mut matrix: DMatrix<f64>) -> Option<Cholesky<f64, Dyn>> {
    let count = matrix.nrows();
    let is_definite = Arch::new().dispatch(Factorisation { values: matrix.as_mut_slice(), count });
    is_definite.then(|| Cholesky::pack_dirty(matrix))
}

/// The inverse of a lower triangular matrix, of which what is above the diagonal is not read.
#[must_use]
pub fn inverse_of_lower(lower: &DMatrix<f64>) -> DMatrix<f64> {
    let count = lower.nrows();
    let mut by_row = DMatrix::zeros(count, count);
    Arch::new().dispatch(Inversion {
        lower: lower.as_slice(),
        inverse: by_row.as_mut_slice(),
        known: vec![0.0; BLOCK * count],
        count,
    });
    by_row.transpose()
}

/// Forward substitution for all unit vectors at once, a block of rows after the other.
struct Inversion<'a> {
    lower: &'a [f64],
    /// Row by row.
    inverse: &'a mut [f64],
    /// What the rows before contribute to a block, row by row.
    known: Vec<f64>,
    count: usize,
}

impl WithSimd for Inversion<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { lower, inverse, mut known, count } = self;
        for first in (0..count).step_by(BLOCK) {
            let rows = first..count.min(first + BLOCK);
            let (before, own) = inverse.split_at_mut(first * count);
            let known = &mut known[..rows.len() * count];
            known.fill(0.0);
            // the transposed product: columns of the inverse by rows of the block
            let factors = Factors { left: before, right: lower, heights: [count; 2], inner: 0..first };
            Product { sum: known, height: count, factors, rows: 0..first, columns: rows.clone() }
                .add(simd, simd.splat_f64s(-1.0));
            for (n, known) in rows.clone().zip(known.chunks_exact(count)) {
                let (before, own) = own.split_at_mut((n - first) * count);
                let own = &mut own[..=n];
                own[..n].copy_from_slice(&known[..n]);
                own[n] = 1.0;
                for (m, before) in (first..n).zip(before.chunks_exact(count)) {
                    let share = lower[m * count + n];
                    own.iter_mut().zip(&before[..=m]).for_each(|(own, value)| *own -= share * value);
                }
                let diagonal = lower[n * count + n];
                own.iter_mut().for_each(|value| *value /= diagonal);
            }
        }
    }
}

/// The factorisation of a matrix in its own place.
///
/// # Source
/// Golub and Van Loan, *Matrix Computations* (2013), section 4.2.5, by blocks of columns.
struct Factorisation<'a> {
    values: &'a mut [f64],
    count: usize,
}

impl WithSimd for Factorisation<'_> {
    /// True if the matrix is positive definite.
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let Self { values, count } = self;
        // no closure: it would not be compiled for wide vectors
        for first in (0..count).step_by(BLOCK) {
            let end = count.min(first + BLOCK);
            let (known, block) = values.split_at_mut(first * count);
            let block = &mut block[..(end - first) * count];
            let factors = Factors { left: known, right: known, heights: [count; 2], inner: 0..first };
            let product =
                Product { sum: block, height: count, factors, rows: first..count, columns: first..end };
            product.add(simd, simd.splat_f64s(-1.0));
            if !factor_block(&mut values[first * count..end * count], count, first) {
                return false;
            }
        }
        true
    }
}

/// Factors a block of columns, whose diagonal starts at row `first`, once all columns before it are taken
/// off; false if a pivot is not positive.
#[inline(always)]
fn factor_block(block: &mut [f64], count: usize, first: usize) -> bool {
    for n in 0..block.len() / count {
        let (before, own) = block.split_at_mut(n * count);
        let own = &mut own[first + n..count];
        for before in before.chunks_exact(count) {
            let before = &before[first + n..];
            let share = before[0];
            own.iter_mut().zip(before).for_each(|(own, value)| *own -= share * value);
        }
        let root = own[0].sqrt();
        own.iter_mut().for_each(|value| *value /= root);
        if !(root > 0.0 && root.is_finite()) {
            return false;
        }
    }
    true
}

/// Columns of a tile of a product, whose sums stay in the processor's registers, and columns factored at
/// once.
const BLOCK: usize = 4;

/// The factors of a product `a·bᵀ`, column by column, with their numbers of rows, and the columns summed
/// over.
#[derive(Clone)]
struct Factors<'a> {
    left: &'a [f64],
    right: &'a [f64],
    heights: [usize; 2],
    inner: Range<usize>,
}

/// Some rows and columns of a product, to be added to the same rows of `sum`, whose first column is the first
/// of these columns.
struct Product<'a> {
    sum: &'a mut [f64],
    height: usize,
    factors: Factors<'a>,
    rows: Range<usize>,
    columns: Range<usize>,
}

impl WithSimd for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.add(simd, simd.splat_f64s(1.0));
    }
}

impl Product<'_> {
    /// Adds the product times a factor.
    #[inline(always)]
    fn add<S: Simd>(self, simd: S, factor: S::f64s) {
        let Self { sum, height, factors, rows, columns } = self;
        if rows.is_empty() {
            return;
        }
        let (mut column, mut sums) = (columns.start, sum.chunks_exact_mut(BLOCK * height));
        for sum in sums.by_ref() {
            factors.add_columns::<S, BLOCK>(simd, (sum, height), rows.clone(), column, factor);
            column += BLOCK;
        }
        for sum in sums.into_remainder().chunks_exact_mut(height) {
            factors.add_columns::<S, 1>(simd, (sum, height), rows.clone(), column, factor);
            column += 1;
        }
    }
}

impl Factors<'_> {
    /// By tiles of two vectors of rows, of one, and of what is left of one.
    #[inline(always)]
    fn add_columns<S: Simd, const COLUMNS: usize>(
        &self,
        simd: S,
        (sum, height): (&mut [f64], usize),
        rows: Range<usize>,
        column: usize,
        factor: S::f64s,
    ) {
        let mut row = rows.start;
        while row + 2 * S::F64_LANES <= rows.end {
            row = self.add_full::<S, 2, COLUMNS>(simd, (sum, height), [row, column], factor);
        }
        while row + S::F64_LANES <= rows.end {
            row = self.add_full::<S, 1, COLUMNS>(simd, (sum, height), [row, column], factor);
        }
        if row < rows.end {
            let mut tile = [simd.splat_f64s(0.0); COLUMNS];
            for (values, shares) in self.pairs() {
                let Some(shares) = shares[column..].first_chunk::<COLUMNS>() else { break };
                let values = simd.partial_load_f64s(&values[row..rows.end]);
                for (sum, share) in tile.iter_mut().zip(shares) {
                    *sum = simd.mul_add_e_f64s(simd.splat_f64s(*share), values, *sum);
                }
            }
            for (sum, own) in sum.chunks_exact_mut(height).zip(tile) {
                let sum = &mut sum[row..rows.end];
                let added = simd.mul_add_e_f64s(factor, own, simd.partial_load_f64s(sum));
                simd.partial_store_f64s(sum, added);
            }
        }
    }

    /// Adds a tile of full vectors; returns the row behind it.
    #[inline(always)]
    fn add_full<S: Simd, const VECTORS: usize, const COLUMNS: usize>(
        &self,
        simd: S,
        (sum, height): (&mut [f64], usize),
        [row, column]: [usize; 2],
        factor: S::f64s,
    ) -> usize {
        let end = row + VECTORS * S::F64_LANES;
        let mut tile = [[simd.splat_f64s(0.0); VECTORS]; COLUMNS];
        for (values, shares) in self.pairs() {
            let (values, _) = S::as_simd_f64s(&values[row..end]);
            let (Some(values), Some(shares)) =
                (values.first_chunk::<VECTORS>(), shares[column..].first_chunk::<COLUMNS>())
            else {
                break;
            };
            for (sums, share) in tile.iter_mut().zip(shares) {
                let share = simd.splat_f64s(*share);
                for (sum, value) in sums.iter_mut().zip(values) {
                    *sum = simd.mul_add_e_f64s(share, *value, *sum);
                }
            }
        }
        for (sum, own) in sum.chunks_exact_mut(height).zip(tile) {
            let (vectors, _) = S::as_mut_simd_f64s(&mut sum[row..end]);
            for (sum, own) in vectors.iter_mut().zip(own) {
                *sum = simd.mul_add_e_f64s(factor, own, *sum);
            }
        }
        end
    }

    /// The columns that are summed over, of both factors.
    #[inline(always)]
    fn pairs(&self) -> impl Iterator<Item = (&[f64], &[f64])> {
        let ([left, right], Range { start, end }) = (self.heights, self.inner.clone());
        let lefts = self.left[start * left..end * left].chunks_exact(left.max(1));
        lefts.zip(self.right[start * right..end * right].chunks_exact(right.max(1)))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;

    fn matrix(rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |row, column| ((7 * row + 13 * column) as f64).sin())
    }

    #[test]
    fn products_and_factors_are_those_of_a_general_library() {
        for (rows, inner, columns) in [(1, 1, 1), (7, 3, 2), (8, 5, 4), (37, 18, 19), (153, 60, 80)] {
            let (a, b) = (matrix(rows, inner), matrix(inner, columns));
            assert!((product(&a, &b) - &a * &b).amax() < 1e-12, "{rows} {inner} {columns}");
            assert!((dot_products(&a, &a) - a.tr_mul(&a)).amax() < 1e-12);
            assert!((transposed_product(&a, &a) - a.tr_mul(&a)).amax() < 1e-12);
            let mut part = DMatrix::zeros(rows, columns);
            let (first, some) = (rows / 3, inner / 2);
            add_rows(part.as_mut_slice(), first..rows, (&a, &b.transpose()), some..inner);
            let expected = a.view((first, some), (rows - first, inner - some)) * b.rows(some, inner - some);
            assert!((part.rows(first, rows - first) - expected).amax() < 1e-12);
            assert!(part.rows(0, first).iter().all(|value| *value == 0.0));
            let whole = a.tr_mul(&a);
            let lower = squares(&a);
            assert!((lower.lower_triangle() - whole.lower_triangle()).amax() < 1e-12);
            let weights = DVector::from_fn(rows, |row, _| (row as f64).cos());
            assert!((dot_products(&a, &weights) - a.tr_mul(&weights)).amax() < 1e-12);
            let mut sum = weights.clone();
            add_product(&mut sum, &a, &DVector::from_element(inner, 0.5));
            assert!((sum - weights - 0.5 * a.column_sum()).amax() < 1e-12);
            let mut definite = whole;
            (0..inner).for_each(|n| definite[(n, n)] += 1.0);
            let factor = cholesky(definite.clone()).unwrap().l();
            assert!((&factor * factor.transpose() - &definite).amax() < 1e-11);
            assert!((inverse_of_lower(&factor) * &factor - DMatrix::identity(inner, inner)).amax() < 1e-11);
            definite[(inner - 1, inner - 1)] = -1.0;
            assert!(cholesky(definite).is_none());
        }
    }

    #[test]
    fn matrices_may_be_empty() {
        for (rows, inner, columns) in [(0, 3, 2), (3, 0, 2), (3, 2, 0), (0, 0, 0)] {
            let expected = DMatrix::zeros(rows, columns);
            let (a, b) = (matrix(rows, inner), matrix(inner, columns));
            assert_eq!(product(&a, &b), expected);
            let mut sum = expected.clone();
            add_product(&mut sum, &a, &b);
            assert_eq!(sum, expected);
        }
        assert_eq!(squares(&matrix(0, 2)), DMatrix::zeros(2, 2));
        assert_eq!(squares(&matrix(2, 0)).len(), 0);
        assert_eq!(inverse_of_lower(&matrix(0, 0)).len(), 0);
    }

    #[test]
    fn what_is_not_a_number_has_no_factor() {
        assert!(cholesky(DMatrix::from_element(5, 5, f64::NAN)).is_none());
        assert_eq!(cholesky(DMatrix::zeros(0, 0)).unwrap().l().len(), 0);
    }
}
