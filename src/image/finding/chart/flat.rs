//! A rectified chart, made from all the photograph's pixels, and the light of its patches.

use nalgebra::Matrix3;
use rayon::prelude::*;

use super::super::outline::Place;
use super::super::reduced::of_pixel;
use super::colours::{COLUMNS, Colours, ROWS};
use super::placement::patch;
use super::plane_map::seen;
use crate::image::photograph::Photograph;
use crate::image::placing::{Lens, Point};

/// Points across a cell.
pub(super) const PER_CELL: usize = 24;
/// Points around the outer patches' centres.
const MARGIN: usize = 14;
const WIDTH: usize = PER_CELL * (COLUMNS - 1) + 2 * MARGIN;
const HEIGHT: usize = PER_CELL * (ROWS - 1) + 2 * MARGIN;
/// Most pixels averaged for a point, in each direction.
const MOST_PIXELS: usize = 4;
/// Half the part of a patch whose light is its colour, in points.
const MIDDLE: usize = PER_CELL / 4;

/// A rectified chart.
pub(super) struct Flat(Vec<[f64; 3]>);

impl Flat {
    /// The chart that `to_picture` maps from columns and rows to the undistorted picture. Beyond its border
    /// the picture is continued.
    pub fn of(photograph: &Photograph, lens: &Lens, to_picture: &Matrix3<f64>) -> Self {
        let at = |x: f64, y: f64| {
            let ideal = seen(to_picture, Place::new(x, y));
            lens.distort(Point::new(ideal.x, ideal.y))
        };
        let (a, b) = (at(2.0, 1.0), at(3.0, 2.0));
        let cell_px = (a.x - b.x).hypot(a.y - b.y);
        let pixels = ((cell_px / PER_CELL as f64).round() as usize).clamp(1, MOST_PIXELS);
        let cells = |point: usize, n: usize| {
            (point as f64 - MARGIN as f64 + (n as f64 + 0.5) / pixels as f64) / PER_CELL as f64
        };
        let point = |k: usize| {
            let mut sum = [0.0; 3];
            for n in 0..pixels * pixels {
                let at = at(cells(k % WIDTH, n % pixels), cells(k / WIDTH, n / pixels));
                sum = added(sum, light(photograph, at));
            }
            sum.map(|sum| sum / (pixels * pixels) as f64)
        };
        Self((0..WIDTH * HEIGHT).into_par_iter().map(point).collect())
    }

    /// Mean light in the middle of each patch.
    pub fn colours(&self) -> Colours {
        std::array::from_fn(|k| {
            let middle = MIDDLE as isize;
            let points = (-middle..middle).flat_map(|y| (-middle..middle).map(move |x| (x, y)));
            let sum = points.map(|(x, y)| self.offset(k, x, y)).fold([0.0; 3], added);
            sum.map(|sum| sum / (4 * middle * middle) as f64)
        })
    }

    /// The point at this offset to the right of and below a patch's centre; point 0 has its centre half a
    /// point beyond that.
    pub fn offset(&self, k: usize, x: isize, y: isize) -> [f64; 3] {
        let centre = patch(k) * PER_CELL as f64;
        let at = |centre: f64, off: isize, size: usize| {
            (centre as isize + MARGIN as isize + off).clamp(0, size as isize - 1) as usize
        };
        self.0[at(centre.y, y, HEIGHT) * WIDTH + at(centre.x, x, WIDTH)]
    }
}

fn added(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Light at a point, interpolated bilinearly between four pixels' centres.
fn light(photograph: &Photograph, at: Point) -> [f64; 3] {
    let [x, y] = [at.x - 0.5, at.y - 0.5];
    let column = |x: f64| (x.max(0.0) as usize).min(photograph.width() - 1);
    let row = |y: f64| (y.max(0.0) as usize).min(photograph.height() - 1);
    let (right, down) = (x - x.floor(), y - y.floor());
    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
    corners.into_iter().fold([0.0; 3], |sum, (i, j)| {
        let weight = (if i > 0.0 { right } else { 1.0 - right }) * (if j > 0.0 { down } else { 1.0 - down });
        let light = of_pixel(photograph.pixel(column(x.floor() + i), row(y.floor() + j)));
        added(sum, light.map(|light| f64::from(light) * weight))
    })
}
