//! Products along the crease by FFT: the exchange of two rows depends only on the shift, so it is a
//! convolution.

use std::sync::Arc;

use nalgebra::DMatrix;
use rayon::prelude::*;
use realfft::num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use super::fold_kernel::FoldKernel;

/// The kernel of every pair of rows, transformed along the crease.
///
/// A row of facets is padded to twice its length, so that the convolution does not wrap around; the kernel is
/// symmetric, so its transform is real.
pub struct Spectra {
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    cols: usize,
    /// Frequency, 0 to `cols`, by pair of rows (as numbered by [`FoldKernel::pair`]).
    values: DMatrix<f64>,
}

impl Spectra {
    /// Transforms the entries of `kernel`.
    #[must_use]
    pub fn new(kernel: &FoldKernel) -> Self {
        let cols = kernel.facets().cols;
        let mut planner = RealFftPlanner::new();
        let (forward, inverse) = (planner.plan_fft_forward(2 * cols), planner.plan_fft_inverse(2 * cols));
        let mut spectra = Self { forward, inverse, cols, values: DMatrix::zeros(0, 0) };
        let spectrum = |shifts: &[f64]| {
            let around = shifts.iter().chain([&0.0]).chain(shifts[1..].iter().rev());
            spectra.spectrum(&mut around.copied().collect::<Vec<f64>>())
        };
        let pairs = kernel.all_shifts();
        let (count, real) = (pairs.len(), |value: Complex64| value.re);
        let values = pairs.flat_map_iter(|shifts| spectrum(shifts).into_iter().map(real)).collect();
        spectra.values = DMatrix::from_vec(cols + 1, count, values);
        spectra
    }

    fn spectrum(&self, padded: &mut [f64]) -> Vec<Complex64> {
        let mut spectrum = self.forward.make_output_vec();
        // the lengths are those of the plan, so this cannot fail
        let _ = self.forward.process(padded, &mut spectrum);
        spectrum
    }

    /// Transforms every row of facets, one column of `x` each.
    #[must_use]
    pub fn transform(&self, x: &DMatrix<f64>) -> Vec<Vec<Complex64>> {
        let padded = |row: &[f64]| [row, &vec![0.0; self.cols]].concat();
        x.as_slice().par_chunks_exact(self.cols).map(|row| self.spectrum(&mut padded(row))).collect()
    }

    /// Adds to `out` the light on row `i` of `panel` from the transformed exitance of the other panel.
    pub fn add_up(
        &self,
        kernel: &FoldKernel,
        panel: usize,
        i: usize,
        exitance: &[Vec<Complex64>],
        out: &mut [f64],
    ) {
        let mut sum = self.inverse.make_input_vec();
        for (j, exitance) in exitance.iter().enumerate() {
            let pair = if panel == 0 { kernel.pair(i, j) } else { kernel.pair(j, i) };
            let factors = self.values.column(pair);
            for ((sum, factor), x) in sum.iter_mut().zip(factors.as_slice()).zip(exitance) {
                *sum += x * factor;
            }
        }
        // rounding leaves imaginary parts at both ends, which the plan would reject
        sum[0].im = 0.0;
        sum[self.cols].im = 0.0;
        let mut light = self.inverse.make_output_vec();
        let _ = self.inverse.process(&mut sum, &mut light);
        let scale = 0.5 / self.cols as f64;
        out.iter_mut().zip(light).for_each(|(out, light)| *out += scale * light);
    }
}
