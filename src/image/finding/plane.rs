//! One number per pixel, and filters.

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
            for (k, weight) in across.iter().enumerate() {
                out.iter_mut().zip(&padded[k..]).for_each(|(out, value)| *out += weight * value);
            }
        });
        let height = rows.len() / width;
        let mut values = vec![0.0_f32; rows.len()];
        values.par_chunks_mut(width).enumerate().for_each(|(y, out)| {
            for (k, weight) in down.iter().enumerate() {
                let y = (y + k).saturating_sub(down.len() / 2).min(height - 1);
                let row = &rows[y * width..(y + 1) * width];
                out.iter_mut().zip(row).for_each(|(out, value)| *out += weight * value);
            }
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
