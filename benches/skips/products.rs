//! Products with the kernel, by its entries and by FFT along the crease.

use std::fmt::Write;

use vfold::kernel::FoldKernel;
use vfold::kernel::exact::form_factors;
use vfold::kernel::spectra::Spectra;

use super::{ANGLE_DEG, Skip};
use crate::common::{fold, timed};

/// Facets along a side at which both ways are compared; primes are the hardest for FFT.
const SIDES: [usize; 12] = [8, 10, 11, 12, 13, 14, 16, 17, 19, 23, 32, 64];
/// Products of one solution, about.
const PRODUCTS: f64 = 13.0;

pub fn rows() -> Vec<String> {
    [64, 256].map(by_fft).into()
}

/// Light on the facets of panel 0 from exitance `x` of panel 1, entry by entry.
fn direct(kernel: &FoldKernel, x: &[f64]) -> Vec<f64> {
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
fn transformed(kernel: &FoldKernel, spectra: &Spectra, x: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; x.len()];
    let x = spectra.transform(x);
    for (i, out) in out.chunks_exact_mut(kernel.facets().cols).enumerate() {
        spectra.add_up(kernel, 0, i, &x, out);
    }
    out
}

fn exitance(n: usize) -> Vec<f64> {
    (0..n * n).map(|k| 1.0 + 0.5 * (k as f64).sin()).collect()
}

fn by_fft(n: usize) -> String {
    let (kernel, x) = (form_factors(&fold(ANGLE_DEG, n)), exitance(n));
    let spectra = Spectra::new(&kernel);
    let skip = Skip::new(
        format!("products along the crease, {n}x{n}"),
        format!("{} products of numbers", n.pow(4)),
        "FFT",
    );
    skip.row(|| direct(&kernel, &x), || transformed(&kernel, &spectra, &x))
}

/// The table of times by the number of facets.
pub fn break_even() -> String {
    let mut page = String::from("Products by FFT, by the facets along a side, microseconds:\n\n");
    page += "| facets | by entries | by FFT | transforming the kernel | 13 products by entries / by FFT |\n|---|---|---|---|---|\n";
    for n in SIDES {
        let (kernel, x) = (form_factors(&fold(ANGLE_DEG, n)), exitance(n));
        let (entries, _) = timed(|| direct(&kernel, &x));
        let (start, spectra) = timed(|| Spectra::new(&kernel));
        let (fft, _) = timed(|| transformed(&kernel, &spectra, &x));
        let ratio = PRODUCTS * entries / (start + PRODUCTS * fft);
        let [entries, fft, start] = [entries, fft, start].map(|ms| 1e3 * ms);
        writeln!(page, "| {n}x{n} | {entries:.1} | {fft:.1} | {start:.1} | {ratio:.2} |").unwrap();
    }
    page
}
