//! A sample of a channel's numbers from all over the picture, sufficient to determine their range.

use std::ops::Range;

use rayon::prelude::*;

use super::pixels::Pixels;

/// Size of the sample: a plateau of a thousandth has 16 of them, and a large picture takes no longer.
const NUMBERS: usize = 1 << 14;
/// Length of a run of adjacent pixels.
const RUN_PX: usize = 64;

/// A sample of the numbers of one channel.
pub(super) struct Sampled {
    /// In runs of adjacent ones, from all over the picture.
    pub runs: Vec<Vec<f32>>,
    /// In ascending order.
    pub sorted: Vec<f32>,
}

impl Sampled {
    /// Samples of each channel of a picture of this width and height.
    pub fn of(pixels: &Pixels, channels: usize, (width, height): (usize, usize)) -> Vec<Self> {
        let runs: Vec<_> = runs((width, height)).collect();
        let sampled = |channel: usize| {
            Self::new(runs.iter().map(|(columns, y)| pixels.stored(channel, columns.clone(), *y)).collect())
        };
        (0..channels).into_par_iter().map(sampled).collect()
    }

    /// From these runs of numbers.
    pub fn new(runs: Vec<Vec<f32>>) -> Self {
        let mut sorted: Vec<f32> = runs.iter().flatten().copied().collect();
        sorted.sort_unstable_by(f32::total_cmp);
        Self { runs, sorted }
    }

    /// The quantile at `part`, 0 to 1; none if there are no numbers.
    pub fn quantile(&self, part: f64) -> Option<f32> {
        let last = self.sorted.len().checked_sub(1)?;
        Some(self.sorted[(part * last as f64).round() as usize])
    }

    /// Each different number with its count, in descending order.
    pub fn counts(&self) -> Vec<(f32, usize)> {
        let equal = self.sorted.chunk_by(|a, b| a.total_cmp(b).is_eq());
        equal.rev().map(|equal| (equal[0], equal.len())).collect()
    }
}

/// Columns and row of the sampled runs of a picture: evenly spaced rows, and runs evenly spaced within them,
/// staggered from row to row.
fn runs((width, height): (usize, usize)) -> impl Iterator<Item = (Range<usize>, usize)> {
    let in_row = width.div_ceil(RUN_PX).max(1);
    let one_of = width * height / NUMBERS;
    let across = one_of.isqrt().clamp(1, in_row);
    let down = one_of.div_ceil(across).max(1);
    (0..height).step_by(down).enumerate().flat_map(move |(n, y)| {
        let places = (n % across..in_row).step_by(across);
        places.map(move |run| (run * RUN_PX..width.min((run + 1) * RUN_PX), y))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_from_all_over_the_picture() {
        for (width, height) in [(6000, 4000), (480, 360), (4000, 60), (60, 4000), (50, 1)] {
            let all: Vec<_> = runs((width, height)).collect();
            let met = |x: usize| all.iter().any(|(columns, _)| columns.contains(&x));
            let bands = (0..width).step_by(RUN_PX).filter(|x| met(*x)).count();
            let rows = all.iter().map(|(_, y)| *y).collect::<std::collections::BTreeSet<_>>().len();
            // a picture of few rows has fewer of them than bands
            assert!(bands >= rows.min(width.div_ceil(RUN_PX)), "{width} x {height}: {bands} bands");
            let count: usize = all.iter().map(|(columns, _)| columns.len()).sum();
            assert!(count > 0 && count < 2 * NUMBERS, "{width} x {height}: {count} numbers");
        }
    }
}
