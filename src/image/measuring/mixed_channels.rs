//! Detects whether a matrix has mixed red, green and blue.
//!
//! Noise is independent in a sensor's channels, and positively correlated after some processing or from the
//! grain of a sheet. A matrix to sRGB subtracts other channels' light from each: where noise brightens one,
//! it darkens another.

use crate::image::photograph::{Layer, Photograph, Pixel};
use crate::image::placing::{Homography, Quadrilateral};

/// Length of a run of pixels whose noise is compared, how many runs of a panel suffice, and the fewest that
/// count.
const RUN_PX: usize = 26;
const ENOUGH: usize = 150;
const FEW: usize = 30;
/// Noise below this fraction of the light may be variation of the light itself.
const LEAST_NOISE: f64 = 1e-3;
/// A sensor's channels do not correlate below this: the correlation of 26 pixels' second differences has a
/// standard deviation of 0.25, the median of [`FEW`] of them 0.05.
const OPPOSITE: f64 = -0.15;
/// Sum of squared weights of a second difference.
const SQUARES: f64 = 6.0;

/// Whether the noise of two channels is anticorrelated within the panels of a photograph, because a matrix,
/// such as one from a camera's colours to sRGB, has mixed them. False if undetermined.
pub(super) fn are_channels_mixed(photograph: &Photograph, panels: &[Homography]) -> bool {
    let mut layers = photograph.layers();
    let (Some(layer), None) = (layers.next(), layers.next()) else { return false };
    if layer.channels() != 3 {
        return false;
    }
    let runs: Vec<[f64; 3]> = panels.iter().flat_map(|panel| runs(layer, panel)).collect();
    let pairs = (0..3).map(|pair| runs.iter().map(|run| run[pair]).collect::<Vec<f64>>());
    runs.len() >= FEW && pairs.map(median).any(|correlation| correlation < OPPOSITE)
}

fn median(mut all: Vec<f64>) -> f64 {
    let middle = all.len() / 2;
    *all.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Correlations of red with green, red with blue and green with blue in enough runs of pixels, spread over a
/// panel.
fn runs(layer: Layer, panel: &Homography) -> Vec<[f64; 3]> {
    let (width, height) = layer.size();
    let outline = Quadrilateral::new(panel.corners());
    let in_row = |y: usize| {
        let whole = outline.whole_columns(y, width);
        (0..whole.len() / RUN_PX).map(move |run| (whole.start + run * RUN_PX, y))
    };
    let places: Vec<_> = outline.rows(height).flat_map(in_row).collect();
    // evenly spaced runs come first; those between follow where many are unusable
    let step = places.len().div_ceil(ENOUGH).max(1);
    let in_turn = (0..step).flat_map(|first| places.iter().skip(first).step_by(step));
    in_turn.filter_map(|(x, y)| correlations(layer, *x, *y)).take(ENOUGH).collect()
}

/// Those of the run that begins at (x, y); none if a pixel is unusable or noise is too low.
fn correlations(layer: Layer, x: usize, y: usize) -> Option<[f64; 3]> {
    let mut light = Vec::with_capacity(RUN_PX);
    layer.visit(x..x + RUN_PX, y, |_, pixel| {
        if let Pixel::Light(one) = pixel {
            light.push(one);
        }
    });
    if light.len() < RUN_PX {
        return None;
    }
    let second = |three: &[[f64; 3]]| [0, 1, 2].map(|k| three[0][k] - 2.0 * three[1][k] + three[2][k]);
    let differences: Vec<[f64; 3]> = light.windows(3).map(second).collect();
    let count = differences.len() as f64;
    let mean = |all: &[[f64; 3]], k: usize| all.iter().map(|one| one[k]).sum::<f64>() / all.len() as f64;
    let means = [0, 1, 2].map(|k| mean(&differences, k));
    let covariance = |a: usize, b: usize| {
        differences.iter().map(|one| (one[a] - means[a]) * (one[b] - means[b])).sum::<f64>() / count
    };
    let shows = |k: usize| (covariance(k, k) / SQUARES).sqrt() > LEAST_NOISE * mean(&light, k).abs();
    let correlation =
        |(a, b): (usize, usize)| covariance(a, b) / (covariance(a, a) * covariance(b, b)).sqrt();
    (0..3).all(shows).then(|| [(0, 1), (0, 2), (1, 2)].map(correlation))
}
