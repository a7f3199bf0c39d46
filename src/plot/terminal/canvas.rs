//! Places a curve, its band and its truth in the characters of a plot.

use crate::plot::spectra::{Curve, highest};

/// Rows of a plot, without its axis.
pub const ROWS: usize = 12;
/// Reflectances at the top, chosen so that quarters have two decimals.
const TOPS: [f64; 6] = [0.08, 0.12, 0.2, 0.4, 0.6, 0.8];
/// The bits of a braille character, row by row.
const BITS: [[u8; 2]; 4] = [[0, 3], [1, 4], [2, 5], [6, 7]];

/// Contents of a character; the curve hides the truth, which hides the band.
#[derive(Clone, Copy, Default)]
pub struct Cell {
    /// Bits of the braille character for the curve's dots.
    pub dots: u8,
    pub truth: bool,
    pub band: bool,
}

/// The area between the axes.
pub struct Canvas {
    /// From top to bottom.
    pub rows: Vec<Vec<Cell>>,
    /// First and last wavelength.
    pub ends_nm: [f64; 2],
    /// Reflectance at the top.
    pub top: f64,
}

impl Canvas {
    /// A curve on `width` columns, each a character with this many dots across and down.
    pub fn of(curve: &Curve, width: usize, dots: [usize; 2]) -> Self {
        let reach = highest(curve);
        let top = TOPS.into_iter().find(|top| reach <= *top).unwrap_or(1.0);
        let [first, last] = [curve.wavelengths_nm.first(), curve.wavelengths_nm.last()];
        let ends_nm = [first, last].map(|nm| nm.copied().unwrap_or_default());
        let mut canvas = Self { rows: vec![vec![Cell::default(); width]; ROWS], ends_nm, top };
        canvas.fill(curve, width);
        canvas.trace(&curve.wavelengths_nm, &curve.reflectance, width, dots);
        canvas
    }

    /// The wavelength in the middle of one of `columns` columns.
    fn nm(&self, column: usize, columns: usize) -> f64 {
        let [first, last] = self.ends_nm;
        first + (column as f64 + 0.5) / columns as f64 * (last - first)
    }

    /// The line, of `lines` from the top, that contains a reflectance.
    fn line(&self, reflectance: f64, lines: usize) -> usize {
        let from_top = (1.0 - reflectance / self.top) * lines as f64;
        (from_top.max(0.0) as usize).min(lines - 1)
    }

    /// Marks the band and the truth.
    fn fill(&mut self, curve: &Curve, width: usize) {
        let band = curve.edges();
        for column in 0..width {
            let nm = self.nm(column, width);
            if let Some([low, high]) = &band
                && let (Some(low), Some(high)) =
                    (at(&curve.wavelengths_nm, low, nm), at(&curve.wavelengths_nm, high, nm))
            {
                let lines = self.line(high, ROWS)..=self.line(low, ROWS);
                lines.for_each(|line| self.rows[line][column].band = true);
            }
            if let Some((wavelengths_nm, reflectance)) = &curve.truth
                && let Some(reflectance) = at(wavelengths_nm, reflectance, nm)
            {
                let line = self.line(reflectance, ROWS);
                self.rows[line][column].truth = true;
            }
        }
    }

    /// Sets the dots of a curve, connecting successive ones.
    fn trace(
        &mut self,
        wavelengths_nm: &[f64],
        reflectance: &[f64],
        width: usize,
        [across, down]: [usize; 2],
    ) {
        let mut before = None;
        for column in 0..width * across {
            let Some(value) = at(wavelengths_nm, reflectance, self.nm(column, width * across)) else {
                continue;
            };
            let line = self.line(value, ROWS * down);
            let from = before.unwrap_or(line);
            for line in from.min(line)..=from.max(line) {
                self.rows[line / down][column / across].dots |= 1 << BITS[line % down][column % across];
            }
            before = Some(line);
        }
    }
}

/// The value at a wavelength, interpolated linearly; none outside.
fn at(wavelengths_nm: &[f64], values: &[f64], nm: f64) -> Option<f64> {
    let right = wavelengths_nm.partition_point(|sample| *sample <= nm);
    let left = right.checked_sub(1)?;
    let (x, y) = (wavelengths_nm.get(left..=right)?, values.get(left..=right)?);
    Some(y[0] + (nm - x[0]) / (x[1] - x[0]) * (y[1] - y[0]))
}
