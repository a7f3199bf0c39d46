//! The mean colour of every facet of a photographed sheet.
//!
//! A facet's value is the mean over the sheet's surface, which is what a form-factor model predicts: a pixel counts by
//! the panel area it shows. Pixels that straddle a panel's edge see something else as well and are left out, and so are those
//! that show no sheet ([`super::outliers`]); the mean is then that of a plane fitted to the others, taken over the whole facet
//! ([`super::plane_fit`]).

use std::ops::Range;

use rayon::prelude::*;

use super::corners::is_inside;
use super::homography::{Homography, Point};
use super::outliers::{Placed, without_outliers};
use super::photograph::{Layer, Photograph};
use super::pixel::Pixel;
use super::pixel_area::{Quadrilateral, Sides, sense};
use super::plane_fit::{Estimate, Run};
use crate::{Error, Result};

/// What a photograph says about one facet.
#[derive(Debug, Clone, PartialEq)]
pub struct FacetMeasurement {
    /// Mean linear light per channel, 1 at the white level; none if no pixel is usable or the facet reaches out of the picture.
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
    /// Pixels left out because they do not look like the rest of the facet: dust, specks.
    pub outliers: usize,
    /// Where the pixels are that were left out.
    pub left_out: Vec<PixelRun>,
}

/// Pixels beside each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PixelRun {
    /// Their columns.
    pub columns: Range<usize>,
    /// Their row.
    pub row: usize,
}

