//! The mean colour of every facet of a photographed sheet.
//!
//! A facet's value is the mean over the sheet's surface, which is what a form-factor model predicts: a pixel counts by
//! the panel area it shows. Pixels that straddle a panel's edge see something else as well and are left out; the mean
//! is then that of a plane fitted to the others, taken over the whole facet (see [`super::plane_fit`]).

use std::ops::Range;

use rayon::prelude::*;

use super::corners::{PANEL_CORNERS, check_inside};
use super::homography::{Homography, Point};
use super::photograph::{Layer, Photograph};
use super::pixel::Pixel;
use super::pixel_area::Quadrilateral;
use super::plane_fit::{Estimate, PixelSums, Run};
use crate::Result;

/// What a photograph says about one facet.
#[derive(Debug, Clone, PartialEq)]
pub struct FacetMeasurement {
    /// Mean linear light per channel, 1 at the white level; none if no pixel is usable.
    pub mean: Option<Vec<f64>>,
    /// Standard error of the mean per channel, from the spread about a plane; none if there are too few pixels to
    /// tell. It takes the noise of every pixel for its own: see [`FacetMeasurement::with_shared_noise`].
    pub standard_error: Option<Vec<f64>>,
    /// Usable pixels, of a mosaic those of all colours; a pixel shared among facets counts by the part of its area that
    /// lies in this one.
    pub pixels: f64,
    /// Pixels left out because a channel is clipped.
    pub clipped: usize,
    /// Pixels left out because a channel is not finite or the pixel is transparent.
    pub not_finite: usize,
}

impl FacetMeasurement {
    /// Of no channels and no pixels.
    const NOTHING: Self = Self {
        mean: Some(Vec::new()),
        standard_error: Some(Vec::new()),
        pixels: 0.0,
        clipped: 0,
        not_finite: 0,
    };

    /// The same with standard errors for noise that so many pixels share, per channel as
    /// [`pixels_sharing_noise`](super::pixels_sharing_noise) gives it.
    #[must_use]
    pub fn with_shared_noise(mut self, pixels: &[f64]) -> Self {
        for (error, pixels) in self.standard_error.iter_mut().flatten().zip(pixels) {
            *error *= pixels.sqrt();
        }
        self
    }

    /// Both measurements as one; a number that one of them lacks is none.
    fn with_channels(self, others: Self) -> Self {
        let joined = |own: Option<Vec<f64>>, others: Option<Vec<f64>>| Some([own?, others?].concat());
        Self {
            mean: joined(self.mean, others.mean),
            standard_error: joined(self.standard_error, others.standard_error),
            pixels: self.pixels + others.pixels,
            clipped: self.clipped + others.clipped,
            not_finite: self.not_finite + others.not_finite,
        }
    }
}

/// Measures every facet of one panel or more.
///
/// # Arguments
/// - `panels`: where each panel lies, by the order of [`PANEL_CORNERS`]; the crease is v = 0.
/// - `row_edges`: where facet rows begin and end, from 0 at the crease to 1 at the outer edge; `cols`: facets along it.
/// - `margin_px`: how far from a panel's edge a pixel must stay, at least 0; blur and corners that are a little off
///   ask for one or two.
///
/// # Returns
/// Facets by panel, then row (0 at the crease), then column (0 at crease end 0). The same for any number of threads.
///
/// # Errors
/// [`Error::Corners`](crate::Error::Corners) if a corner lies more than a pixel outside the picture.
///
/// # Example
/// ```
/// use vfold::image::{Homography, Photograph, Point, ReadOptions, measure, write_linear};
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("ramp.exr");
/// let ramp: Vec<f64> = (0..300).map(|k| (k / 3 % 10) as f64 / 16.0).collect(); // 10 x 10 px, brighter to the right
/// write_linear(&path, 10, 10, &ramp)?;
/// let panel = Homography::from_unit_square([(0., 0.), (10., 0.), (10., 10.), (0., 10.)].map(|(x, y)| Point::new(x, y)))?;
/// let facets = measure(&Photograph::open(&path, &ReadOptions::default())?, &[panel], &[0.0, 1.0], 2, 0.0)?;
/// let means: Vec<f64> = facets.iter().map(|facet| facet.mean.as_ref().unwrap()[0]).collect();
/// assert!((means[0] - 2.0 / 16.0).abs() < 1e-12 && (means[1] - 7.0 / 16.0).abs() < 1e-12);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn measure(
    photograph: &Photograph,
    panels: &[Homography],
    row_edges: &[f64],
    cols: usize,
    margin_px: f64,
) -> Result<Vec<FacetMeasurement>> {
    for (k, panel) in panels.iter().enumerate() {
        let (width, height) = (photograph.width(), photograph.height());
        check_inside(&format!("panel {k}"), panel.corners(), &PANEL_CORNERS, width, height)?;
    }
    let rows = row_edges.len() - 1;
    // one task a facet: each is summed in one order whatever the threads
    let facet = |k: usize| {
        let (panel, row, col) = (&panels[k / (rows * cols)], k / cols % rows, k % cols);
        let u = [col, col + 1].map(|edge| edge as f64 / cols as f64);
        Facet { panel, u, v: [row_edges[row], row_edges[row + 1]] }.measure(photograph, margin_px)
    };
    Ok((0..panels.len() * rows * cols).into_par_iter().map(facet).collect())
}

