//! Eigenvalues and eigenvectors of symmetric matrices.
//!
//! By the QL method with implicit shifts. `nalgebra::SymmetricEigen` (0.33) is wrong for some matrices,
//! tridiagonal ones with small entries among them, as a test below shows.

use nalgebra::DMatrix;
use nalgebra::linalg::SymmetricTridiagonal;

/// Iterations per eigenvalue; two or three are usual.
const ITERATION_LIMIT: usize = 100;

/// Eigenvalues, unordered, and eigenvectors as columns in the same order.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigen {
    /// Eigenvalues.
    pub values: Vec<f64>,
    /// Eigenvectors, or their product with the rows given.
    pub vectors: DMatrix<f64>,
}

impl Eigen {
    /// For the tridiagonal matrix with this `diagonal` and this `off_diagonal`, which is one entry shorter.
    ///
    /// # Source
    /// EISPACK, `tql2`; Golub and Van Loan, *Matrix Computations*, section 8.3.
    ///
    /// # Example
    /// ```
    /// use vfold::solve::Eigen;
    /// let mut values = Eigen::of_tridiagonal(&[2.0, 2.0], &[1.0]).values;
    /// values.sort_by(f64::total_cmp);
    /// assert!((values[0] - 1.0).abs() < 1e-15 && (values[1] - 3.0).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn of_tridiagonal(diagonal: &[f64], off_diagonal: &[f64]) -> Self {
        Self::seen(DMatrix::identity(diagonal.len(), diagonal.len()), diagonal, off_diagonal)
    }

    /// As [`Eigen::of_tridiagonal`], with the product of `rows` and the eigenvectors in place of the latter:
    /// fewer rows take less time.
    ///
    /// # Example
    /// ```
    /// use nalgebra::DMatrix;
    /// use vfold::solve::Eigen;
    /// let sums = Eigen::seen(DMatrix::from_element(1, 2, 1.0), &[2.0, 2.0], &[1.0]).vectors;
    /// assert!((sums.amax() - 2_f64.sqrt()).abs() < 1e-15 && sums.amin().abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn seen(rows: DMatrix<f64>, diagonal: &[f64], off_diagonal: &[f64]) -> Self {
        let count = diagonal.len();
        if rows.nrows() > count {
            let Self { values, vectors } = Self::of_tridiagonal(diagonal, off_diagonal);
            return Self { values, vectors: rows * vectors };
        }
        let mut ql =
            Ql { diagonal: diagonal.to_vec(), off_diagonal: [off_diagonal, &[0.0]].concat(), vectors: rows };
        let sizes = ql.diagonal.iter().zip(&ql.off_diagonal).map(|(d, e)| d.abs() + e.abs());
        let negligible = f64::EPSILON * sizes.fold(0.0, f64::max);
        for first in 0..count {
            for _ in 0..ITERATION_LIMIT {
                let Some(last) = ql.block(first, negligible) else { break };
                ql.sweep(first, last);
            }
        }
        Self { values: ql.diagonal, vectors: ql.vectors }
    }

    /// For a symmetric matrix, of which only the lower triangle is read.
    ///
    /// # Panics
    /// If the matrix is empty.
    #[must_use]
    pub fn of_symmetric(matrix: DMatrix<f64>) -> Self {
        let (turned, diagonal, off_diagonal) = SymmetricTridiagonal::new(matrix).unpack();
        Self::seen(turned, diagonal.as_slice(), off_diagonal.as_slice())
    }
}

struct Ql {
    diagonal: Vec<f64>,
    /// Ends with a zero.
    off_diagonal: Vec<f64>,
    vectors: DMatrix<f64>,
}

impl Ql {
    /// The end of the block that starts at `first`; `None` if that row is a block of its own.
    fn block(&self, first: usize, negligible: f64) -> Option<usize> {
        let rest = self.off_diagonal[first..].iter().take_while(|e| e.abs() > negligible).count();
        (rest > 0).then_some(first + rest)
    }

