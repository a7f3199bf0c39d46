//! Detects the level at which a channel's numbers end prematurely because a sensor or a program has clipped
//! them.
//!
//! There, more pixels than chance explains hold one number, and hardly any a greater one. A uniform colour
//! without noise, as in simulated pictures, looks similar, but then other numbers stand out as much, or the
//! light does not approach the level gradually and no pixel elsewhere has noise.

use super::sampled::Sampled;

/// Fewest equal numbers that are not chance.
const FEW: usize = 16;
/// Least fraction of all numbers that are equal.
const LEAST_PART: f64 = 1e-3;
/// Least ratio of the count of equal numbers to that of any adjacent number. Light with its maximum along a
/// line, stored in coarse steps, reaches 2.4.
const TIMES: usize = 4;
/// How many different numbers on either side count as adjacent.
const NEXT: usize = 4;
/// Least ratio of the count of equal numbers to that of greater ones.
const GREATER: usize = 10;
/// Scaling a picture overshoots at edges: if the count of equal numbers is this many times that of adjacent
/// ones, and the light approaches the level gradually,
const CLEARLY: usize = 20;
/// the greater ones may be this many times as frequent.
const OVERSHOT: usize = 2;
/// Another number that stands out with at least one over this of the count marks uniform colours.
const OTHER: usize = 4;
/// Numbers below this fraction of the level are surroundings.
const DARK: f32 = 0.1;
/// Where a level is approached gradually, at least this fraction of its boundary
const GRADUAL_PART: f64 = 0.25;
/// is within this fraction of the level,
const NEAR: f32 = 0.1;
/// and the boundary has at least this many px.
const BOUNDARY: usize = 8;

/// The number at which each channel ends; none for those that do not.
pub(super) fn ends(channels: &[Sampled]) -> Vec<Option<f32>> {
    let levels: Vec<Option<f32>> = channels.iter().map(level).collect();
    let is_reached =
        |(channel, level): (&Sampled, &Option<f32>)| level.is_some_and(|level| is_gradual(channel, level));
    let is_cut = channels.iter().zip(&levels).any(is_reached)
        || levels.iter().any(Option::is_some) && channels.iter().any(has_noise);
    levels.into_iter().map(|level| level.filter(|_| is_cut)).collect()
}

/// The number that stands out at the top.
fn level(channel: &Sampled) -> Option<f32> {
    let counts = channel.counts();
    let all = channel.sorted.len();
    let least = FEW.max((LEAST_PART * all as f64) as usize);
    let most_next = |at: usize| {
        let next = counts[at.saturating_sub(NEXT)..at].iter().chain(counts[at + 1..].iter().take(NEXT));
        let lit = next.filter(|(number, _)| *number > DARK * counts[at].0);
        lit.map(|(_, count)| *count).max().unwrap_or(0)
    };
    let stands_out = |at: usize| counts[at].1 >= TIMES * most_next(at);
    let mut greater = 0;
    for (at, &(level, count)) in counts.iter().enumerate() {
        if GREATER * greater > all {
            break;
        }
        let is_top = || {
            let is_clear = OVERSHOT * count >= greater && count >= CLEARLY * most_next(at);
            GREATER * greater <= count || is_clear && is_gradual(channel, level)
        };
        if count >= least && stands_out(at) && is_top() {
            let is_other = |other: usize| OTHER * counts[other].1 >= count && stands_out(other);
            let lit = counts[at + 1..].iter().take_while(|(number, _)| *number > DARK * level).count();
            return (!(at + 1..=at + lit).any(is_other) && level > 0.0).then_some(level);
        }
        greater += count;
    }
    None
}

/// Whether light approaches a level gradually.
fn is_gradual(channel: &Sampled, level: f32) -> bool {
    let pairs = channel.runs.iter().flat_map(|run| run.windows(2));
    let lower =
        pairs.filter(|pair| (pair[0] >= level) != (pair[1] >= level)).map(|pair| pair[0].min(pair[1]));
    let boundary: Vec<f32> = lower.collect();
    let near = boundary.iter().filter(|lower| **lower > (1.0 - NEAR) * level).count();
    boundary.len() >= BOUNDARY && near as f64 >= GRADUAL_PART * boundary.len() as f64
}

