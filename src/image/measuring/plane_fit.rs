//! The mean of a facet whose pixels do not cover it evenly.
//!
//! Pixels on a panel's edges and clipped ones are excluded, which biases the plain mean of the others where
//! light varies along the facet. A plane fitted to them in panel coordinates avoids this: its value at the
//! facet's centre is the facet's mean to first order, and its residuals contain noise without the gradient.

/// Fewest pixels that determine a plane (three numbers) and its noise.
const PLANE_PIXELS: f64 = 6.0;
/// Least determinant of the pixels' second moments, (facet side)⁴; a facet covered evenly has 1/144.
const FLAT: f64 = 1e-7;

/// Weighted sums over the pixels of one facet; (u, v) relative to the facet's centre, in units of its sides.
#[derive(Debug, Clone, Default)]
pub(super) struct PixelSums {
    w: f64,
    ww: f64,
    wu: f64,
    wv: f64,
    wuu: f64,
    wuv: f64,
    wvv: f64,
    light: [LightSums; 3],
}

/// Weighted sums over one channel's light y.
#[derive(Debug, Clone, Copy, Default)]
struct LightSums {
    wy: f64,
    wyy: f64,
    wyu: f64,
    wyv: f64,
}

/// A few adjacent pixels, close enough to share one weight and one position.
#[derive(Debug, Clone, Default)]
pub(super) struct Run {
    /// Number of pixels.
    pixels: usize,
    /// Sum of their columns.
    columns: usize,
    /// Sums of their light and of its square.
    light: [(f64, f64); 3],
}

impl Run {
    /// Adds the pixel in column `x`.
    #[inline]
    pub fn add(&mut self, x: usize, light: [f64; 3]) {
        self.pixels += 1;
        self.columns += x;
        for ((sum, squares), y) in self.light.iter_mut().zip(light) {
            *sum += y;
            *squares += y * y;
        }
    }

    /// Number of pixels.
    #[inline]
    pub fn pixels(&self) -> f64 {
        self.pixels as f64
    }

    /// The mean of their light in one channel; NaN without pixels.
    #[inline]
    pub fn mean(&self, channel: usize) -> f64 {
        self.light[channel].0 / self.pixels()
    }

    /// Column coordinate of their middle, px; NaN without pixels.
    pub fn x(&self) -> f64 {
        self.columns as f64 / self.pixels() + 0.5
    }
}

/// The mean of a facet in one channel, and its standard error if the pixels determine it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Estimate {
    pub mean: f64,
    pub standard_error: Option<f64>,
    /// Of the plane, along u and v; zero if pixels are too few for one.
    slopes: [f64; 2],
}

impl PixelSums {
    /// Adds pixels of weight `w` each, around (u, v).
    #[inline]
    pub fn add(&mut self, w: f64, u: f64, v: f64, run: &Run) {
        let sum = w * run.pixels();
        self.w += sum;
        self.ww += w * sum;
        self.wu += sum * u;
        self.wv += sum * v;
        self.wuu += sum * u * u;
        self.wuv += sum * u * v;
        self.wvv += sum * v * v;
        for (sums, (y, yy)) in self.light.iter_mut().zip(run.light) {
            sums.wy += w * y;
            sums.wyy += w * yy;
            sums.wyu += w * y * u;
            sums.wyv += w * y * v;
        }
    }

    /// Effective number of equally weighted pixels: (Σw)²/Σw².
    fn pixels(&self) -> f64 {
        self.w * self.w / self.ww
    }

    /// The facet's mean in one channel; none without pixels.
    pub fn estimate(&self, channel: usize) -> Option<Estimate> {
        let (n, light) = (self.pixels(), &self.light[channel]);
        if self.w <= 0.0 {
            return None;
        }
        let [u, v, y] = [self.wu, self.wv, light.wy].map(|sum| sum / self.w);
        let covariance = |sum: f64, a: f64, b: f64| sum / self.w - a * b;
        let (uu, uv, vv) =
            (covariance(self.wuu, u, u), covariance(self.wuv, u, v), covariance(self.wvv, v, v));
        let (yy, yu, yv) =
            (covariance(light.wyy, y, y), covariance(light.wyu, y, u), covariance(light.wyv, y, v));
        let det = uu * vv - uv * uv;
        if n < PLANE_PIXELS || det < FLAT {
            return Some(Estimate::new([y, 0.0, 0.0], yy, n, 1.0, 1.0));
        }
        let (slope_u, slope_v) = ((yu * vv - yv * uv) / det, (yv * uu - yu * uv) / det);
        let leverage = (u * u * vv - 2.0 * u * v * uv + v * v * uu) / det;
        let mean = y - slope_u * u - slope_v * v;
        let square_residual = yy - slope_u * yu - slope_v * yv;
        Some(Estimate::new([mean, slope_u, slope_v], square_residual, n, 3.0, 1.0 + leverage))
    }
}

