//! The level of no light, if it was not subtracted: the darkest numbers of the whole picture, which are then
//! equal in all channels.
//!
//! In the absence of light a sensor's numbers scatter around one level, the same for red, green and blue.
//! Even weak light has a colour: in the camera's own numbers a grey surface has two to three times as much
//! green as red.

use super::sampled::Sampled;

/// Quantiles certainly among the darkest numbers; their difference measures the scatter.
const LEAST: [f64; 2] = [1e-3, 1e-2];
/// Least fraction of the pixels in the densest histogram step, whose width is that of the scatter.
const DENSE: f64 = 3e-3;
/// Steps of the histogram.
const MOST_STEPS: usize = 400;
/// Range above a peak, steps, and largest fraction of its pixels to which they must fall there.
const BEYOND: usize = 6;
const FEWER: f64 = 0.6;
/// Largest difference between channels, relative to the level and to the scatter.
const ALIKE: f64 = 0.05;
const ALIKE_SCATTER: f64 = 0.3;
/// Limits of the level relative to the brightest numbers: below the first it is harmless, above the second it
/// is not dark.
const HARMLESS: f64 = 3e-3;
const DARK: f64 = 0.25;
/// Quantile taken as the brightest.
const BRIGHTEST: f64 = 0.99;
/// Fraction of normally distributed numbers within one standard deviation.
const ONE_SD: f64 = 0.683;
/// Range of a peak's numbers around its middle, standard deviations, and iterations to find the middle.
const REACH: f64 = 2.0;
const ROUNDS: usize = 4;

/// The number for no light in each of several channels, above the assumed `black`; none if there is no sign
/// of it.
pub(super) fn darkest(channels: &[Sampled], black: &[f64]) -> Option<Vec<f64>> {
    let peaks: Vec<Peak> = channels.iter().map(peak).collect::<Option<_>>()?;
    let brightest = channels
        .iter()
        .zip(black)
        .filter_map(|(all, black)| Some(f64::from(all.quantile(BRIGHTEST)?) - black));
    let brightest = brightest.fold(0.0, f64::max);
    let above: Vec<f64> = peaks.iter().zip(black).map(|(peak, black)| peak.middle - black).collect();
    let least = above.iter().copied().fold(f64::INFINITY, f64::min);
    let most = above.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let scatter = peaks.iter().map(|peak| peak.sd).fold(0.0, f64::max);
    let is_level = channels.len() > 1
        && least > HARMLESS * brightest
        && most < DARK * brightest
        && most - least <= ALIKE * least + ALIKE_SCATTER * scatter;
    is_level.then(|| peaks.into_iter().map(|peak| peak.middle).collect())
}

/// Numbers that scatter around a middle.
struct Peak {
    middle: f64,
    sd: f64,
}

/// The lowest peak of a channel's numbers.
fn peak(channel: &Sampled) -> Option<Peak> {
    let [first, second] = LEAST.map(|part| channel.quantile(part).map(f64::from));
    let (first, second) = (first?, second?);
    if first.total_cmp(&second).is_eq() {
        return Some(Peak { middle: first, sd: 0.0 });
    }
    let width = (second - first) / 1.5;
    let start = first - 2.0 * width;
    let mut steps = [0.0; MOST_STEPS];
    let step_of = |number: f32| ((f64::from(number) - start) / width).max(0.0) as usize;
    channel
        .sorted
        .iter()
        .map(|number| step_of(*number))
        .take_while(|step| *step < MOST_STEPS)
        .for_each(|step| steps[step] += 1.0);
    let smooth: Vec<f64> = steps.windows(3).map(|three| three.iter().sum::<f64>() / 3.0).collect();
    let dense = DENSE * channel.sorted.len() as f64;
    let is_peak = |at: &usize| {
        let beyond = smooth[at + 1..].iter().take(BEYOND).copied().fold(f64::INFINITY, f64::min);
        let before = at.checked_sub(1).map_or(0.0, |before| smooth[before]);
        smooth[*at] >= dense
            && smooth[*at] >= before
            && smooth[*at] >= smooth[at + 1]
            && beyond < FEWER * smooth[*at]
    };
    let at = (0..smooth.len() - 1).find(is_peak)?;
    let mut peak = Peak { middle: start + (at as f64 + 1.5) * width, sd: width };
    for _ in 0..ROUNDS {
        peak = peak.nearer(&channel.sorted)?;
    }
    Some(peak)
}

impl Peak {
    /// The same, recomputed from the numbers around it.
    fn nearer(&self, sorted: &[f32]) -> Option<Self> {
        let below = |number: f64| sorted.partition_point(|one| f64::from(*one) < number);
        let (from, to) = (below(self.middle - REACH * self.sd), below(self.middle + REACH * self.sd));
        let middle = f64::from(*sorted.get(from + to.checked_sub(from)? / 2)?);
        // numbers above the middle may contain some light
        let darker = below(middle);
        let sd = middle - f64::from(*sorted.get((darker as f64 * (1.0 - ONE_SD)) as usize)?);
        Some(Self { middle, sd: if sd > 0.0 { sd } else { self.sd } })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    /// A third of the pixels at each of these levels, with noise of 20, and the others far brighter.
    fn channels(levels: [f64; 3]) -> Vec<Sampled> {
        let mut draws = ChaCha8Rng::seed_from_u64(7);
        let mut channel = |level: f64| {
            let mut number = |k: usize| {
                let noise: f64 = StandardNormal.sample(&mut draws);
                let light = if k.is_multiple_of(3) { 0.0 } else { 10_000.0 + k as f64 };
                (level + light + 20.0 * noise).max(0.0).round() as f32
            };
            Sampled::new(vec![(0..9000).map(&mut number).collect()])
        };
        levels.map(&mut channel).into()
    }

    #[test]
    fn darkness_that_is_alike_in_all_channels_is_black() {
        let found = darkest(&channels([512.0, 511.0, 514.0]), &[0.0; 3]).unwrap();
        assert!(
            found.iter().zip([512.0, 511.0, 514.0]).all(|(found, level)| (found - level).abs() < 2.0),
            "{found:?}"
        );
        assert_eq!(darkest(&channels([512.0, 512.0, 512.0]), &[512.0; 3]), None);
        assert_eq!(darkest(&channels([0.0, 0.0, 0.0]), &[0.0; 3]), None);
        assert_eq!(darkest(&channels([512.0, 800.0, 600.0]), &[0.0; 3]), None);
        assert_eq!(darkest(&channels([9000.0, 9000.0, 9000.0]), &[0.0; 3]), None, "nothing is dark");
    }
}
