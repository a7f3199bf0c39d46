//! The exchange of light between the patches of any surface, with all form factors in memory.

use nalgebra::{DMatrix, DVectorView, DVectorViewMut};

use super::Exchange;

/// Form factors between all patches as one symmetric matrix.
#[derive(Clone, Debug)]
pub struct DenseExchange {
    symmetric: DMatrix<f64>,
    root_areas: Vec<f64>,
    facet_of: Vec<usize>,
}

impl DenseExchange {
    /// From K of eq. (10) between patches of these `areas`, each in the facet stated by `facet_of`:
    /// `areaᵢ·kernelᵢⱼ = areaⱼ·kernelⱼᵢ`, which makes `√A·K·√A⁻¹` symmetric.
    ///
    /// # Example
    /// ```
    /// use nalgebra::dmatrix;
    /// use vfold::surfaces::{DenseExchange, Exchange};
    /// // A patch of area 4 hands a tenth of its light to one of area 1, which hands four tenths back.
    /// let exchange = DenseExchange::new(&dmatrix![0.0, 0.1; 0.4, 0.0], &[4.0, 1.0], vec![0, 1]);
    /// let mut received = [0.0; 2];
    /// exchange.apply(&[0.0, 1.0], &mut received);
    /// assert!((received[0] - 0.2).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn new(kernel: &DMatrix<f64>, areas: &[f64], facet_of: Vec<usize>) -> Self {
        let root_areas: Vec<f64> = areas.iter().map(|area| area.sqrt()).collect();
        let scaled = |i: usize, j: usize| root_areas[i] * kernel[(i, j)] / root_areas[j];
        let count = areas.len();
        // rounding, and residual noise in K, must not break the symmetry on which the Lanczos method relies
        let symmetric = DMatrix::from_fn(count, count, |i, j| 0.5 * (scaled(i, j) + scaled(j, i)));
        Self { symmetric, root_areas, facet_of }
    }
}

impl Exchange for DenseExchange {
    fn root_areas(&self) -> &[f64] {
        &self.root_areas
    }

    fn facet_of(&self) -> &[usize] {
        &self.facet_of
    }

    fn apply(&self, x: &[f64], out: &mut [f64]) {
        let (x, count) = (DVectorView::from_slice(x, x.len()), out.len());
        DVectorViewMut::from_slice(out, count).gemv(1.0, &self.symmetric, &x, 0.0);
    }
}
