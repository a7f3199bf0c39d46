//! How much noise neighbouring pixels share.
//!
//! Interpolating a sensor's mosaic, scaling and JPEG spread the noise of one pixel over several: the mean of
//! n of them is less certain than σ/√n. How many pixels make one independent number is measured in the
//! picture itself, by comparing the variance of means over blocks of pixels with that of the pixels.
//!
//! The light itself varies too, and smoothly. Nine blocks with the weights (1, -2, 1) along both directions
//! cancel it: every sum of a function of x and one of y, and the product of two linear ones.

use ndarray::Array2;
use rayon::prelude::*;

use crate::image::photograph::{Photograph, Pixel};
use crate::image::placing::{Homography, Quadrilateral};

/// Width and height of a block, px: wider than what JPEG and demosaicing spread. In small panels it is less.
const BLOCK_PX: usize = 12;
/// Smaller blocks hold no more than the noise shared.
const SMALLEST_BLOCK_PX: usize = 4;
/// Blocks of a contrast stand two block widths apart, so that they share no noise.
const SPACING: usize = 2;
/// Width and height of a contrast's nine blocks, block widths.
const SPAN: usize = 2 * SPACING + 1;
/// The weights of the blocks in each direction; those of all nine have the square sum 36.
const WEIGHTS: [f64; 3] = [1.0, -2.0, 1.0];
/// Contrasts that are looked at in a panel: their median is certain to 6 %.
const CONTRASTS: usize = 500;
/// Fewer contrasts say nothing.
const FEW: usize = 30;
/// Median of the χ² distribution with one degree of freedom, whose mean is 1.
const CHI_SQUARE_MEDIAN: f64 = 0.454_936;

/// How many pixels make one independent number, per channel: 1 where every pixel's noise is its own.
///
/// It is the sum of the noise's correlation over all distances, px². Standard errors that take every pixel's
/// noise for its own are too small by its square root. 1 for a mosaic, whose pixels are the sensor's own, and
/// where a panel is too small to tell (less than 40 px wide or high). What moves all pixels alike, as
/// rounding does in a JPEG, is not seen: see [`measure_panels`](super::measure_panels).
///
/// # Example
/// ```
/// use vfold::image::{Mosaic, Photograph, pixels_sharing_noise};
/// let light = vec![0.5; 9];
/// let photograph = Photograph::from_mosaic(Mosaic::new("RGGB").unwrap(), 3, 3, light)?;
/// assert_eq!(pixels_sharing_noise(&photograph, &[]), [1.0; 3]);
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn pixels_sharing_noise(photograph: &Photograph, panels: &[Homography]) -> Vec<f64> {
    let channels = photograph.channels();
    if photograph.layers().count() > 1 {
        return vec![1.0; channels];
    }
    let block = panels.iter().map(|panel| block_px(photograph, panel)).min().unwrap_or(0);
    let ratios: Vec<[f64; 3]> = panels
        .iter()
        .flat_map(|panel| contrasts(photograph, panel, block))
        .collect::<Vec<_>>()
        .into_par_iter()
        .filter_map(|contrast| contrast.ratio(photograph))
        .collect();
    (0..channels).map(|channel| shared(ratios.iter().map(|ratio| ratio[channel]).collect(), block)).collect()
}

/// Pixels an independent number, from the contrasts' ratios of block variance to pixel variance.
fn shared(mut ratios: Vec<f64>, block: usize) -> f64 {
    if ratios.len() < FEW {
        return 1.0;
    }
    let middle = ratios.len() / 2;
    let (_, median, _) = ratios.select_nth_unstable_by(middle, f64::total_cmp);
    let in_block = (*median / CHI_SQUARE_MEDIAN).max(1.0);
    // at a block's edges a part is missing: this one if noise is averaged over squares, `width` px wide
    let width = in_block.sqrt();
    in_block / (1.0 - (width - width.recip()) / (3 * block) as f64).powi(2)
}

/// Nine blocks of pixels, from the top left one's corner on.
#[derive(Clone, Copy)]
struct Contrast {
    x: usize,
    y: usize,
    block: usize,
}

/// Width of a panel's blocks, so that two contrasts find room side by side.
fn block_px(photograph: &Photograph, panel: &Homography) -> usize {
    let outline = Quadrilateral::new(panel.corners());
    let (rows, columns) = (outline.rows(photograph.height()), outline.columns(photograph.width()));
    (rows.len().min(columns.len()) / (2 * SPAN)).min(BLOCK_PX)
}

/// The contrasts of blocks this wide that lie in a panel, evenly spread; none of blocks that are too small.
fn contrasts(photograph: &Photograph, panel: &Homography, block: usize) -> Vec<Contrast> {
    let (width, height) = (photograph.width(), photograph.height());
    let outline = Quadrilateral::new(panel.corners());
    let (rows, columns) = (outline.rows(height), outline.columns(width));
    if block < SMALLEST_BLOCK_PX {
        return Vec::new();
    }
    let span = SPAN * block;
    let step = ((rows.len() * columns.len() / CONTRASTS).isqrt()).max(block / 2);
    let in_row = |y: usize| {
        let (top, bottom) = (outline.whole_columns(y, width), outline.whole_columns(y + span - 1, width));
        let (first, end) = (top.start.max(bottom.start), top.end.min(bottom.end));
        (first..end.saturating_sub(span - 1)).step_by(step).map(move |x| Contrast { x, y, block })
    };
    (rows.start..rows.end.saturating_sub(span - 1)).step_by(step).flat_map(in_row).collect()
}

impl Contrast {
    /// The square of the contrast of the blocks' sums over the sum of the squared contrasts of their pixels;
    /// none if a pixel is not usable or there is no noise.
    fn ratio(self, photograph: &Photograph) -> Option<[f64; 3]> {
        let mut contrasts = Array2::from_elem((self.block, self.block), [0.0; 3]);
        for (y_weight, row) in WEIGHTS.iter().zip(0..) {
            for (x_weight, column) in WEIGHTS.iter().zip(0..) {
                let (x, y) = (self.x + column * SPACING * self.block, self.y + row * SPACING * self.block);
                self.add_block(photograph, (x, y), x_weight * y_weight, &mut contrasts)?;
            }
        }
        let ratio = |channel: usize| {
            let sum: f64 = contrasts.iter().map(|contrast| contrast[channel]).sum();
            let squares: f64 = contrasts.iter().map(|contrast| contrast[channel].powi(2)).sum();
            sum * sum / squares
        };
        let ratios = [0, 1, 2].map(ratio);
        ratios.iter().all(|ratio| ratio.is_finite()).then_some(ratios)
    }

    /// Adds the weighted light of a block's pixels to each pixel's contrast; none if one is not usable.
    fn add_block(
        self,
        photograph: &Photograph,
        (x, y): (usize, usize),
        weight: f64,
        contrasts: &mut Array2<[f64; 3]>,
    ) -> Option<()> {
        let layer = photograph.layers().next()?;
        let mut usable = true;
        for (row, mut contrasts) in contrasts.outer_iter_mut().enumerate() {
            layer.visit(x..x + self.block, y + row, |column, pixel| match pixel {
                Pixel::Light(light) => {
                    let contrast = &mut contrasts[column - x];
                    *contrast = [0, 1, 2].map(|channel| contrast[channel] + weight * light[channel]);
                }
                _ => usable = false,
            });
        }
        usable.then_some(())
    }
}
