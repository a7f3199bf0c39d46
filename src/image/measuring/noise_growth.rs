//! Detects whether noise grows with brightness, as photon noise does.
//!
//! The variance of n photons is n: a sensor's variance is proportional to its numbers, constant where read
//! noise dominates, and proportional to their square where the sheet's grain does. It never falls. For
//! encoded numbers v = L^(1/γ) photon noise has a variance proportional to v^(2 - γ), which falls for γ =
//! 2.4, as in sRGB.

use super::measurement::FacetMeasurement;

/// Fewest facets, and pixels of a facet, that count.
const FACETS: usize = 40;
const PIXELS: f64 = 10.0;
/// Number of coefficients fitted to a facet's pixels.
const FITTED: f64 = 3.0;
/// Usable range of a pixel's standard deviation relative to its light: less may be variation of the light
/// itself, more contains read noise.
const TELLING: [f64; 2] = [1e-3, 0.05];
/// Least power of light to which a sensor's variance is proportional: over all channels, and usually within
/// each.
const NEVER: f64 = 0.0;
const SELDOM: f64 = 0.7;
/// Required significance of both, standard deviations: uniform noise, as in a dark picture dominated by read
/// noise, appears to fall once in 700 cases.
const SURE: f64 = 3.0;

/// Whether the noise of facets falls with brightness: their numbers are not a sensor's, but follow a curve
/// such as sRGB's.
///
/// `facets` have standard errors from [`measure`](super::measure), in three channels. False if undetermined.
pub(super) fn noise_falls(facets: &[FacetMeasurement]) -> bool {
    let channels: Option<Vec<Growth>> = (0..3).map(|channel| Growth::of(facets, channel)).collect();
    let Some(channels) = channels.filter(|channels| channels.iter().all(Growth::tells)) else { return false };
    let weight: f64 = channels.iter().map(|one| one.weight).sum();
    let within = channels.iter().map(|one| one.weight * one.power).sum::<f64>() / weight;
    // Green may have twice as many sites, or less noise after processing; red and blue are comparable.
    let (red, blue) = (&channels[0], &channels[2]);
    let (light, variance) = (blue.light - red.light, blue.variance - red.variance);
    let between_weight = light * light / (red.middle_weight.recip() + blue.middle_weight.recip());
    let between = if light == 0.0 { 0.0 } else { variance / light };
    let all_weight = weight + between_weight;
    let all = (weight * within + between_weight * between) / all_weight;
    all + SURE / all_weight.sqrt() < NEVER && within + SURE / weight.sqrt() < SELDOM
}

/// Growth of one channel's variance: the slope of log variance against log light.
struct Growth {
    /// The exponent, and its inverse variance.
    power: f64,
    weight: f64,
    /// Mean logarithms of light and variance, and the inverse variance of the latter.
    light: f64,
    variance: f64,
    middle_weight: f64,
    /// Standard deviation of a pixel relative to its light.
    part: f64,
}

impl Growth {
    /// Fitted to the facets in one channel.
    fn of(facets: &[FacetMeasurement], channel: usize) -> Option<Self> {
        let points: Vec<[f64; 3]> = facets.iter().filter_map(|facet| point(facet, channel)).collect();
        if points.len() < FACETS {
            return None;
        }
        let sum = |of: &dyn Fn(&[f64; 3]) -> f64| points.iter().map(of).sum::<f64>();
        let all = sum(&|[_, _, weight]| *weight);
        let light = sum(&|[x, _, weight]| weight * x) / all;
        let variance = sum(&|[_, y, weight]| weight * y) / all;
        let spread = sum(&|[x, _, weight]| weight * (x - light).powi(2));
        let power = sum(&|[x, y, weight]| weight * (x - light) * (y - variance)) / spread;
        let residual = |[x, y, weight]: &[f64; 3]| weight * (y - variance - power * (x - light)).powi(2);
        let excess = (sum(&residual) / (points.len() - 2) as f64).max(1.0);
        let part = (variance / 2.0 - light).exp();
        Some(Self { power, weight: spread / excess, light, variance, middle_weight: all / excess, part })
    }

    fn tells(&self) -> bool {
        self.power.is_finite() && (TELLING[0]..TELLING[1]).contains(&self.part)
    }
}

/// Logarithms of a facet's light and of the variance of its pixels, and the inverse variance of the latter.
fn point(facet: &FacetMeasurement, channel: usize) -> Option<[f64; 3]> {
    let (light, error) = (*facet.mean.as_ref()?.get(channel)?, *facet.standard_error.as_ref()?.get(channel)?);
    let variance = error * error * facet.pixels;
    (light > 0.0 && variance > 0.0 && facet.pixels >= PIXELS)
        .then(|| [light.ln(), variance.ln(), (facet.pixels - FITTED) / 2.0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    /// Facets of 60 pixels with a variance proportional to this power of the light.
    fn facets(power: f64, seed: u64) -> Vec<FacetMeasurement> {
        let mut draws = ChaCha8Rng::seed_from_u64(seed);
        let mut facet = |k: usize| {
            let mean: Vec<f64> = [0.3, 0.5, 0.35].map(|most| most * (0.6 + 0.4 * k as f64 / 200.0)).into();
            let mut error = |mean: &f64| {
                let draw: f64 = StandardNormal.sample(&mut draws);
                (1e-5 * mean.powf(power) * (1.0 + draw * (2.0_f64 / 57.0).sqrt()) / 60.0).sqrt()
            };
            let standard_error = Some(mean.iter().map(&mut error).collect());
            FacetMeasurement { mean: Some(mean), standard_error, pixels: 60.0, ..FacetMeasurement::unseen() }
        };
        (0..200).map(&mut facet).collect()
    }

    #[test]
    fn the_curve_of_srgb_shows_and_a_sensor_does_not() {
        let found = |power: f64| (0..50).filter(|seed| noise_falls(&facets(power, *seed))).count();
        assert!(found(-0.4) > 40, "{}", found(-0.4));
        assert!(found(0.0) < 5, "{}", found(0.0));
        for power in [0.5, 1.0, 2.0] {
            assert_eq!(found(power), 0, "{power}");
        }
    }
}
