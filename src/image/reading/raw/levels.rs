//! Black and white levels of a sensor.
//!
//! Every site may have a black level of its own. The distance from black to white is the same for all sites
//! of a sample, measured from the highest black level, so that equal numbers above black are equal light.
//!
//! # Source
//! Adobe, *Digital Negative Specification* 1.7, chapter 5.

use std::path::Path;

use ndarray::{Array3, Axis};
use rawler::RawImage;
use rawler::imgop::{Point, Rect};

use super::refused::damaged;
use super::tiff_directories::Directory;
use crate::Result;
use crate::error::counted;
use crate::image::numbers::{ReadOptions, Scale, Transfer};
use crate::image::reading::tiff::tags::{BLACK_LEVEL, WHITE_LEVEL};

const BLACK_REPEAT: u16 = 50713;
const BLACK_DELTA_H: u16 = 50715;
const BLACK_DELTA_V: u16 = 50716;

/// More levels than any pattern has.
const MAX_LEVELS: usize = 1 << 12;

/// Black and white levels of a sensor, in linearized stored numbers.
pub(super) struct Levels {
    /// By row, column and sample of a repeated pattern.
    black: Array3<f64>,
    /// Column and row of the sensor where the pattern and the deltas begin.
    origin: Point,
    /// Added in each column; empty if zero.
    by_column: Vec<f64>,
    /// Added in each row; empty if zero.
    by_row: Vec<f64>,
    /// By sample.
    white: Vec<f64>,
}

impl Levels {
    /// The levels in a DNG, starting at its active area's corner.
    ///
    /// # Errors
    /// [`crate::Error::Picture`] if their number does not fit its sites and samples.
    pub fn of_dng(
        path: &Path,
        directory: &Directory,
        active: Rect,
        samples: usize,
        full_scale: f64,
    ) -> Result<Self> {
        let numbers = |tag: u16, name: &str| match directory.numbers(tag) {
            Some(numbers) if numbers.iter().all(|number| number.is_finite()) => Ok(numbers),
            None if !directory.has_tag(tag) => Ok(Vec::new()),
            _ => Err(damaged(path, format!("its {name} has no numbers"))),
        };
        let deltas = |tag: u16, name: &str, size: usize, of: &str| match numbers(tag, name)? {
            deltas if deltas.is_empty() || deltas.len() == size => Ok(deltas),
            deltas => {
                let problem = format!("its {name} has {} for {size} {of}", counted(deltas.len(), "number"));
                Err(damaged(path, problem))
            }
        };
        // some Pentax files contain one meaningless number
        let (rows, columns) = match numbers(BLACK_REPEAT, "BlackLevelRepeatDim")?[..] {
            [rows, columns] => (rows as usize, columns as usize),
            _ => (1, 1),
        };
        let black = spread(numbers(BLACK_LEVEL, "BlackLevel")?, rows.saturating_mul(columns), samples, 0.0)
            .and_then(|levels| Array3::from_shape_vec((rows, columns, samples), levels).ok())
            .filter(|levels| !levels.is_empty());
        let pattern = || format!("its BlackLevel does not fit a pattern of {rows} x {columns} sites");
        Ok(Self {
            black: black.ok_or_else(|| damaged(path, pattern()))?,
            origin: active.p,
            by_column: deltas(BLACK_DELTA_H, "BlackLevelDeltaH", active.d.w, "columns")?,
            by_row: deltas(BLACK_DELTA_V, "BlackLevelDeltaV", active.d.h, "rows")?,
            white: spread(numbers(WHITE_LEVEL, "WhiteLevel")?, 1, samples, full_scale).ok_or_else(|| {
                damaged(path, format!("its WhiteLevel does not fit {}", counted(samples, "sample")))
            })?,
        })
    }

    /// The levels that a decoder knows for a camera; none if they fill no pattern.
    pub fn of_camera(image: &RawImage) -> Option<Self> {
        let (levels, whites) = (&image.blacklevel, &image.whitelevel.0);
        let black = levels.as_vec().into_iter().map(f64::from).collect();
        let black = Array3::from_shape_vec((levels.height, levels.width, levels.cpp), black).ok();
        let white = |sample: usize| whites.get(sample).or(whites.first()).copied().map(f64::from);
        Some(Self {
            black: black.filter(|levels| !levels.is_empty())?,
            origin: Point::zero(),
            by_column: Vec::new(),
            by_row: Vec::new(),
            white: (0..image.cpp).map(white).collect::<Option<_>>()?,
        })
    }

    /// The same, replaced by levels of the command line where stated, which apply to all sites.
    /// # Errors
    /// [`crate::Error::Usage`] if a white level is not above the highest black level.
    pub fn with_stated(mut self, options: &ReadOptions) -> Result<Self> {
        if let Some(black) = options.black_level {
            let samples = self.white.len();
            let black = Array3::from_elem((1, 1, samples), black);
            self = Self { black, by_column: Vec::new(), by_row: Vec::new(), ..self };
        }
        if let Some(white) = options.white_level {
            self.white.fill(white);
        }
        for (sample, white) in self.white.iter().enumerate() {
            let levels = ReadOptions {
                transfer: Transfer::Linear,
                black_level: Some(self.highest_black(sample)),
                white_level: Some(*white),
                ..*options
            };
            Scale::new(&levels, 16)?;
        }
        Ok(self)
    }

