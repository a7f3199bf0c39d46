//! A photograph with the measured facets drawn over it.

use std::path::Path;

use super::balance::Balance;
use super::preview::Canvas;
use crate::Result;
use crate::image::measuring::PixelRun;
use crate::image::photograph::Photograph;
use crate::image::placing::{Grid, Point, Quadrilateral};

/// Longest side of an overlay, px; small photographs are enlarged in whole pixels.
const LONGEST_PX: f64 = 1600.0;

/// Colours of the grids in their order, distinguishable by colour-blind people. Source: M. Okabe, K. Ito,
/// *Color Universal Design* (2008).
const GRIDS: [[f64; 3]; 4] = [[0.34, 0.71, 0.91], [0.90, 0.62, 0.0], [0.0, 0.62, 0.45], [0.94, 0.89, 0.26]];
/// Colour of the excluded pixels.
const LEFT_OUT: [f64; 3] = [1.0, 0.0, 0.2];
const BLACK: [f64; 3] = [0.0; 3];

/// Widths of the lines between facets and around them, px.
const THIN_PX: f64 = 1.0;
const THICK_PX: f64 = 2.5;
/// Side of the square on the first corner of a grid, px.
const FIRST_CORNER_PX: f64 = 11.0;
/// Colour and width of the crease, px.
const CREASE: [f64; 3] = [1.0; 3];
const CREASE_PX: f64 = 4.0;
/// Distance of an end's name from that end, towards the other, in lengths of the crease.
const END_INWARDS: f64 = 0.06;

/// Writes the photograph overlaid with grids and excluded pixels, as PNG of at most 1600 px per side.
///
/// Grids are blue, orange, green and yellow in turn. Panels carry their numbers; the crease is white, with
/// the number of each end; a square marks the first corner of each grid. Excluded pixels are red. Colours are
/// balanced for the eye, as a text chunk states.
///
/// # Errors
/// [`Error::File`](crate::Error::File) if the file cannot be written.
///
/// # Example
/// ```
/// use vfold::image::{
///     Balance, Grid, Homography, Photograph, Point, ReadOptions, write_linear, write_overlay,
/// };
/// let folder = tempfile::tempdir().unwrap();
/// let (path, overlay) = (folder.path().join("grey.tif"), folder.path().join("overlay.png"));
/// write_linear(&path, 40, 30, &[0.5; 40 * 30 * 3])?;
/// let corners = [(5.0, 5.0), (35.0, 5.0), (35.0, 25.0), (5.0, 25.0)].map(|(x, y)| Point::new(x, y));
/// let grid = Grid::even(Homography::from_unit_square(corners)?, [2, 3]);
/// let photograph = Photograph::open(&path, &ReadOptions::default())?;
/// write_overlay(&overlay, &photograph, &[grid], &[], &Balance::of(&photograph, None))?;
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn write_overlay(
    path: &Path,
    photograph: &Photograph,
    grids: &[Grid],
    left_out: &[PixelRun],
    balance: &Balance,
) -> Result<()> {
    let scale = LONGEST_PX / photograph.width().max(photograph.height()) as f64;
    let mut canvas = Canvas::new(photograph, if scale > 1.0 { scale.floor() } else { scale }, balance);
    for run in left_out {
        let (x, y) = ([run.columns.start, run.columns.end], [run.row, run.row + 1]);
        let corners = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]];
        let seen = corners.map(|[x, y]| canvas.at(Point::new(x as f64, y as f64)));
        canvas.fill(&seen, LEFT_OUT, 0.85);
    }
    for (k, grid) in grids.iter().enumerate() {
        canvas.draw_grid(grid, GRIDS[k % GRIDS.len()]);
    }
    for grid in grids {
        if let Some(number) = grid.panel {
            canvas.draw_crease(grid);
            canvas.say(&format!("panel {number}"), canvas.at(grid.outline.to_image(0.5, 0.5)));
        }
    }
    // panels that meet share a crease: its names are drawn once, over all lines
    if let Some(grid) = grids.iter().find(|grid| grid.panel.is_some()) {
        for (name, u) in [("end 0", END_INWARDS), ("crease", 0.5), ("end 1", 1.0 - END_INWARDS)] {
            canvas.say(name, canvas.at(grid.outline.to_image(u, 0.0)));
        }
    }
    canvas.write(path)
}