/// A rectangle of a panel: its ends along the crease and away from it.
struct Facet<'a> {
    panel: &'a Homography,
    u: [f64; 2],
    v: [f64; 2],
}

impl Facet<'_> {
    fn measure(&self, photograph: &Photograph, margin_px: f64) -> FacetMeasurement {
        let each = photograph.layers().map(|layer| self.tally(layer, margin_px).finish(layer.channels()));
        each.fold(FacetMeasurement::NOTHING, FacetMeasurement::with_channels)
    }

    /// Sums over the pixels of one layer of a photograph.
    fn tally(&self, layer: Layer, margin_px: f64) -> Tally {
        let mut tally = Tally::default();
        let panel = Quadrilateral::new(self.panel.corners(), margin_px);
        let facet = Quadrilateral::new(&self.panel.rectangle(self.u, self.v), 0.0);
        let (width, height) = layer.size();
        let run_length = facet.columns(width).len().div_ceil(RUNS).max(1);
        for y in facet.rows(height) {
            let usable = panel.whole_columns(y, width);
            let touched = intersection(&facet.touched_columns(y, width), &usable);
            let whole = intersection(&facet.whole_columns(y, width), &touched);
            for x in whole.clone().step_by(run_length) {
                self.add(&mut tally, layer, x..whole.end.min(x + run_length), y, 1.0);
            }
            for x in (touched.start..whole.start).chain(whole.end..touched.end) {
                let overlap = facet.overlap(x, y);
                if overlap > NO_OVERLAP {
                    self.add(&mut tally, layer, x..x + 1, y, overlap);
                }
            }
        }
        tally
    }

    /// Adds a run of pixels of row `y`, of each of which the part `overlap` is in the facet.
    fn add(&self, tally: &mut Tally, layer: Layer, columns: Range<usize>, y: usize, overlap: f64) {
        let mut run = Run::default();
        layer.visit(columns, y, |x, pixel| match pixel {
            Pixel::Light(light) => run.add(x, light),
            Pixel::Clipped => tally.clipped += 1,
            Pixel::NotFinite => tally.not_finite += 1,
        });
        if run.pixels() > 0.0 {
            let centre = Point::new(run.x(), y as f64 + 0.5);
            let (u, v, area) = self.panel.to_panel_with_area(centre);
            let u_from_centre = (u - self.u[0]) / (self.u[1] - self.u[0]) - 0.5;
            let v_from_centre = (v - self.v[0]) / (self.v[1] - self.v[0]) - 0.5;
            tally.pixels += overlap * run.pixels();
            tally.sums.add(overlap * area, u_from_centre, v_from_centre, &run);
        }
    }
}

/// The part of `a` in `b`; if there is none, an empty range in `b`.
fn intersection(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    let start = a.start.clamp(b.start, b.end);
    start..a.end.clamp(start, b.end)
}

/// Pixels beside each other share their geometry, in at least this many runs across a facet: that shifts a mean by
/// 1/(12 x 32²) of the product of what light and perspective change across the facet, a millionth where each changes
/// by a tenth, and halves the time a large picture takes.
const RUNS: usize = 32;

/// An overlap this small, px², is rounding.
const NO_OVERLAP: f64 = 1e-9;

#[derive(Default)]
struct Tally {
    sums: PixelSums,
    pixels: f64,
    clipped: usize,
    not_finite: usize,
}

impl Tally {
    fn finish(self, channels: usize) -> FacetMeasurement {
        let estimates: Option<Vec<Estimate>> =
            (0..channels).map(|channel| self.sums.estimate(channel)).collect();
        let each = estimates.as_ref();
        FacetMeasurement {
            mean: each.map(|each| each.iter().map(|estimate| estimate.mean).collect()),
            standard_error: each
                .and_then(|each| each.iter().map(|estimate| estimate.standard_error).collect()),
            pixels: self.pixels,
            clipped: self.clipped,
            not_finite: self.not_finite,
        }
    }
}