/// Relative second differences below this may be variation of the light itself.
const NOISE: f64 = 2e-3;
/// Second differences below this many steps between numbers may be rounding.
const STEPS: f64 = 2.5;
/// Adjacent second differences change sign in 73 % of cases if pixel noise is independent, rarely if light is
/// smooth.
const CHANGES: f64 = 0.4;
/// Fewest pixels for a result.
const FEW_PIXELS: usize = 200;

/// Whether neighbouring pixels differ by noise, and not only by gradients.
fn has_noise(channel: &Sampled) -> bool {
    let Some(greatest) = channel.sorted.last() else { return false };
    let is_lit = |run: &[f32]| run.iter().all(|number| *number > DARK * greatest && number < greatest);
    let fours = channel.runs.iter().flat_map(|run| run.windows(4)).filter(|run| is_lit(run));
    let (mut relative, mut absolute, mut changes) = (Vec::new(), Vec::new(), 0_usize);
    for run in fours {
        let [a, b, c, d] = [run[0], run[1], run[2], run[3]].map(f64::from);
        let (first, second) = (a - 2.0 * b + c, b - 2.0 * c + d);
        relative.push((first / b).abs());
        absolute.push(first.abs());
        changes += usize::from(first * second < 0.0);
    }
    let count = relative.len();
    let median = |mut all: Vec<f64>| *all.select_nth_unstable_by(count / 2, f64::total_cmp).1;
    count >= FEW_PIXELS
        && changes as f64 > CHANGES * count as f64
        && median(relative) > NOISE
        && median(absolute) > STEPS * step(channel)
}

/// The least difference between two numbers.
fn step(channel: &Sampled) -> f64 {
    let differences = channel.sorted.windows(2).map(|pair| f64::from(pair[1]) - f64::from(pair[0]));
    differences.filter(|difference| *difference > 0.0).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    /// A channel of 100 x 100 pixels with rounded numbers, as a function of position from -1 to 1.
    fn channel(mut number: impl FnMut(f64, f64) -> f64) -> Sampled {
        let place = |k: usize| (k as f64 + 0.5) / 50.0 - 1.0;
        let runs = (0..100).map(|y| (0..100).map(|x| number(place(x), place(y)).round() as f32).collect());
        Sampled::new(runs.collect())
    }

    #[test]
    fn light_that_is_cut_ends() {
        // brightest along a line, as in a fold
        let light = |x: f64, y: f64| 9000.0 * (1.0 - 0.8 * x.abs()) * (1.0 - 0.2 * y * y);
        assert_eq!(ends(&[channel(light), channel(|x, y| light(x, y).min(7000.0))]), [None, Some(7000.0)]);
        // in steps so coarse that a flat top has many equal numbers
        assert_eq!(ends(&[channel(|x, y| 200.0 * (1.0 - 0.3 * x * x - 0.1 * y * y))]), [None]);
    }

    #[test]
    fn noise_tells_an_end_from_an_even_colour() {
        let mut draws = ChaCha8Rng::seed_from_u64(1);
        let mut noise = || -> f64 { StandardNormal.sample(&mut draws) };
        // the sheet is entirely clipped and sharply bounded
        let sheet = |x: f64| if x.abs() < 0.5 { 4095.0 } else { 0.0 };
        let noisy = channel(|x, _| if x.abs() < 0.5 { 2000.0 + 20.0 * noise() } else { 0.0 });
        assert_eq!(ends(&[channel(|x, _| sheet(x)), noisy]), [Some(4095.0), None]);
        let smooth = channel(|x, y| if x.abs() < 0.5 { 2000.0 + 300.0 * x + 100.0 * y } else { 0.0 });
        assert_eq!(ends(&[channel(|x, _| sheet(x)), smooth]), [None, None]);
    }

    #[test]
    fn a_picture_of_even_colours_has_no_end() {
        let mut draws = ChaCha8Rng::seed_from_u64(1);
        let mut noise = || -> f64 { StandardNormal.sample(&mut draws) };
        let patches = channel(|x, y| match (x > 0.0, y > 0.0) {
            (true, true) => 4000.0,
            (true, false) => 3000.0,
            (false, true) => 2000.0,
            (false, false) => 1000.0 + 20.0 * noise(),
        });
        assert_eq!(ends(&[patches]), [None]);
    }
}
