//! Factors by which light is multiplied, as functions of position.

use std::ops::Range;

use ndarray::Array3;
use rawler::imgop::Rect;
use rayon::prelude::*;

use super::parameters::Parameters;
use crate::image::photograph::Mosaic;

/// The sites to which an opcode applies.
pub(super) struct Area {
    pub rows: Range<usize>,
    pub columns: Range<usize>,
    pub planes: Range<usize>,
    /// Steps between rows and between columns.
    pub pitch: [usize; 2],
}

pub(super) enum Factor {
    Map(GainMap),
    /// One for each row of the area.
    Rows(Vec<f32>),
    /// One for each of its columns.
    Columns(Vec<f32>),
    Radial(Radial),
}

/// Gains at points of a grid, in fractions of the picture's height and width, interpolated bilinearly.
pub(super) struct GainMap {
    /// By row, column and plane.
    gains: Array3<f32>,
    origin: [f64; 2],
    spacing: [f64; 2],
    /// Height and width of the picture.
    size: [f64; 2],
}

/// A polynomial in the squared distance from the optical axis, relative to the farthest corner.
pub(super) struct Radial {
    coefficients: [f64; 5],
    /// Row and column of the optical axis.
    centre: [f64; 2],
    farthest_squared: f64,
}

impl Area {
    /// None, as everywhere here, if the parameters are inconsistent.
    pub fn read(of: &mut Parameters) -> Option<Self> {
        let [top, left, bottom, right] = [of.size()?, of.size()?, of.size()?, of.size()?];
        let [plane, planes, row_pitch, column_pitch] = [of.size()?, of.size()?, of.size()?, of.size()?];
        let makes_sense = top < bottom && left < right && row_pitch > 0 && column_pitch > 0;
        makes_sense.then(|| Self {
            rows: top..bottom,
            columns: left..right,
            planes: plane..plane + planes,
            pitch: [row_pitch, column_pitch],
        })
    }

    fn has_row(&self, row: usize) -> bool {
        self.rows.contains(&row) && (row - self.rows.start).is_multiple_of(self.pitch[0])
    }

    fn has_column(&self, column: usize) -> bool {
        self.columns.contains(&column) && (column - self.columns.start).is_multiple_of(self.pitch[1])
    }
}

impl Factor {
    /// The factor at a row and column of the area.
    fn at(&self, area: &Area, [row, column]: [usize; 2], plane: usize) -> f64 {
        match self {
            Self::Map(map) => map.at(row, column, plane),
            Self::Rows(factors) => factors[(row - area.rows.start) / area.pitch[0]].into(),
            Self::Columns(factors) => factors[(column - area.columns.start) / area.pitch[1]].into(),
            Self::Radial(radial) => radial.at(row, column),
        }
    }
}

impl GainMap {
    pub fn read(of: &mut Parameters, active: Rect) -> Option<Self> {
        let points = [of.size()?, of.size()?];
        let spacing = [of.double()?, of.double()?];
        let origin = [of.double()?, of.double()?];
        let planes = of.size()?;
        let gains = of.gains(points[0].checked_mul(points[1])?.checked_mul(planes)?)?;
        let gains = Array3::from_shape_vec((points[0], points[1], planes), gains).ok()?;
        // the spacing of a single point is meaningless
        let makes_sense = !gains.is_empty() && (0..2).all(|axis| points[axis] == 1 || spacing[axis] > 0.0);
        makes_sense.then(|| Self { gains, origin, spacing, size: [active.d.h as f64, active.d.w as f64] })
    }

    fn at(&self, row: usize, column: usize, plane: usize) -> f64 {
        let plane = plane.min(self.gains.dim().2 - 1);
        let (above, down) = self.place(0, row);
        let (left, right) = self.place(1, column);
        let gain = |row: usize, column: usize| {
            let (rows, columns, _) = self.gains.dim();
            f64::from(self.gains[[row.min(rows - 1), column.min(columns - 1), plane]])
        };
        let along = |row| (1.0 - right) * gain(row, left) + right * gain(row, left + 1);
        (1.0 - down) * along(above) + down * along(above + 1)
    }

    /// The grid point before a pixel's centre, and the fraction of a step beyond it; outside the grid, its
    /// edge.
    fn place(&self, axis: usize, pixel: usize) -> (usize, f64) {
        let last = self.gains.shape()[axis] - 1;
        if last == 0 {
            return (0, 0.0);
        }
        let place = ((pixel as f64 + 0.5) / self.size[axis] - self.origin[axis]) / self.spacing[axis];
        let place = place.clamp(0.0, last as f64);
        (place as usize, place.fract())
    }
}

impl Radial {
    /// None also if it is not a valid factor everywhere.
    pub fn read(of: &mut Parameters, active: Rect) -> Option<Self> {
        /// Resolution of this check: a lens's factor is smooth.
        const STEPS: u32 = 1000;
        let coefficients = [of.double()?, of.double()?, of.double()?, of.double()?, of.double()?];
        let [height, width] = [active.d.h as f64, active.d.w as f64];
        let (x, y) = (width * of.double()?, height * of.double()?);
        let farthest_squared = x.max(width - x).powi(2) + y.max(height - y).powi(2);
        let radial = Self { coefficients, centre: [y, x], farthest_squared };
        let squares = (0..=STEPS).map(|n| f64::from(n) / f64::from(STEPS));
        let mut factors = squares.map(|squared| radial.factor(squared));
        let makes_sense =
            farthest_squared.is_finite() && factors.all(|factor| factor >= 0.0 && factor.is_finite());
        makes_sense.then_some(radial)
    }

    fn at(&self, row: usize, column: usize) -> f64 {
        let [y, x] = self.centre;
        let squared =
            ((row as f64 + 0.5 - y).powi(2) + (column as f64 + 0.5 - x).powi(2)) / self.farthest_squared;
        self.factor(squared)
    }

    /// At a squared distance relative to the farthest.
    fn factor(&self, squared: f64) -> f64 {
        1.0 + squared * self.coefficients.iter().rev().fold(0.0, |sum, k| sum * squared + k)
    }
}

/// Multiplies an area's light; `top` and `left` are the first row and column of the light in the area's
/// coordinates. In a mosaic each site belongs to its colour's plane, if stated; otherwise to the first.
pub(super) fn multiply(
    light: &mut Array3<f32>,
    [top, left]: [usize; 2],
    area: &Area,
    factor: &Factor,
    mosaic: Option<&Mosaic>,
) {
    light.outer_iter_mut().into_par_iter().enumerate().for_each(|(row, mut light)| {
        let y = top + row;
        if !area.has_row(y) {
            return;
        }
        for ((column, sample), light) in light.indexed_iter_mut() {
            let x = left + column;
            let plane = mosaic.map_or(sample, |mosaic| mosaic.colour(column, row));
            if area.has_column(x) && area.planes.contains(&plane) {
                *light = (f64::from(*light) * factor.at(area, [y, x], plane)) as f32;
            }
        }
    });
}
