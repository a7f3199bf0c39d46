//! A channel's numbers, some of them from all over the picture: enough to see where they begin and end.

use rayon::prelude::*;

use super::pixels::Pixels;

/// Numbers that are looked at: a plateau of a thousandth is 33 of them, and a large picture takes no longer.
const NUMBERS: usize = 1 << 15;
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
        // every so many rows, and of these every so many runs
        let step = ((width * height) as f64 / NUMBERS as f64).sqrt().ceil().max(1.0) as usize;
        let runs: Vec<_> = (0..height)
            .step_by(step)
            .flat_map(|y| (0..width).step_by(RUN_PX * step).map(move |x| (x..width.min(x + RUN_PX), y)))
            .collect();
        let sampled = |channel: usize| {
            Self::new(runs.iter().map(|(columns, y)| pixels.stored(channel, columns.clone(), *y)).collect())
        };
        (0..channels).into_par_iter().map(sampled).collect()
    }

    /// Of these runs.
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
