//! A channel's numbers, some of them from all over the picture: enough to see where they begin and end.

use std::ops::Range;

use rayon::prelude::*;

use super::pixels::Pixels;

/// Numbers that are looked at: a plateau of a thousandth is 16 of them, and a large picture takes no longer.
const NUMBERS: usize = 1 << 14;
/// Pixels beside each other.
const RUN_PX: usize = 64;

/// Some numbers of one channel.
pub(super) struct Sampled {
    /// As they stand beside each other, from all over the picture.
    pub runs: Vec<Vec<f32>>,
    /// From the least to the greatest.
    pub sorted: Vec<f32>,
}

impl Sampled {
    /// Those of each of a picture's channels, which are so many and of that width and height.
    pub fn of(pixels: &Pixels, channels: usize, (width, height): (usize, usize)) -> Vec<Self> {
        let runs: Vec<_> = runs((width, height)).collect();
        let sampled = |channel: usize| {
            Self::new(runs.iter().map(|(columns, y)| pixels.stored(channel, columns.clone(), *y)).collect())
        };
        (0..channels).into_par_iter().map(sampled).collect()
    }

    /// Of these runs of numbers.
    pub fn new(runs: Vec<Vec<f32>>) -> Self {
        let mut sorted: Vec<f32> = runs.iter().flatten().copied().collect();
        sorted.sort_unstable_by(f32::total_cmp);
        Self { runs, sorted }
    }

    /// The number that a part of them, 0 to 1, lies below; none if there are none.
    pub fn quantile(&self, part: f64) -> Option<f32> {
        let last = self.sorted.len().checked_sub(1)?;
        Some(self.sorted[(part * last as f64).round() as usize])
    }

    /// Each different number and how many there are of it, from the greatest down.
    pub fn counts(&self) -> Vec<(f32, usize)> {
        let equal = self.sorted.chunk_by(|a, b| a.total_cmp(b).is_eq());
        equal.rev().map(|equal| (equal[0], equal.len())).collect()
    }
}

/// Columns and row of the runs of a picture that are looked at: every so many rows, and of these every so
/// many runs, in each row others than in the one before.
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
            // a picture of few rows has not as many as bands
            assert!(bands >= rows.min(width.div_ceil(RUN_PX)), "{width} x {height}: {bands} bands");
            let count: usize = all.iter().map(|(columns, _)| columns.len()).sum();
            assert!(count > 0 && count < 2 * NUMBERS, "{width} x {height}: {count} numbers");
        }
    }
}
