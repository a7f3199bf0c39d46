//! Along the crease: Legendre polynomials on strips graded towards its end.

use nalgebra::DMatrix;

use super::Resolution;
use super::correlation::Correlation;
use crate::kernel::quadrature::{Rule, legendre_series};

/// The half of the crease from its end to its middle, in strips that carry Legendre polynomials.
pub(super) struct Crease {
    width: f64,
    pub(super) strips: Vec<[f64; 2]>,
    pub(super) order: usize,
}

impl Crease {
    pub(super) fn new(width: f64, resolution: &Resolution) -> Self {
        let half = 0.5 * width;
        let first = (resolution.end_strip * width.min(1.0)).min(half);
        let graded = ((half / first).ln() / resolution.strip_growth.ln()).ceil();
        let end = |k: usize| first * (half / first).powf(k as f64 / graded);
        let others = (0..graded as usize).map(|k| [end(k), end(k + 1)]);
        let strips = std::iter::once([0.0, first]).chain(others).collect();
        Self { width, strips, order: resolution.strip_order }
    }

    /// Coordinates of the function 1 in the normalised polynomials of all strips.
    pub(super) fn uniform(&self) -> impl Iterator<Item = f64> + '_ {
        let one = |[low, high]: [f64; 2]| {
            (0..self.order).map(move |b| if b == 0 { (high - low).sqrt() } else { 0.0 })
        };
        self.strips.iter().copied().flat_map(one)
    }

    /// Means over the first half of `count` facet columns: column by polynomial.
    pub(super) fn means(&self, count: usize) -> DMatrix<f64> {
        let mut pool = DMatrix::zeros(count.div_ceil(2), self.strips.len() * self.order);
        let rule = Rule::gauss_legendre(self.order);
        let facet = self.width / count as f64;
        let mut values = vec![0.0; self.order];
        for col in 0..count.div_ceil(2) {
            // A middle column ends at the middle: its other half is its mirror image.
            let (low, high) = (col as f64 * facet, ((col + 1) as f64 * facet).min(0.5 * self.width));
            for (n, strip) in self.strips.iter().enumerate() {
                let (from, to) = (strip[0].max(low), strip[1].min(high));
                if from >= to {
                    continue;
                }
                for (x, w) in rule.on(from, to) {
                    polynomials(*strip, x, &mut values);
                    for (b, value) in values.iter().enumerate() {
                        pool[(col, n * self.order + b)] += w * value / (high - low);
                    }
                }
            }
        }
        pool
    }

    /// Correlation of strip `e` with strip `f` and with the mirror image of `f`.
    pub(super) fn correlation(&self, e: usize, f: usize, peak: f64) -> Correlation {
        let [low, high] = self.strips[f];
        let mut correlation = Correlation::new(self.order);
        correlation.add(self.strips[e], [low, high], false, peak);
        correlation.add(self.strips[e], [self.width - high, self.width - low], true, peak);
        correlation
    }
}

/// Normalised Legendre polynomials of a strip at `x`.
pub(super) fn polynomials(strip: [f64; 2], x: f64, values: &mut [f64]) {
    let length = strip[1] - strip[0];
    legendre_series((2.0 * x - strip[0] - strip[1]) / length, values);
    for (b, value) in values.iter_mut().enumerate() {
        *value *= ((2 * b + 1) as f64 / length).sqrt();
    }
}
