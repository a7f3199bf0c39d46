//! Whether a matrix has mixed red, green and blue.
//!
//! The noise of a sensor's channels is independent, and what programs make of it, or the grain of a sheet,
//! goes the same way in all. A matrix to sRGB takes each channel's light from the others: where noise makes
//! one brighter, it makes another darker.

use crate::image::photograph::{Layer, Photograph, Pixel};
use crate::image::placing::{Homography, Quadrilateral};

/// Pixels side by side whose noise is compared, and how many such runs of a panel are enough; fewer than some
/// tell nothing.
const RUN_PX: usize = 26;
const ENOUGH: usize = 150;
const FEW: usize = 30;
/// Noise below this part of the light may be the light's own changes.
const LEAST_NOISE: f64 = 1e-3;
/// A correlation below this is none of a sensor's channels: one of 26 pixels' second differences scatters by
/// about 0.25, the median of [`FEW`] of them by 0.05.
const OPPOSITE: f64 = -0.15;
/// The square sum of the weights of a second difference.
const SQUARES: f64 = 6.0;

/// Whether the noise of two channels goes opposite ways within the panels of a photograph: a matrix has mixed
/// them, such as one from a camera's colours to sRGB. Where that cannot be determined it is false.
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

/// Correlations of red with green, red with blue and green with blue in as many runs of pixels all over a
/// panel as are enough.
fn runs(layer: Layer, panel: &Homography) -> Vec<[f64; 3]> {
    let (width, height) = layer.size();
    let outline = Quadrilateral::new(panel.corners());
    let in_row = |y: usize| {
        let whole = outline.whole_columns(y, width);
        (0..whole.len() / RUN_PX).map(move |run| (whole.start + run * RUN_PX, y))
    };
    let places: Vec<_> = outline.rows(height).flat_map(in_row).collect();
    // every so many first: where many cannot be used, those between follow
    let step = places.len().div_ceil(ENOUGH).max(1);
    let in_turn = (0..step).flat_map(|first| places.iter().skip(first).step_by(step));
    in_turn.filter_map(|(x, y)| correlations(layer, *x, *y)).take(ENOUGH).collect()
}

/// Those of the run that begins at (x, y); none if a pixel is not usable or noise does not show.
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