impl FacetMeasurement {
    /// Of no channels and no pixels.
    const NOTHING: Self = Self {
        mean: Some(Vec::new()),
        standard_error: Some(Vec::new()),
        pixels: 0.0,
        clipped: 0,
        not_finite: 0,
        outliers: 0,
        left_out: Vec::new(),
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
            outliers: self.outliers + others.outliers,
            left_out: [self.left_out, others.left_out].concat(),
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
/// A facet that reaches out of the picture by more than a pixel has no mean.
///
/// # Errors
/// [`Error::Corners`] if no facet of a panel lies in the picture.
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
    let rows = row_edges.len() - 1;
    let facet = |k: usize| {
        let (panel, row, col) = (&panels[k / (rows * cols)], k / cols % rows, k % cols);
        let u = [col, col + 1].map(|edge| edge as f64 / cols as f64);
        Facet { panel, u, v: [row_edges[row], row_edges[row + 1]] }
    };
    for k in 0..panels.len() {
        let mut facets = (k * rows * cols..(k + 1) * rows * cols).map(facet);
        if !facets.any(|facet| facet.is_inside((photograph.width(), photograph.height()))) {
            return Err(outside(k, photograph));
        }
    }
    // one task a facet: each is summed in one order whatever the threads
    let measure = |k: usize| facet(k).measure(photograph, margin_px);
    Ok((0..panels.len() * rows * cols).into_par_iter().map(measure).collect())
}

fn outside(panel: usize, photograph: &Photograph) -> Error {
    let (width, height) = (photograph.width(), photograph.height());
    Error::Corners {
        problem: format!("panel {panel}: no facet lies in the picture of {width} x {height} px"),
        remedy: "give corners in px of the upright picture, origin at its top left corner".to_owned(),
    }
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

    /// The pixels of one layer of a photograph.
    fn tally(&self, layer: Layer, margin_px: f64) -> Tally {
        let mut tally = Tally::default();
        if self.is_inside(layer.size()) {
            self.cells().for_each(|cell| self.tally_cell(&cell, layer, margin_px, &mut tally));
        }
        tally
    }

    /// Whether the whole facet lies in a picture of that width and height.
    fn is_inside(&self, (width, height): (usize, usize)) -> bool {
        self.panel.rectangle(self.u, self.v).iter().all(|corner| is_inside(*corner, width, height))
    }

    /// Parts of the facet whose sides are straight in the picture: one unless the lens bends them.
    fn cells(&self) -> impl Iterator<Item = Self> {
        let count =
            (self.panel.bow(self.u, self.v) / STRAIGHT_PX).sqrt().ceil().clamp(1.0, MOST_CELLS) as usize;
        let part = move |ends: [f64; 2], k: usize| {
            [k, k + 1].map(|edge| ends[0] + (ends[1] - ends[0]) * edge as f64 / count as f64)
        };
        let (panel, u, v) = (self.panel, self.u, self.v);
        (0..count * count).map(move |k| Self { panel, u: part(u, k % count), v: part(v, k / count) })
    }

    /// The panel's sides, as straight lines where they pass this part of it.
    fn panel_sides(&self, margin_px: f64) -> Sides {
        let line =
            |a: (f64, f64), b: (f64, f64)| [self.panel.to_image(a.0, a.1), self.panel.to_image(b.0, b.1)];
        let (u, v) = (self.u, self.v);
        let lines = [
            line((u[0], 0.0), (u[1], 0.0)),
            line((1.0, v[0]), (1.0, v[1])),
            line((u[1], 1.0), (u[0], 1.0)),
            line((0.0, v[1]), (0.0, v[0])),
        ];
        Sides::new(lines, sense(self.panel.corners()), margin_px)
    }

    /// Places the pixels of a part of the facet.
    fn tally_cell(&self, cell: &Self, layer: Layer, margin_px: f64, tally: &mut Tally) {
        let panel = cell.panel_sides(margin_px);
        let outline = Quadrilateral::new(&cell.panel.rectangle(cell.u, cell.v));
        let (width, height) = layer.size();
        let run_length = outline.columns(width).len().div_ceil(RUNS).max(1);
        for y in outline.rows(height) {
            let usable = panel.whole_columns(y, width);
            let touched = intersection(&outline.touched_columns(y, width), &usable);
            let whole = intersection(&outline.whole_columns(y, width), &touched);
            for x in whole.clone().step_by(run_length) {
                self.add(tally, layer, x..whole.end.min(x + run_length), y, 1.0);
            }
            for x in (touched.start..whole.start).chain(whole.end..touched.end) {
                let overlap = outline.overlap(x, y);
                if overlap > NO_OVERLAP {
                    self.add(tally, layer, x..x + 1, y, overlap);
                }
            }
        }
    }

    /// Adds a run of pixels of row `y`, of each of which the part `overlap` is in the facet.
    fn add(&self, tally: &mut Tally, layer: Layer, columns: Range<usize>, y: usize, overlap: f64) {
        let mut run = Run::default();
        layer.visit(columns.clone(), y, |x, pixel| match pixel {
            Pixel::Light(light) => run.add(x, light),
            other => tally.leave_out(other, x, y),
        });
        if run.pixels() > 0.0 {
            let centre = Point::new(run.x(), y as f64 + 0.5);
            let (u, v, area) = self.panel.to_panel_with_area(centre);
            let u = (u - self.u[0]) / (self.u[1] - self.u[0]) - 0.5;
            let v = (v - self.v[0]) / (self.v[1] - self.v[0]) - 0.5;
            tally.placed.push(Placed { weight: overlap * area, u, v, run });
            tally.runs.push((overlap, PixelRun { columns, row: y }));
        }
    }
}

/// The part of `a` in `b`; if there is none, an empty range in `b`.
fn intersection(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    let start = a.start.clamp(b.start, b.end);
    start..a.end.clamp(start, b.end)
}

/// Pixels beside each other share their geometry, in at least this many runs across a facet: that shifts a mean by
/// 1/(12 x 16²) of the product of what light and perspective change across the facet, three millionths where each
/// changes by a tenth, and halves the time a large picture takes.
const RUNS: usize = 16;

/// An overlap this small, px², is rounding.
const NO_OVERLAP: f64 = 1e-9;

/// Sides that bow by less than this, px, count as straight.
const STRAIGHT_PX: f64 = 0.02;
/// A side is not cut into more parts than this.
const MOST_CELLS: f64 = 100.0;

#[derive(Default)]
struct Tally {
    placed: Vec<Placed>,
    /// Of each of `placed`, the part of its pixels that lies in the facet, and where they are.
    runs: Vec<(f64, PixelRun)>,
    clipped: usize,
    not_finite: usize,
    left_out: Vec<PixelRun>,
}

impl Tally {
    /// Counts a pixel without light; most pictures have few.
    #[cold]
    fn leave_out(&mut self, pixel: Pixel, x: usize, y: usize) {
        match pixel {
            Pixel::Clipped => self.clipped += 1,
            _ => self.not_finite += 1,
        }
        match self.left_out.last_mut() {
            Some(run) if run.row == y && run.columns.end == x => run.columns.end += 1,
            _ => self.left_out.push(PixelRun { columns: x..x + 1, row: y }),
        }
    }

    fn finish(mut self, channels: usize) -> FacetMeasurement {
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
        let estimates: Option<Vec<Estimate>> = (0..channels).map(|channel| sums.estimate(channel)).collect();
        let each = estimates.as_ref();
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
