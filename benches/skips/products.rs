//! Products with the kernel, by its entries and by FFT along the crease.

use std::fmt::Write;

use vfold::paper::form_factors;
use vfold::paper::spectra::Spectra;

use super::{ANGLE_DEG, Skip};
use crate::common::{fold, timed};
use crate::direct::{direct, exitance, transformed};

/// Facets along a side at which both ways are compared; primes are the hardest for FFT.
const SIDES: [usize; 12] = [8, 10, 11, 12, 13, 14, 16, 17, 19, 23, 32, 64];
/// Products of one solution, about.
const PRODUCTS: f64 = 13.0;

pub fn rows() -> Vec<String> {
    [64, 256].map(by_fft).into()
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
    let mut page = String::from("Products by FFT, by number of facets along a side, microseconds:\n\n");
    page += "| facets | by entries | by FFT | transforming the kernel | 13 products by entries / by FFT |\n\
             |---|---|---|---|---|\n";
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
