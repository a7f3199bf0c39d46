//! Least squares fits of light as a function of distance from a line, and sums from which they follow
//! quickly.

use nalgebra::{Matrix4, Matrix4x3, SVector, Vector3};

/// Number of coefficients per piece and channel: two planes of light, or a polynomial across it.
pub(super) const COEFFICIENTS: usize = 4;
/// Number of coefficients for one side of it.
const OF_A_SIDE: f64 = 2.0;

/// Sums over pixels whose distances from a line and light are known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sums {
    pub count: f64,
    distances: f64,
    distance_squares: f64,
    light: Vector3<f64>,
    distance_light: Vector3<f64>,
    pub light_squares: Vector3<f64>,
}

impl Default for Sums {
    fn default() -> Self {
        let none = Vector3::zeros();
        Self {
            count: 0.0,
            distances: 0.0,
            distance_squares: 0.0,
            light: none,
            distance_light: none,
            light_squares: none,
        }
    }
}

impl Sums {
    /// With one more pixel.
    pub fn with(&self, distance: f64, light: &Vector3<f64>) -> Self {
        Self {
            count: self.count + 1.0,
            distances: self.distances + distance,
            distance_squares: self.distance_squares + distance * distance,
            light: self.light + light,
            distance_light: self.distance_light + light * distance,
            light_squares: self.light_squares + light.component_mul(light),
        }
    }

    /// Without some of the pixels.
    pub fn without(&self, others: &Self) -> Self {
        Self {
            count: self.count - others.count,
            distances: self.distances - others.distances,
            distance_squares: self.distance_squares - others.distance_squares,
            light: self.light - others.light,
            distance_light: self.distance_light - others.distance_light,
            light_squares: self.light_squares - others.light_squares,
        }
    }

    /// The same pixels, with distances from a line shifted by `distance`.
    pub fn seen_from(&self, distance: f64) -> Self {
        Self {
            distances: self.distances - distance * self.count,
            distance_squares: self.distance_squares
                - distance * (2.0 * self.distances - distance * self.count),
            distance_light: self.distance_light - self.light * distance,
            ..*self
        }
    }

    /// Sum of squared residuals of a plane of light in each channel; none if the fit is not unique or pixels
    /// are too few.
    pub fn residual(&self) -> Option<Vector3<f64>> {
        let spread = self.distance_squares - self.distances * self.distances / self.count;
        let known = self.count > 2.0 * OF_A_SIDE && spread > 1e-9 * self.distance_squares;
        known.then(|| {
            let mean = self.light / self.count;
            let slope = (self.distance_light - mean * self.distances) / spread;
            let explained = mean.component_mul(&self.light) + slope.component_mul(&slope) * spread;
            (self.light_squares - explained).sup(&Vector3::zeros())
        })
    }
}

/// Normal equations of a fit with [`COEFFICIENTS`] numbers for each channel.
#[derive(Debug, Clone)]
pub(super) struct Fit {
    pub normal: Matrix4<f64>,
    pub right: Matrix4x3<f64>,
}

impl Default for Fit {
    fn default() -> Self {
        Self { normal: Matrix4::zeros(), right: Matrix4x3::zeros() }
    }
}

impl Fit {
    /// A plane of light for each of two groups of pixels.
    pub fn of_sides(near: &Sums, far: &Sums) -> Self {
        let mut fit = Self::default();
        for (first, sums) in [(0, near), (2, far)] {
            fit.normal[(first, first)] = sums.count;
            fit.normal[(first, first + 1)] = sums.distances;
            fit.normal[(first + 1, first)] = sums.distances;
            fit.normal[(first + 1, first + 1)] = sums.distance_squares;
            fit.right.set_row(first, &sums.light.transpose());
            fit.right.set_row(first + 1, &sums.distance_light.transpose());
        }
        fit
    }

    /// Adds a pixel of this light, which the fit models by these basis values.
    pub fn add(&mut self, basis: &SVector<f64, COEFFICIENTS>, light: &Vector3<f64>) {
        self.normal += basis * basis.transpose();
        self.right += basis * light.transpose();
    }

    /// Adds pixels that see part of both sides: their distances from the edge, the fractions of them beyond
    /// it, and their light.
    pub fn add_mixed<'a>(&mut self, pixels: impl Iterator<Item = (f64, f64, &'a Vector3<f64>)>) {
        // near by near, near by far and far by far: sums of 1, z and z²
        let (mut sums, mut right) = ([[0.0; 3]; 3], [Vector3::zeros(); COEFFICIENTS]);
        for (z, beyond, light) in pixels {
            let before = 1.0 - beyond;
            for (sums, weight) in sums.iter_mut().zip([before * before, before * beyond, beyond * beyond]) {
                sums[0] += weight;
                sums[1] += weight * z;
                sums[2] += weight * z * z;
            }
            for (right, weight) in right.iter_mut().zip([before, before * z, beyond, beyond * z]) {
                *right += light * weight;
            }
        }
        for (i, j) in (0..COEFFICIENTS).flat_map(|i| (0..COEFFICIENTS).map(move |j| (i, j))) {
            self.normal[(i, j)] += sums[i / 2 + j / 2][i % 2 + j % 2];
        }
        for (row, right) in right.iter().enumerate() {
            let sum = self.right.row(row) + right.transpose();
            self.right.set_row(row, &sum);
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;

    #[test]
    fn a_plane_of_light_leaves_nothing_and_noise_what_it_is() {
        let light = |k: f64| Vector3::new(1.0 + 2.0 * k, 3.0 - k, 0.5);
        let noise = |k: i32| if k % 2 == 0 { 0.1 } else { -0.1 };
        let sums = |noisy: bool| {
            (0..1000).fold(Sums::default(), |sums, k| {
                let distance = f64::from(k) / 100.0;
                sums.with(distance, &light(distance).add_scalar(if noisy { noise(k) } else { 0.0 }))
            })
        };
        assert!(sums(false).residual().unwrap().amax() < 1e-8);
        assert!(sums(false).seen_from(5.0).residual().unwrap().amax() < 1e-8);
        assert!((sums(true).residual().unwrap() - Vector3::from_element(10.0)).amax() < 0.01);
        assert!(sums(true).without(&sums(false)).residual().is_none());
    }
}
