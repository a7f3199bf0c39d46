//! One number per pixel, and filters.

use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

/// One number per pixel, row by row.
#[derive(Debug, Clone)]
pub(super) struct Plane {
    pub width: usize,
    pub values: Vec<f32>,
}

impl Plane {
    /// Correlates each row with the weights `across`, then each column with `down`, both of odd length and
    /// centred; beyond the border the picture is continued.
    pub fn filtered(&self, across: &[f32], down: &[f32]) -> Self {
        let width = self.width;
        let mut rows = vec![0.0_f32; self.values.len()];
        rows.par_chunks_mut(width).zip(self.values.par_chunks(width)).for_each(|(out, row)| {
            let margin = across.len() / 2;
            let mut padded = Vec::with_capacity(width + 2 * margin);
            padded.resize(margin, row[0]);
            padded.extend_from_slice(row);
            padded.resize(width + 2 * margin, row[width - 1]);
            Arch::new().dispatch(WeightedSum { out, weights: across, row: |k| &padded[k..k + width] });
        });
        let height = rows.len() / width;
        let mut values = vec![0.0_f32; rows.len()];
        values.par_chunks_mut(width).enumerate().for_each(|(y, out)| {
            let row = |k: usize| {
                let y = (y + k).saturating_sub(down.len() / 2).min(height - 1);
                &rows[y * width..(y + 1) * width]
            };
            Arch::new().dispatch(WeightedSum { out, weights: down, row });
        });
        Self { width, values }
    }

    /// The plane blurred by a Gaussian of this standard deviation, px.
    pub fn blurred(&self, sigma_px: f32) -> Self {
        let reach = (3.5 * sigma_px).ceil() as i32;
        let weight = |d: i32| (-0.5 * (d as f32 / sigma_px).powi(2)).exp();
        let total: f32 = (-reach..=reach).map(weight).sum();
        let weights: Vec<f32> = (-reach..=reach).map(|d| weight(d) / total).collect();
        self.filtered(&weights, &weights)
    }

    /// The sum of planes of equal size.
    pub fn sum(planes: &[Self; 3]) -> Self {
        let [r, g, b] = planes.each_ref().map(|plane| plane.values.iter());
        Self { width: planes[0].width, values: r.zip(g).zip(b).map(|((r, g), b)| r + g + b).collect() }
    }
}

/// Pixels that are summed at once, in registers.
const AT_ONCE: usize = 32;

/// The sum of rows of pixels, each times its weight, with the processor's widest vectors.
struct WeightedSum<'a, Row> {
    out: &'a mut [f32],
    weights: &'a [f32],
    row: Row,
}

impl<'a, Row: Fn(usize) -> &'a [f32]> WithSimd for WeightedSum<'a, Row> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { out, weights, row } = self;
        let (blocks, rest) = out.as_chunks_mut::<AT_ONCE>();
        let done = blocks.len() * AT_ONCE;
        for (block, out) in blocks.iter_mut().enumerate() {
            let mut sums = [0.0; AT_ONCE];
            for (k, weight) in weights.iter().enumerate() {
                let values = &row(k)[block * AT_ONCE..][..AT_ONCE];
                for n in 0..AT_ONCE {
                    sums[n] += weight * values[n];
                }
            }
            *out = sums;
        }
        for (k, weight) in weights.iter().enumerate() {
            for (out, value) in rest.iter_mut().zip(&row(k)[done..]) {
                *out += weight * value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blur_keeps_an_even_plane_and_spreads_a_point() {
        let even = Plane { width: 9, values: vec![0.5; 9 * 7] }.blurred(1.0);
        assert!(even.values.iter().all(|value| (value - 0.5).abs() < 1e-6));
        let mut point = Plane { width: 31, values: vec![0.0; 31 * 31] };
        point.values[15 * 31 + 15] = 1.0;
        let spread = point.blurred(2.0);
        let variance: f32 = (0..31 * 31).map(|k| spread.values[k] * ((k % 31) as f32 - 15.0).powi(2)).sum();
        assert!((variance - 4.0).abs() < 0.05, "{variance}");
    }
}
