//! The pixels of one facet, and its measurement from them.

use super::measurement::{FacetMeasurement, PixelRun};
use super::outliers::{Placed, without_outliers};
use super::plane_fit::Estimate;
use crate::image::photograph::Pixel;

/// Largest clipped fraction of a facet's pixels: the others are those that noise left below the level. A
/// tenth shifts the mean by 0.2 of a pixel's standard deviation, a half by 0.8, many times the mean's own.
/// Hot pixels are fewer; a single one does not invalidate a small facet.
const MOST_CLIPPED: f64 = 0.02;

/// Pixels, collected one run at a time.
#[derive(Default)]
pub(super) struct Tally {
    placed: Vec<Placed>,
    /// For each of `placed`, the fraction of its pixels in the facet, and their positions.
    runs: Vec<(f64, PixelRun)>,
    clipped: usize,
    not_finite: usize,
    left_out: Vec<PixelRun>,
}

impl Tally {
    /// Adds a run of pixels; the fraction `overlap` of each is in the facet.
    pub fn add(&mut self, placed: Placed, overlap: f64, pixels: PixelRun) {
        self.placed.push(placed);
        self.runs.push((overlap, pixels));
    }

    /// Counts a pixel without light; most pictures have few.
    #[cold]
    pub fn leave_out(&mut self, pixel: Pixel, x: usize, y: usize) {
        match pixel {
            Pixel::Clipped => self.clipped += 1,
            _ => self.not_finite += 1,
        }
        match self.left_out.last_mut() {
            Some(run) if run.row == y && run.columns.end == x => run.columns.end += 1,
            _ => self.left_out.push(PixelRun { columns: x..x + 1, row: y }),
        }
    }

    /// The facet's measurement.
    pub fn finish(mut self, channels: usize) -> FacetMeasurement {
        let (sums, kept) = without_outliers(&self.placed, channels);
        let (mut pixels, mut outliers) = (0.0, 0);
        for ((placed, (overlap, run)), kept) in self.placed.iter().zip(self.runs).zip(kept) {
            if kept {
                pixels += overlap * placed.run.pixels();
            } else {
                outliers += placed.run.pixels() as usize;
                self.left_out.push(run);
            }
        }
        let clipped = self.clipped as f64;
        let tells = clipped <= (MOST_CLIPPED * (clipped + pixels)).max(1.0);
        let estimates: Option<Vec<Estimate>> = (0..channels).map(|channel| sums.estimate(channel)).collect();
        let each = estimates.as_ref().filter(|_| tells);
        FacetMeasurement {
            mean: each.map(|each| each.iter().map(|estimate| estimate.mean).collect()),
            standard_error: each
                .and_then(|each| each.iter().map(|estimate| estimate.standard_error).collect()),
            pixels,
            clipped: self.clipped,
            not_finite: self.not_finite,
            outliers,
            left_out: self.left_out,
        }
    }
}