    /// One implicit QL step on a block, shifted by the eigenvalue of its first two rows that is nearer to the
    /// first entry.
    fn sweep(&mut self, first: usize, last: usize) {
        let (d, e) = (&mut self.diagonal, &mut self.off_diagonal);
        let slope = (d[first + 1] - d[first]) / (2.0 * e[first]);
        let mut g = d[last] - d[first] + e[first] / (slope + slope.hypot(1.0).copysign(slope));
        let (mut sin, mut cos, mut shift) = (1.0, 1.0, 0.0);
        for i in (first..last).rev() {
            let (f, b) = (sin * e[i], cos * e[i]);
            let r = f64::hypot(f, g);
            e[i + 1] = r;
            if r == 0.0 {
                // The block splits here.
                d[i + 1] -= shift;
                e[last] = 0.0;
                return;
            }
            (sin, cos) = (f / r, g / r);
            let above = d[i + 1] - shift;
            let change = (d[i] - above) * sin + 2.0 * cos * b;
            shift = sin * change;
            d[i + 1] = above + shift;
            g = cos * change - b;
            rotate(&mut self.vectors, i, sin, cos);
        }
        d[first] -= shift;
        e[first] = g;
        e[last] = 0.0;
    }
}

/// Rotates columns `i` and `i + 1`.
fn rotate(vectors: &mut DMatrix<f64>, i: usize, sin: f64, cos: f64) {
    let rows = vectors.nrows();
    let (left, right) = vectors.as_mut_slice()[i * rows..][..2 * rows].split_at_mut(rows);
    for (x, y) in left.iter_mut().zip(right) {
        (*x, *y) = (cos * *x - sin * *y, sin * *x + cos * *y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;
    use rand_distr::{Distribution, Uniform};

    fn tridiagonal(diagonal: &[f64], off_diagonal: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(diagonal.len(), diagonal.len(), |i, j| match i.abs_diff(j) {
            0 => diagonal[i],
            1 => off_diagonal[i.min(j)],
            _ => 0.0,
        })
    }

    /// The reason for this file; when this test fails, nalgebra can take over.
    #[test]
    fn nalgebra_is_wrong_where_this_is_right() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut entries = |count| -> Vec<f64> {
            let exponents = Uniform::new(-4.0, 0.0).unwrap().sample_iter(&mut random);
            exponents.take(count).map(|x| 10_f64.powf(x)).collect()
        };
        let (mut ours, mut theirs) = (0.0_f64, 0.0_f64);
        for n in (2..14).cycle().take(1000) {
            let (diagonal, off_diagonal) = (entries(n), entries(n - 1));
            let matrix = tridiagonal(&diagonal, &off_diagonal);
            let Eigen { values, vectors } = Eigen::of_tridiagonal(&diagonal, &off_diagonal);
            let back = &vectors * DMatrix::from_diagonal(&values.into()) * vectors.transpose();
            ours = ours.max((back - &matrix).amax());
            theirs = theirs.max((nalgebra::SymmetricEigen::new(matrix.clone()).recompose() - matrix).amax());
        }
        assert!(ours < 1e-14 && theirs > 1e-6, "{ours:e} {theirs:e}");
    }

    /// Entries of all magnitudes, including zeros.
    fn entries(count: usize) -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec(
            prop_oneof![Just(0.0), (-6.0..0.0).prop_map(|x| 10_f64.powf(x)), -1.0..1.0],
            count,
        )
    }

    proptest! {
        #[test]
        fn values_and_vectors_give_the_matrix_back(
            (diagonal, off_diagonal) in (1_usize..20).prop_flat_map(|n| (entries(n), entries(n - 1)))
        ) {
            let count = diagonal.len();
            let matrix = tridiagonal(&diagonal, &off_diagonal);
            for diagonal in [diagonal, vec![0.0; count]] {
                let mut matrix = matrix.clone();
                matrix.set_diagonal(&nalgebra::DVector::from_column_slice(&diagonal));
                let Eigen { values, vectors: q } = Eigen::of_tridiagonal(&diagonal, &off_diagonal);
                let back = &q * DMatrix::from_diagonal(&values.into()) * q.transpose();
                prop_assert!((back - matrix).amax() < 1e-14);
                prop_assert!((q.tr_mul(&q) - DMatrix::identity(count, count)).amax() < 1e-14);
            }
        }

        #[test]
        fn a_full_matrix_as_well(
            (count, entries) in (1_usize..12).prop_flat_map(|n| (Just(n), entries(n * n))),
        ) {
            let matrix = DMatrix::from_vec(count, count, entries);
            let matrix = &matrix + matrix.transpose();
            let Eigen { values, vectors: q } = Eigen::of_symmetric(matrix.clone());
            let back = &q * DMatrix::from_diagonal(&values.into()) * q.transpose();
            prop_assert!((back - matrix).amax() < 1e-13);
        }
    }
}
