//! The mean colour of every facet of a photographed sheet.
//!
//! A facet's value is the mean over the sheet's surface, as a form-factor model predicts: each pixel is
//! weighted by the panel area it shows. Pixels across a panel's edge partly see something else and are
//! excluded, as are those that do not show the sheet ([`super::outliers`]). The mean is that of a plane
//! fitted to the others, over the whole facet ([`super::plane_fit`]).

use std::ops::Range;

use rayon::prelude::*;

use super::measurement::{FacetMeasurement, PixelRun};
use super::outliers::Placed;
use super::plane_fit::Run;
use super::tally::Tally;
use crate::image::photograph::{Layer, Photograph, Pixel};
use crate::image::placing::{Grid, Homography, Point, Quadrilateral, Sides, is_inside, sense};
use crate::{Error, Result};

/// Measures every facet of one or more panels.
///
/// # Arguments
/// - `panels`: the position of each, by the order of [`PANEL_CORNERS`](crate::image::PANEL_CORNERS), and its
///   division into facets.
/// - `margin_px`: least distance of a pixel from a panel's edge, at least 0; blur and inaccurate corners need
///   one or two.
///
/// # Returns
/// Facets by panel, then row (0 at the crease), then column (0 at crease end 0). Independent of the number of
/// threads.
///
/// A facet that extends more than a pixel beyond the picture has no mean.
///
/// # Errors
/// [`Error::Corners`] if no facet of a panel lies in the picture.
///
/// # Example
/// ```
/// use vfold::image::{Grid, Homography, Photograph, Point, ReadOptions, measure, write_linear};
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("ramp.exr");
/// // 10 x 10 px, brighter to the right
/// let ramp: Vec<f64> = (0..300).map(|k| (k / 3 % 10) as f64 / 16.0).collect();
/// write_linear(&path, 10, 10, &ramp)?;
/// let corners = [(0., 0.), (10., 0.), (10., 10.), (0., 10.)].map(|(x, y)| Point::new(x, y));
/// let panel = Homography::from_unit_square(corners)?;
/// let photograph = Photograph::open(&path, &ReadOptions::default())?;
/// let facets = measure(&photograph, &[Grid::even(panel, [1, 2])], 0.0)?;
/// let means: Vec<f64> = facets.iter().map(|facet| facet.mean.as_ref().unwrap()[0]).collect();
/// assert!((means[0] - 2.0 / 16.0).abs() < 1e-12 && (means[1] - 7.0 / 16.0).abs() < 1e-12);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn measure(photograph: &Photograph, panels: &[Grid], margin_px: f64) -> Result<Vec<FacetMeasurement>> {
    let size = (photograph.width(), photograph.height());
    if let Some(outside) = panels.iter().find(|panel| !panel.facets().any(|facet| facet.is_inside(size))) {
        return Err(is_outside(outside, size));
    }
    let facets: Vec<Facet> = panels.iter().flat_map(Grid::facets).collect();
    // one task per facet keeps the order of summation independent of the number of threads
    Ok(facets.par_iter().map(|facet| facet.measure(photograph, margin_px)).collect())
}

fn is_outside(grid: &Grid, (width, height): (usize, usize)) -> Error {
    let panel = grid.panel.map_or(String::new(), |number| format!("panel {number}: "));
    Error::Corners {
        problem: format!("{panel}no facet lies in the picture of {width} x {height} px"),
        remedy: "give corners in px of the upright picture, origin at its top left corner".to_owned(),
    }
}

/// A rectangle of a panel: its range along the crease and away from it.
struct Facet<'a> {
    panel: &'a Homography,
    u: [f64; 2],
    v: [f64; 2],
}

impl Grid {
    /// Row by row.
    fn facets(&self) -> impl Iterator<Item = Facet<'_>> {
        let facet = |v: &[f64], u: &[f64]| Facet { panel: &self.outline, u: [u[0], u[1]], v: [v[0], v[1]] };
        self.row_edges.windows(2).flat_map(move |v| self.col_edges.windows(2).map(move |u| facet(v, u)))
    }
}

impl Facet<'_> {
    fn measure(&self, photograph: &Photograph, margin_px: f64) -> FacetMeasurement {
        let each = photograph.layers().map(|layer| self.tally(layer, margin_px).finish(layer.channels()));
        each.fold(FacetMeasurement::NOTHING, FacetMeasurement::with_channels)
    }

    /// Tallies the pixels of one layer of a photograph.
    fn tally(&self, layer: Layer, margin_px: f64) -> Tally {
        let mut tally = Tally::default();
        if self.is_inside(layer.size()) {
            self.cells().for_each(|cell| self.tally_cell(&cell, layer, margin_px, &mut tally));
        }
        tally
    }

    /// Whether the whole facet lies in a picture of this width and height.
    fn is_inside(&self, (width, height): (usize, usize)) -> bool {
        self.panel.rectangle(self.u, self.v).iter().all(|corner| is_inside(*corner, width, height))
    }

    /// Parts of the facet whose sides are straight in the picture: one unless the lens distorts.
    fn cells(&self) -> impl Iterator<Item = Self> {
        let count =
            (self.panel.bow(self.u, self.v) / STRAIGHT_PX).sqrt().ceil().clamp(1.0, MOST_CELLS) as usize;
        let part = move |ends: [f64; 2], k: usize| {
            [k, k + 1].map(|edge| ends[0] + (ends[1] - ends[0]) * edge as f64 / count as f64)
        };
        let (panel, u, v) = (self.panel, self.u, self.v);
        (0..count * count).map(move |k| Self { panel, u: part(u, k % count), v: part(v, k / count) })
    }

    /// The panel's sides, as straight lines at this part of it.
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

    /// Tallies the pixels of a part of the facet.
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

    /// Adds a run of pixels of row `y`; the fraction `overlap` of each is in the facet.
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
            tally.add(Placed { weight: overlap * area, u, v, run }, overlap, PixelRun { columns, row: y });
        }
    }
}

/// The part of `a` in `b`; an empty range in `b` if there is none.
fn intersection(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    let start = a.start.clamp(b.start, b.end);
    start..a.end.clamp(start, b.end)
}

/// Least number of runs of adjacent pixels across a facet; a run shares its geometry. That shifts a mean by
/// 1/(12 x 16²) of the product of the changes of light and perspective across the facet, three millionths if
/// each is a tenth, and halves the time for a large picture.
const RUNS: usize = 16;

/// Overlaps up to this, px², are rounding errors.
const NO_OVERLAP: f64 = 1e-9;

/// Sides that bow by less than this, px, count as straight.
const STRAIGHT_PX: f64 = 0.02;
/// Most parts into which a side is divided.
const MOST_CELLS: f64 = 100.0;