impl Canvas {
    /// Position on the canvas of a point of the photograph.
    fn at(&self, p: Point) -> Point {
        Point::new(p.x * self.scale, p.y * self.scale)
    }

    fn draw_grid(&mut self, grid: &Grid, colour: [f64; 3]) {
        let lines = |canvas: &Self, across: &[f64], along: &[f64], point: fn(f64, f64) -> (f64, f64)| {
            let line = |edge: &f64| -> Vec<Point> {
                let seen = |(u, v)| canvas.at(grid.outline.to_image(u, v));
                along.iter().map(|along| seen(point(*edge, *along))).collect()
            };
            across.iter().map(line).collect::<Vec<_>>()
        };
        let columns = lines(self, &grid.col_edges, &grid.row_edges, |u, v| (u, v));
        let rows = lines(self, &grid.row_edges, &grid.col_edges, |v, u| (u, v));
        for line in columns.iter().chain(&rows) {
            self.draw_line(line, THIN_PX + 1.0, BLACK, 0.3);
            self.draw_line(line, THIN_PX, colour, 0.9);
        }
        for line in [columns.first(), columns.last(), rows.first(), rows.last()].into_iter().flatten() {
            self.draw_line(line, THICK_PX + 2.0, BLACK, 0.5);
            self.draw_line(line, THICK_PX, colour, 1.0);
        }
        let first = self.at(grid.outline.corners()[0]);
        self.fill(&square(first, FIRST_CORNER_PX + 4.0), BLACK, 0.5);
        self.fill(&square(first, FIRST_CORNER_PX), colour, 1.0);
    }

    fn draw_crease(&mut self, grid: &Grid) {
        let ends = [0.0, 1.0].map(|u| self.at(grid.outline.to_image(u, 0.0)));
        self.draw_line(&ends, CREASE_PX + 2.0, BLACK, 1.0);
        self.draw_line(&ends, CREASE_PX, CREASE, 1.0);
    }

    fn draw_line(&mut self, points: &[Point], width: f64, colour: [f64; 3], opacity: f64) {
        for ends in points.windows(2) {
            if let Some(stroke) = stroke(ends[0], ends[1], width) {
                self.fill(&stroke, colour, opacity);
            }
        }
    }

    /// Paints a quadrilateral; pixels on its sides by the fraction that it covers.
    pub(super) fn fill(&mut self, corners: &[Point; 4], colour: [f64; 3], opacity: f64) {
        let quadrilateral = Quadrilateral::new(corners);
        let (height, width) = self.rgb.dim();
        for y in quadrilateral.rows(height) {
            for x in quadrilateral.touched_columns(y, width) {
                let share = opacity * quadrilateral.overlap(x, y);
                let pixel = &mut self.rgb[[y, x]];
                pixel.iter_mut().zip(colour).for_each(|(old, new)| *old += share * (new - *old));
            }
        }
    }
}

/// A line of this width, extended by half the width at each end; none if the ends coincide.
fn stroke(p: Point, q: Point, width: f64) -> Option<[Point; 4]> {
    let length = p.distance(q);
    let (x, y) = ((q.x - p.x) / length * width / 2.0, (q.y - p.y) / length * width / 2.0);
    let corner = |end: Point, along: f64, across: f64| {
        Point::new(end.x + along * x - across * y, end.y + along * y + across * x)
    };
    (length > 0.0)
        .then(|| [corner(p, -1.0, -1.0), corner(q, 1.0, -1.0), corner(q, 1.0, 1.0), corner(p, -1.0, 1.0)])
}

fn square(middle: Point, side: f64) -> [Point; 4] {
    let half = side / 2.0;
    [[-half, -half], [half, -half], [half, half], [-half, half]]
        .map(|[x, y]| Point::new(middle.x + x, middle.y + y))
}
