//! The paper's model: every facet is one flat patch of even radiance.

use rayon::prelude::*;

use super::exact::FoldKernel;
use super::panel::{PanelOperator, mirrored};
use crate::geometry::FacetGrid;

/// Exchange between facets, eq. (10), as block-Toeplitz products with the distinct entries: the dense matrix is not formed.
pub struct FacetOperator<'a> {
    kernel: &'a FoldKernel,
    facets: FacetGrid,
    half_cols: usize,
    /// The middle column of an odd number is its own mirror image: 1/√2 there keeps the operator symmetric.
    col_scale: Vec<f64>,
}

impl<'a> FacetOperator<'a> {
    /// The operator of a kernel whose patches are the facets or divide them evenly.
    #[must_use]
    pub fn new(kernel: &'a FoldKernel, facets: FacetGrid) -> Self {
        let half_cols = kernel.cols().div_ceil(2);
        let mut col_scale = vec![1.0; half_cols];
        if kernel.cols() % 2 == 1 {
            col_scale[half_cols - 1] = 0.5_f64.sqrt();
        }
        Self { kernel, facets, half_cols, col_scale }
    }

    /// Irradiance on row `i` from all rows of the other panel.
    fn apply_row(&self, i: usize, x: &[f64], out: &mut [f64]) {
        let last = self.kernel.cols() - 1;
        out.fill(0.0);
        for (j, x_row) in x.chunks_exact(self.half_cols).enumerate() {
            let factors = self.kernel.shifts(i, j);
            for (c, out) in out.iter_mut().enumerate() {
                let mut sum = 0.0;
                for (d, (x, scale)) in x_row.iter().zip(&self.col_scale).enumerate() {
                    sum += (factors[c.abs_diff(d)] + factors[last - d - c]) * scale * x;
                }
                *out += sum;
            }
        }
        let height = self.kernel.row_height(i);
        out.iter_mut().zip(&self.col_scale).for_each(|(out, scale)| *out *= scale / height);
    }
}

impl PanelOperator for FacetOperator<'_> {
    fn uniform(&self) -> Vec<f64> {
        self.col_scale.iter().copied().cycle().take(self.kernel.rows() * self.half_cols).collect()
    }

    fn apply(&self, x: &[f64], out: &mut [f64]) {
        let rows_of = out.par_chunks_exact_mut(self.half_cols).enumerate();
        // Small grids are done before a second thread has woken up.
        rows_of
            .with_min_len(if x.len() < 1000 { x.len() } else { 1 })
            .for_each(|(i, out)| self.apply_row(i, x, out));
    }

    fn facet_means(&self, x: &[f64]) -> Vec<f64> {
        let cols = self.kernel.cols();
        let patch = |row: usize, col: usize| {
            let col = col.min(cols - 1 - col);
            x[row * self.half_cols + col] / self.col_scale[col]
        };
        let (high, wide) = (self.kernel.rows() / self.facets.rows, cols / self.facets.cols);
        mirrored(self.facets, |row, col| {
            let patches = (0..high * wide).map(|n| patch(row * high + n / wide, col * wide + n % wide));
            patches.sum::<f64>() / (high * wide) as f64
        })
    }
}
