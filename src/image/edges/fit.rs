//! Least squares fits of light as a function of distance from a line.
//!
//! Whatever is fitted is a polynomial in the distance, piece by piece, and so is the fraction of a pixel
//! beyond an edge. All fits follow from a few sums over the pixels of each piece, however many there are.

use std::array;

use nalgebra::{Matrix4, Matrix4x3, Vector3};

/// Number of coefficients per channel: two planes of light, or a cubic polynomial.
pub(super) const COEFFICIENTS: usize = 4;
/// Number of coefficients for one side of an edge.
pub(super) const OF_A_SIDE: f64 = 2.0;
/// Powers of the distance that are summed, by themselves and times the light.
const POWERS: usize = 7;
const POWERS_OF_LIGHT: usize = 4;

/// Fraction of a pixel beyond an edge: coefficients of the powers of the distance.
pub(super) type Share = [f64; 3];

/// Sums over pixels whose distances from a line and light are known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sums {
    /// Of the distance to the powers from 0 on.
    powers: [f64; POWERS],
    /// The same, times the light.
    light: [Vector3<f64>; POWERS_OF_LIGHT],
    pub light_squares: Vector3<f64>,
}

impl Default for Sums {
    fn default() -> Self {
        let none = Vector3::zeros();
        Self { powers: [0.0; POWERS], light: [none; POWERS_OF_LIGHT], light_squares: none }
    }
}

impl Sums {
    /// With one more pixel.
    #[inline]
    pub fn with(mut self, distance: f64, light: &Vector3<f64>) -> Self {
        let mut power = 1.0;
        for (n, sum) in self.powers.iter_mut().enumerate() {
            *sum += power;
            if let Some(sum) = self.light.get_mut(n) {
                *sum += light * power;
            }
            power *= distance;
        }
        self.light_squares += light.component_mul(light);
        self
    }

    /// Without some of the pixels.
    #[inline]
    pub fn without(mut self, others: &Self) -> Self {
        self.powers.iter_mut().zip(others.powers).for_each(|(sum, other)| *sum -= other);
        self.light.iter_mut().zip(others.light).for_each(|(sum, other)| *sum -= other);
        self.light_squares -= others.light_squares;
        self
    }

    /// Number of pixels.
    pub fn count(&self) -> f64 {
        self.powers[0]
    }

    /// Mean light; not a number without pixels.
    pub fn mean(&self) -> Vector3<f64> {
        self.light[0] / self.count()
    }

    /// Sum of squared residuals of a plane of light in each channel; none if the fit is not unique or pixels
    /// are too few.
    pub fn residual(&self) -> Option<Vector3<f64>> {
        let [count, distances, squares, ..] = self.powers;
        let [light, distance_light, ..] = self.light;
        let spread = squares - distances * distances / count;
        let known = count > 2.0 * OF_A_SIDE && spread > 1e-9 * squares;
        known.then(|| {
            let mean = light / count;
            let slope = (distance_light - mean * distances) / spread;
            let explained = mean.component_mul(&light) + slope.component_mul(&slope) * spread;
            (self.light_squares - explained).sup(&Vector3::zeros())
        })
    }
}

/// Normal equations of a fit with [`COEFFICIENTS`] numbers for each channel.
#[derive(Debug, Clone)]
pub(super) struct Fit {
    normal: Matrix4<f64>,
    right: Matrix4x3<f64>,
}

impl Fit {
    /// A cubic polynomial of the distance.
    #[inline]
    pub fn smooth(sums: &Sums) -> Self {
        Self {
            normal: Matrix4::from_fn(|i, j| sums.powers[i + j]),
            right: Matrix4x3::from_fn(|i, channel| sums.light[i][channel]),
        }
    }

    /// Two planes of light with an edge between them.
    ///
    /// # Arguments
    /// - `ends`: sums over the pixels up to where the edge begins to cross them, up to the two places where
    ///   the fraction beyond it becomes another polynomial, and up to where they are wholly beyond; `all`:
    ///   over all pixels.
    /// - `shares`: these fractions.
    #[inline]
    pub fn of_planes(ends: [&Sums; 4], shares: [Share; 3], all: &Sums) -> Self {
        let far = |n: usize| (all.powers[n] - ends[3].powers[n], all.light[n] - ends[3].light[n]);
        let (mut near_near, mut near_far) = ([0, 1, 2].map(|n| ends[0].powers[n]), [0.0; 3]);
        let mut far_far = [0, 1, 2].map(|n| far(n).0);
        let (mut near_light, mut far_light) = ([ends[0].light[0], ends[0].light[1]], [far(0).1, far(1).1]);
        for (ends, share) in ends.windows(2).zip(shares) {
            let [first, end] = [ends[0], ends[1]];
            let square = squared(share);
            let powers: [f64; POWERS] = array::from_fn(|n| end.powers[n] - first.powers[n]);
            for n in 0..3 {
                let once: f64 = share.iter().zip(&powers[n..]).map(|(factor, sum)| factor * sum).sum();
                let twice: f64 = square.iter().zip(&powers[n..]).map(|(factor, sum)| factor * sum).sum();
                near_near[n] += powers[n] - 2.0 * once + twice;
                near_far[n] += once - twice;
                far_far[n] += twice;
            }
            let light: [_; POWERS_OF_LIGHT] = array::from_fn(|n| end.light[n] - first.light[n]);
            for n in 0..2 {
                let beyond = light[n] * share[0] + light[n + 1] * share[1] + light[n + 2] * share[2];
                near_light[n] += light[n] - beyond;
                far_light[n] += beyond;
            }
        }
        let parts = [near_near, near_far, far_far];
        Self {
            normal: Matrix4::from_fn(|i, j| parts[i / 2 + j / 2][i % 2 + j % 2]),
            right: Matrix4x3::from_fn(|i, channel| [near_light, far_light][i / 2][i % 2][channel]),
        }
    }

    /// How much of the sum of squares it explains in each channel; `None` if it is not unique.
    #[inline]
    pub fn explained(&self) -> Option<Vector3<f64>> {
        let whitened = self.normal.cholesky()?.l_dirty().solve_lower_triangular(&self.right)?;
        Some(whitened.component_mul(&whitened).row_sum_tr())
    }
}

/// The square of a polynomial.
fn squared([constant, slope, bend]: Share) -> [f64; 5] {
    let middle = slope * slope + 2.0 * constant * bend;
    [constant * constant, 2.0 * constant * slope, middle, 2.0 * slope * bend, bend * bend]
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
        assert!((sums(true).residual().unwrap() - Vector3::from_element(10.0)).amax() < 0.01);
        assert!(sums(true).without(&sums(false)).residual().is_none());
    }
}