impl Estimate {
    /// From the mean square residual of a fit of `fitted` numbers, with `variance_factor` for extrapolation
    /// beyond the pixels.
    fn new(plane: [f64; 3], square_residual: f64, n: f64, fitted: f64, variance_factor: f64) -> Self {
        let spare = n - fitted;
        let standard_error =
            (spare >= 1.0).then(|| (square_residual.max(0.0) * variance_factor / spare).sqrt());
        let [mean, slope_u, slope_v] = plane;
        Self { mean, standard_error, slopes: [slope_u, slope_v] }
    }

    /// The plane's value at (u, v) relative to the facet's centre.
    #[inline]
    pub fn plane(&self, u: f64, v: f64) -> f64 {
        self.mean + self.slopes[0] * u + self.slopes[1] * v
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sums(pixels: &[(f64, f64, f64, f64)]) -> PixelSums {
        let mut sums = PixelSums::default();
        for &(w, u, v, y) in pixels {
            let mut run = Run::default();
            run.add(0, [y; 3]);
            sums.add(w, u, v, &run);
        }
        sums
    }

    /// NumPy 2: `c, cov = np.linalg.lstsq(A, y), inv(A.T A) * rss/(8 - 3)`; then c[0] and sqrt(cov[0, 0]).
    #[test]
    fn a_plane_fit_agrees_with_numpy() {
        let pixels = [
            (1.0, -0.4, -0.3, 1.00),
            (1.0, -0.2, 0.1, 1.25),
            (1.0, 0.0, -0.1, 1.31),
            (1.0, 0.1, 0.4, 1.52),
            (1.0, 0.3, 0.0, 1.49),
            (1.0, 0.4, 0.3, 1.66),
            (1.0, -0.1, 0.45, 1.42),
            (1.0, 0.25, -0.35, 1.38),
        ];
        let estimate = sums(&pixels).estimate(1).unwrap();
        assert!((estimate.mean - 1.3337224433813932).abs() < 1e-12, "{estimate:?}");
        assert!((estimate.standard_error.unwrap() - 0.003901385311064138).abs() < 1e-12, "{estimate:?}");
    }

    #[test]
    fn a_gradient_is_no_noise_and_no_bias() {
        // the left half of a facet with light that grows by 2 along u
        let half: Vec<_> =
            (0..50).map(|k| (1.0, -0.5 + f64::from(k % 5) / 10.0, f64::from(k / 5) / 10.0 - 0.45)).collect();
        let half: Vec<_> = half.into_iter().map(|(w, u, v)| (w, u, v, 7.0 + 2.0 * u)).collect();
        let estimate = sums(&half).estimate(0).unwrap();
        assert!(
            (estimate.mean - 7.0).abs() < 1e-12 && estimate.standard_error.unwrap() < 1e-8,
            "{estimate:?}"
        );
    }

    #[test]
    fn few_pixels_give_what_they_can() {
        assert_eq!(sums(&[]).estimate(0), None);
        let one = sums(&[(0.3, 0.1, 0.1, 5.0)]).estimate(0).unwrap();
        assert_eq!((one.mean, one.standard_error), (5.0, None));
        let two = sums(&[(1.0, 0.1, 0.1, 5.0), (1.0, 0.2, 0.1, 7.0)]).estimate(0).unwrap();
        assert_eq!((two.mean, two.standard_error), (6.0, Some(1.0))); // sd √2, over √2
        let line: Vec<_> =
            (0..20).map(|k| (1.0, f64::from(k) / 20.0 - 0.475, 0.3, f64::from(k % 2))).collect();
        let line = sums(&line).estimate(0).unwrap();
        assert!((line.mean - 0.5).abs() < 1e-12 && line.standard_error.is_some(), "{line:?}");
    }
}
