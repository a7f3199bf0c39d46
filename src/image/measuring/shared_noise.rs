//! Noise shared by neighbouring pixels.
//!
//! Demosaicing, scaling and JPEG spread the noise of one pixel over several, so the mean of n of them is less
//! certain than σ/√n. The number of pixels per independent number is measured in the picture itself: the
//! variance of means over blocks of pixels is compared with that of the pixels.
//!
//! The light itself also varies, but smoothly. Nine blocks with the weights (1, -2, 1) in both directions
//! cancel every sum of a function of x and one of y, and the product of two linear ones.

use ndarray::Array2;
use rayon::prelude::*;

use crate::image::photograph::{Photograph, Pixel};
use crate::image::placing::{Homography, Quadrilateral};

/// Width and height of a block, px: wider than the spread of JPEG and demosaicing; less in small panels.
const BLOCK_PX: usize = 12;
/// Smaller blocks do not contain all of the shared noise.
const SMALLEST_BLOCK_PX: usize = 4;
/// Distance between the blocks of a contrast, block widths, so that they share no noise.
const SPACING: usize = 2;
/// Width and height of a contrast's nine blocks, block widths.
const SPAN: usize = 2 * SPACING + 1;
/// The weights of the blocks in each direction; the squares of all nine products sum to 36.
const WEIGHTS: [f64; 3] = [1.0, -2.0, 1.0];
/// Contrasts sampled per panel: their median is accurate to 6 %.
const CONTRASTS: usize = 500;
/// Fewest contrasts for a result.
const FEW: usize = 30;
/// Median of the χ² distribution with one degree of freedom, whose mean is 1.
const CHI_SQUARE_MEDIAN: f64 = 0.454_936;

/// Number of pixels per independent number, per channel: 1 if the noise of pixels is independent.
///
/// It is the sum of the noise's correlation over all distances, px². Standard errors that assume independent
/// noise are too small by its square root. It is 1 for a mosaic, whose pixels are the sensor's own, and where
/// a panel is too small to measure it (less than 40 px wide or high). Shifts common to all pixels, such as
/// rounding in a JPEG, are not detected: see [`measure_panels`](super::measure_panels).
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

/// Pixels per independent number, from the contrasts' ratios of block variance to pixel variance.
fn shared(mut ratios: Vec<f64>, block: usize) -> f64 {
    if ratios.len() < FEW {
        return 1.0;
    }
    let middle = ratios.len() / 2;
    let (_, median, _) = ratios.select_nth_unstable_by(middle, f64::total_cmp);
    let in_block = (*median / CHI_SQUARE_MEDIAN).max(1.0);
    // corrects for correlation cut off at a block's edges, as if noise were averaged over squares `width` px
    // wide
    let width = in_block.sqrt();
    in_block / (1.0 - (width - width.recip()) / (3 * block) as f64).powi(2)
}

/// Nine blocks of pixels, identified by the top left corner.
#[derive(Clone, Copy)]
struct Contrast {
    x: usize,
    y: usize,
    block: usize,
}

/// Width of a panel's blocks, such that two contrasts fit side by side.
fn block_px(photograph: &Photograph, panel: &Homography) -> usize {
    let outline = Quadrilateral::new(panel.corners());
    let (rows, columns) = (outline.rows(photograph.height()), outline.columns(photograph.width()));
    (rows.len().min(columns.len()) / (2 * SPAN)).min(BLOCK_PX)
}

/// The contrasts of blocks of this width inside a panel, evenly spaced; none if the blocks are too small.
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
    /// The squared contrast of the blocks' sums over the sum of the squared contrasts of their pixels; none
    /// if a pixel is unusable or there is no noise.
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

    /// Adds the weighted light of a block's pixels to each pixel's contrast; none if one is unusable.
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
                    let sums = contrasts[column - x].iter_mut();
                    sums.zip(light).for_each(|(sum, light)| *sum += weight * light);
                }
                _ => usable = false,
            });
        }
        usable.then_some(())
    }
}
