//! Products with the kernel, by its entries and by FFT along the crease.

use nalgebra::DMatrix;
use vfold::paper::FoldKernel;
use vfold::paper::spectra::Spectra;

/// Light on the facets of panel 0 from exitance `x` of panel 1, entry by entry.
pub fn direct(kernel: &FoldKernel, x: &[f64]) -> Vec<f64> {
    let (rows, cols) = (kernel.facets().rows, kernel.facets().cols);
    let mut out = vec![0.0; rows * cols];
    for (i, out) in out.chunks_exact_mut(cols).enumerate() {
        for (j, x) in x.chunks_exact(cols).enumerate() {
            let factors = kernel.shifts(i, j);
            for (c, out) in out.iter_mut().enumerate() {
                let below: f64 = factors[1..=c].iter().zip(x[..c].iter().rev()).map(|(f, x)| f * x).sum();
                let above: f64 = factors.iter().zip(&x[c..]).map(|(f, x)| f * x).sum();
                *out += below + above;
            }
        }
    }
    out
}

/// The same by FFT.
pub fn transformed(kernel: &FoldKernel, spectra: &Spectra, x: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; x.len()];
    let cols = kernel.facets().cols;
    let x = spectra.transform(&DMatrix::from_column_slice(cols, x.len() / cols, x));
    for (i, out) in out.chunks_exact_mut(cols).enumerate() {
        spectra.add_up(kernel, 0, i, &x, out);
    }
    out
}

/// Some exitance of `n` x `n` facets.
pub fn exitance(n: usize) -> Vec<f64> {
    (0..n * n).map(|k| 1.0 + 0.5 * (k as f64).sin()).collect()
}
