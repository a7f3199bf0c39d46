//! The paper's model: each facet is one flat patch of uniform radiance.

use nalgebra::{DMatrix, DMatrixView};
use rayon::prelude::*;

use super::fold_kernel::FoldKernel;
use super::spectra::Spectra;
use crate::geometry::FacetGrid;
use crate::response::PanelOperator;

/// Number of columns from which products by FFT along the crease are faster than direct ones.
const FFT_FROM: usize = 16;
/// Number of unknowns from which a second thread pays: smaller problems are finished before it has started.
const THREADS_FROM: usize = 1000;

/// Exchange between facets, eq. (10), as products with the distinct entries, without forming the dense
/// matrix.
pub struct FacetOperator<'a> {
    kernel: &'a FoldKernel,
    facets: FacetGrid,
    spectra: Option<Spectra>,
    /// Square roots of the rows' depths on each panel.
    scale: [Vec<f64>; 2],
}

impl<'a> FacetOperator<'a> {
    /// The operator of a kernel whose patches are the facets, or divide each facet into equally many of equal
    /// size.
    #[must_use]
    pub fn new(kernel: &'a FoldKernel, facets: FacetGrid) -> Self {
        let FacetGrid { rows, cols } = kernel.facets();
        let scale = [0, 1].map(|panel| (0..rows).map(|i| kernel.row_height(panel, i).sqrt()).collect());
        let spectra = (cols >= FFT_FROM).then(|| Spectra::new(kernel));
        Self { kernel, facets, spectra, scale }
    }

    /// `out = Σ A·F·x`: light on the facets of row `i` of `panel`, by direct products; `x` has one column per
    /// row of facets.
    fn add_up(&self, panel: usize, i: usize, x: &DMatrix<f64>, out: &mut [f64]) {
        for (j, x) in x.column_iter().enumerate() {
            let (x, factors) = (x.as_slice(), self.kernel.shifts_from(panel, i, j));
            for (c, out) in out.iter_mut().enumerate() {
                let below: f64 = factors[1..=c].iter().zip(x[..c].iter().rev()).map(|(f, x)| f * x).sum();
                let above: f64 = factors.iter().zip(&x[c..]).map(|(f, x)| f * x).sum();
                *out += below + above;
            }
        }
    }
}

impl PanelOperator for FacetOperator<'_> {
    fn is_symmetric(&self) -> bool {
        self.kernel.is_symmetric()
    }

    fn uniform(&self, panel: usize) -> Vec<f64> {
        let cols = self.kernel.facets().cols;
        self.scale[panel].iter().flat_map(|scale| std::iter::repeat_n(*scale, cols)).collect()
    }

    fn apply(&self, panel: usize, x: &[f64], out: &mut [f64]) {
        let FacetGrid { rows, cols } = self.kernel.facets();
        let mut exitance = DMatrix::from_column_slice(cols, rows, x);
        for (mut row, scale) in exitance.column_iter_mut().zip(&self.scale[1 - panel]) {
            row /= *scale;
        }
        let transformed = self.spectra.as_ref().map(|spectra| (spectra, spectra.transform(&exitance)));
        let rows = out.par_chunks_exact_mut(cols).enumerate();
        // small grids are finished before a second thread has started
        rows.with_min_len(if x.len() < THREADS_FROM { x.len() } else { 1 }).for_each(|(i, out)| {
            out.fill(0.0);
            match &transformed {
                Some((spectra, x)) => spectra.add_up(self.kernel, panel, i, x, out),
                None => self.add_up(panel, i, &exitance, out),
            }
            out.iter_mut().for_each(|light| *light /= self.scale[panel][i]);
        });
    }

    fn facet_means(&self, panel: usize, x: &[f64]) -> Vec<f64> {
        let FacetGrid { rows, cols } = self.kernel.facets();
        let (high, wide) = (rows / self.facets.rows, cols / self.facets.cols);
        let x = DMatrixView::from_slice(x, cols, rows);
        let mut means = DMatrix::zeros(self.facets.cols, self.facets.rows);
        for (row, mut means) in means.column_iter_mut().enumerate() {
            let patches = row * high..(row + 1) * high;
            for (x, scale) in
                x.columns_range(patches.clone()).column_iter().zip(&self.scale[panel][patches.clone()])
            {
                for (mean, x) in means.iter_mut().zip(x.as_slice().chunks_exact(wide)) {
                    *mean += scale * x.iter().sum::<f64>();
                }
            }
            means /= wide as f64 * self.scale[panel][patches].iter().map(|scale| scale * scale).sum::<f64>();
        }
        means.data.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Fold, Spacing};
    use crate::paper::form_factors;

    #[test]
    fn products_by_fft_are_those_with_the_entries() {
        for (cols, depth1) in [(24, 1.0), (25, 0.6)] {
            let fold = Fold::new(40.0, 2.0, 1.0, FacetGrid { rows: 3, cols }).unwrap();
            let fold = fold.with_spacing(Spacing::Graded).with_panel1_depth(depth1).unwrap();
            let kernel = form_factors(&fold);
            let operator = FacetOperator::new(&kernel, fold.facets());
            let direct = FacetOperator { spectra: None, ..FacetOperator::new(&kernel, fold.facets()) };
            let x: Vec<f64> = (0..3 * cols).map(|k| (k as f64).sin()).collect();
            for panel in [0, 1] {
                let [mut a, mut b] = [vec![0.0; x.len()], vec![0.0; x.len()]];
                operator.apply(panel, &x, &mut a);
                direct.apply(panel, &x, &mut b);
                assert!(
                    a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-15),
                    "{cols} columns, panel {panel}"
                );
            }
        }
    }
}