    /// The black level of a sample at a column and row of the whole sensor.
    #[inline]
    pub fn black(&self, x: usize, y: usize, sample: usize) -> f64 {
        self.of_pattern(x, y, sample) + self.of_column(x) + self.of_row(y)
    }

    #[inline]
    fn of_pattern(&self, x: usize, y: usize, sample: usize) -> f64 {
        let (rows, columns, samples) = self.black.dim();
        // the pattern continues before the origin
        let column = (x + columns - self.origin.x % columns) % columns;
        let row = (y + rows - self.origin.y % rows) % rows;
        self.black[[row, column, sample.min(samples - 1)]]
    }

    #[inline]
    fn of_column(&self, x: usize) -> f64 {
        x.checked_sub(self.origin.x).and_then(|at| self.by_column.get(at)).copied().unwrap_or(0.0)
    }

    #[inline]
    fn of_row(&self, y: usize) -> f64 {
        y.checked_sub(self.origin.y).and_then(|at| self.by_row.get(at)).copied().unwrap_or(0.0)
    }

    /// The white level of a sample.
    pub fn white(&self, sample: usize) -> f64 {
        self.white[sample]
    }

    /// The highest black level of a sample at any site.
    pub fn highest_black(&self, sample: usize) -> f64 {
        let (rows, columns, samples) = self.black.dim();
        let highest = |deltas: &[f64], phase: usize, repeat: usize| {
            deltas.iter().skip(phase).step_by(repeat).copied().reduce(f64::max).unwrap_or(0.0)
        };
        let levels = self.black.index_axis(Axis(2), sample.min(samples - 1));
        let at = |((row, column), level): ((usize, usize), &f64)| {
            level + highest(&self.by_column, column, columns) + highest(&self.by_row, row, rows)
        };
        levels.indexed_iter().map(at).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The mean black level of a sample over an area's sites that `counts` selects by column and row of the
    /// area, with period `side` in both.
    ///
    /// Pattern, columns and rows are averaged separately, over as few sites as repeat: a photograph has tens
    /// of millions.
    pub fn mean_black(
        &self,
        area: Rect,
        sample: usize,
        side: usize,
        counts: impl Fn(usize, usize) -> bool,
    ) -> f64 {
        let Rect { p: corner, d: size } = area;
        let (rows, columns, _) = self.black.dim();
        let pattern = mean_of(side * columns, side * rows, &counts, |x, y| {
            self.of_pattern(corner.x + x, corner.y + y, sample)
        });
        let by_column = mean_of(size.w.max(side), side, &counts, |x, _| self.of_column(corner.x + x));
        let by_row = mean_of(side, size.h.max(side), &counts, |_, y| self.of_row(corner.y + y));
        pattern + by_column + by_row
    }
}

/// The mean level of the selected sites.
fn mean_of(
    width: usize,
    height: usize,
    counts: impl Fn(usize, usize) -> bool,
    level: impl Fn(usize, usize) -> f64,
) -> f64 {
    let sites = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let (mut sum, mut count) = (0.0, 0.0);
    for (x, y) in sites.filter(|(x, y)| counts(*x, *y)) {
        sum += level(x, y);
        count += 1.0;
    }
    sum / count
}

/// A number for each sample of each site, from one for all, one per sample, one per site, or one per sample
/// and site.
fn spread(numbers: Vec<f64>, sites: usize, samples: usize, default: f64) -> Option<Vec<f64>> {
    let all = sites.checked_mul(samples).filter(|all| *all <= MAX_LEVELS)?;
    match numbers.len() {
        0 => Some(vec![default; all]),
        1 => Some(vec![numbers[0]; all]),
        count if count == all => Some(numbers),
        count if count == sites => {
            Some(numbers.into_iter().flat_map(|number| std::iter::repeat_n(number, samples)).collect())
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use rawler::imgop::Dim2;

    use super::*;

    #[test]
    fn the_mean_black_is_that_of_all_sites() {
        let levels = Levels {
            black: Array3::from_shape_fn((2, 3, 1), |(row, column, _)| (10 * row + column * column) as f64),
            origin: Point::new(1, 2),
            by_column: (0..12).map(|x| f64::from(x % 2 * 8 + x)).collect(),
            by_row: (0..12).map(|y| f64::from(y % 4 * 25)).collect(),
            white: vec![1000.0],
        };
        let area = Rect::new(levels.origin, Dim2::new(12, 12));
        // the sites of each of three colours in a Bayer mosaic
        for colour in 0..3 {
            let counts = |x: usize, y: usize| x % 2 + y % 2 == colour;
            let all = mean_of(12, 12, counts, |x, y| levels.black(1 + x, 2 + y, 0));
            let mean = levels.mean_black(area, 0, 2, counts);
            assert!((mean - all).abs() < 1e-9, "{colour}: {mean}, not {all}");
        }
    }
}
