//! Sums of values and of columns, computed with the widest vectors of the processor.

use std::slice::ChunksExact;

use nalgebra::DMatrix;
use pulp::Arch;

/// Radiance of all facets at the albedo nodes: facet by node.
pub type Radiance = DMatrix<f64>;

/// Adds a multiple of other values.
pub fn add(sum: &mut [f64], share: f64, values: &[f64]) {
    Arch::new().dispatch(|| sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += share * value));
}

/// Columns as slices, which compile to faster loops than matrices.
pub fn columns(matrix: &DMatrix<f64>) -> ChunksExact<'_, f64> {
    matrix.as_slice().chunks_exact(matrix.nrows())
}

/// Adds the product of two matrices, the second with few columns, for which a general product is slow.
pub fn add_product(sum: &mut DMatrix<f64>, a: &DMatrix<f64>, b: &DMatrix<f64>) {
    Arch::new().dispatch(|| {
        for (sum, shares) in sum.as_mut_slice().chunks_exact_mut(a.nrows()).zip(columns(b)) {
            for (column, share) in columns(a).zip(shares) {
                sum.iter_mut().zip(column).for_each(|(sum, value)| *sum += share * value);
            }
        }
    });
}
