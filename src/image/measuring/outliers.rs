//! Pixels that do not show the sheet: dust, specks, a hair.
//!
//! Pixels far from the plane fitted to a facet's other pixels are excluded, and the plane refitted until
//! nothing changes. With clean Gaussian noise that excludes one pixel in two million and raises the standard
//! error by less than 0.1 %, even for 5 x 5 pixels. A weighted fit such as Huber's (1.026 at its usual
//! tuning) would still admit some influence of every speck.

use super::plane_fit::{Estimate, PixelSums, Run};

/// A run of pixels in a facet.
#[derive(Debug, Clone)]
pub(super) struct Placed {
    /// Weight of each of its pixels.
    pub weight: f64,
    /// Its position relative to the facet's centre, in facet sides.
    pub u: f64,
    /// See `u`.
    pub v: f64,
    /// Its pixels.
    pub run: Run,
}

/// Largest distance from the plane of a pixel of the sheet, standard deviations.
const REACH: f64 = 5.0;
/// Fewest runs that determine the usual scatter.
const FEW: usize = 20;
/// Runs from which the scatter is estimated: its error, a few percent, changes the reach as little.
const SPREAD_RUNS: usize = 500;
/// Three quarters of normally distributed numbers lie within this many standard deviations.
const THREE_QUARTERS: f64 = 1.150_349_380_376_008;
/// Least standard deviation relative to the root mean square: where most pixels of a flat 8-bit facet hold
/// one number, those with the next one are no outliers. Dust on less than a sixth of a facet is still found.
const LEAST_SPREAD: f64 = 0.5;
/// Deviations below this fraction of the light may be real, where there is no noise: light is not quite a
/// plane.
const OWN: f64 = 0.005;
/// Each round uncovers what a larger outlier hid; dust takes two or three.
const ROUNDS: usize = 10;

/// Sums over the runs near the plane fitted to them in all channels, and which these are.
pub(super) fn without_outliers(placed: &[Placed], channels: usize) -> (PixelSums, Vec<bool>) {
    let mut kept = vec![true; placed.len()];
    let mut sums = sum(placed, &kept);
    for _ in 0..ROUNDS {
        let near = near_plane(placed, &kept, &sums, channels);
        if near == kept {
            break;
        }
        kept = near;
        sums = sum(placed, &kept);
    }
    (sums, kept)
}

fn sum(placed: &[Placed], kept: &[bool]) -> PixelSums {
    let mut sums = PixelSums::default();
    for (run, _) in placed.iter().zip(kept).filter(|(_, kept)| **kept) {
        sums.add(run.weight, run.u, run.v, &run.run);
    }
    sums
}

/// Which runs lie within reach of the plane of `sums`, in every channel.
fn near_plane(placed: &[Placed], kept: &[bool], sums: &PixelSums, channels: usize) -> Vec<bool> {
    if placed.len() < FEW {
        return kept.to_vec();
    }
    let reach = |channel| {
        let estimate = sums.estimate(channel)?;
        let usual = placed.iter().zip(kept).filter(|(_, kept)| **kept);
        let usual = usual.map(|(placed, _)| placed.deviation(channel, &estimate));
        let spread = spread(usual.step_by(placed.len().div_ceil(SPREAD_RUNS) | 1).collect());
        Some((channel, estimate, (REACH * spread).max(OWN * estimate.mean.abs())))
    };
    let reaches: Vec<(usize, Estimate, f64)> = (0..channels).filter_map(reach).collect();
    let is_near = |placed: &Placed| {
        reaches.iter().all(|(channel, estimate, reach)| placed.deviation(*channel, estimate).abs() <= *reach)
    };
    placed.iter().map(is_near).collect()
}

impl Placed {
    /// Deviation of the run from a plane, scaled to that of single pixels: their mean has less noise.
    #[inline]
    fn deviation(&self, channel: usize, plane: &Estimate) -> f64 {
        (self.run.mean(channel) - plane.plane(self.u, self.v)) * self.run.pixels().sqrt()
    }
}

/// The standard deviation of normally distributed numbers contaminated by some others.
fn spread(mut deviations: Vec<f64>) -> f64 {
    let count = deviations.len();
    if count == 0 {
        return f64::INFINITY;
    }
    let rms = (deviations.iter().map(|deviation| deviation * deviation).sum::<f64>() / count as f64).sqrt();
    deviations.iter_mut().for_each(|deviation| *deviation = deviation.abs());
    let (_, three_quarters, _) = deviations.select_nth_unstable_by(count * 3 / 4, f64::total_cmp);
    (*three_quarters / THREE_QUARTERS).max(LEAST_SPREAD * rms)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    /// A facet of `side` x `side` pixels with light 100 + 20 u - 10 v and noise of 1, except at `speck`.
    fn facet(side: usize, seed: u64, speck: impl Fn(usize, usize) -> Option<f64>) -> Vec<Placed> {
        let mut noise = ChaCha8Rng::seed_from_u64(seed);
        let place = |k: usize| (k as f64 + 0.5) / side as f64 - 0.5;
        (0..side * side)
            .map(|k| {
                let (x, y) = (k % side, k / side);
                let (u, v) = (place(x), place(y));
                let sample: f64 = StandardNormal.sample(&mut noise);
                let light = speck(x, y).unwrap_or(100.0 + 20.0 * u - 10.0 * v + sample);
                let mut run = Run::default();
                run.add(x, [light; 3]);
                Placed { weight: 1.0, u, v, run }
            })
            .collect()
    }

    fn mean(placed: &[Placed]) -> f64 {
        without_outliers(placed, 3).0.estimate(0).unwrap().mean
    }

    /// Root mean square error of the mean of facets of `side` x `side` pixels, in plain standard errors.
    fn error(side: usize, facets: u64, speck: impl Fn(usize, usize) -> Option<f64>) -> f64 {
        let square = |seed| ((mean(&facet(side, seed, &speck)) - 100.0) * side as f64).powi(2);
        ((0..facets).map(square).sum::<f64>() / facets as f64).sqrt()
    }

    #[test]
    fn clean_noise_is_kept() {
        for (side, facets) in [(3, 2000), (5, 2000), (20, 500)] {
            let plain = |seed| {
                let placed = facet(side, seed, |_, _| None);
                let kept = vec![true; placed.len()];
                ((sum(&placed, &kept).estimate(0).unwrap().mean - 100.0) * side as f64).powi(2)
            };
            let plain = ((0..facets).map(plain).sum::<f64>() / facets as f64).sqrt();
            let robust = error(side, facets, |_, _| None);
            assert!(robust < 1.005 * plain, "{side}: {robust} for {plain}");
        }
    }

    #[test]
    fn specks_and_a_hair_move_no_facet() {
        let corner = |x: usize, y: usize| (x < 4 && y < 4).then_some(30.0);
        let hair = |x: usize, y: usize| (x == y).then_some(60.0);
        let hot = |x: usize, y: usize| (x == 7 && y == 9).then_some(5000.0);
        let none = |_: usize, _: usize| None;
        let errors =
            [error(20, 200, none), error(20, 200, corner), error(20, 200, hair), error(20, 200, hot)];
        assert!(errors.iter().all(|error| *error < 1.15 * errors[0]), "{errors:?}");
    }

    /// Two adjacent numbers, as in a flat facet of an 8-bit picture.
    #[test]
    fn steps_of_a_stored_number_are_no_outliers() {
        let placed = facet(20, 0, |x, _| Some(if x % 5 == 0 { 101.0 } else { 100.0 }));
        assert!((mean(&placed) - 100.2).abs() < 1e-9);
    }
}
