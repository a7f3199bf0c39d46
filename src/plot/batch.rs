//! The distribution of the scores of many samples, and the worst of them.

use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::figure::{COLOURS, Drawn, Figure, save, svg};
use super::histogram::Histogram;
use super::text::{GREY, SIZE, SMALL, elided, number, say, style};
use crate::error::{Error, Result};

const WIDTH: u32 = 760;
const MARGIN: i32 = 20;
const TITLE: i32 = 30;
const HISTOGRAM: (u32, u32) = (240, 210);
const PER_ROW: usize = 3;
const ROW: i32 = 22;
/// Width of names, and the widest bar.
const NAMES: u32 = 330;
const BAR: f64 = 300.0;

/// The scores of a batch.
#[derive(Clone, Debug)]
pub struct Batch {
    /// Samples.
    pub samples: usize,
    /// Those that were scored.
    pub scored: usize,
    /// Name of each score, its mean and its values.
    pub scores: Vec<(String, f64, Vec<f64>)>,
    /// Names of the worst samples by the first score, worst first, with their values.
    pub worst: Vec<(String, f64)>,
}

impl Batch {
    /// Histograms and worst samples as SVG.
    ///
    /// # Errors
    /// [`Error::Numeric`] if they cannot be drawn.
    pub fn svg(&self) -> Result<String> {
        svg(self)
    }

    fn below_histograms(&self) -> i32 {
        TITLE + (self.scores.len().div_ceil(PER_ROW) * HISTOGRAM.1 as usize) as i32
    }

    fn histograms<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        for (n, (name, mean, values)) in self.scores.iter().enumerate() {
            let left = MARGIN + (n % PER_ROW) as i32 * HISTOGRAM.0 as i32;
            let top = TITLE + (n / PER_ROW) as i32 * HISTOGRAM.1 as i32;
            let part = area.clone().shrink((left, top), HISTOGRAM);
            let title = format!("{name}, mean {} (dashed)", number(*mean));
            Histogram::of(values).draw(&part, &title, *mean)?;
        }
        Ok(())
    }

    fn worst<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        let top = self.below_histograms();
        let Some((score, ..)) = self.scores.first() else { return Ok(()) };
        let title = match self.worst.len() {
            1 => format!("the worst by {score}"),
            several => format!("the worst {several} by {score}"),
        };
        say(area, &title, (MARGIN, top + TITLE / 2), &style(SIZE, HPos::Left, BLACK))?;
        let most = self.worst.iter().map(|(_, value)| value.abs()).fold(f64::MIN_POSITIVE, f64::max);
        for (n, (name, value)) in self.worst.iter().enumerate() {
            let (middle, left) = (top + TITLE + n as i32 * ROW + ROW / 2, MARGIN + NAMES as i32 + 10);
            let words = style(SMALL, HPos::Right, BLACK);
            let name = elided(area, name, &words, NAMES);
            say(area, &name, (left - 10, middle), &words)?;
            let right = left + (BAR * value.abs() / most).round() as i32;
            let bar = [(left, middle - ROW / 2 + 3), (right.max(left + 1), middle + ROW / 2 - 3)];
            area.draw(&Rectangle::new(bar, COLOURS[1].filled()))?;
            say(area, &number(*value), (right + 8, middle), &style(SMALL, HPos::Left, BLACK))?;
        }
        Ok(())
    }
}

impl Figure for Batch {
    fn size(&self) -> (u32, u32) {
        (WIDTH, (self.below_histograms() + TITLE + self.worst.len() as i32 * ROW + 14) as u32)
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        let title = format!("{} of {} samples scored", self.scored, self.samples);
        say(area, &title, (MARGIN, TITLE / 2), &style(SIZE, HPos::Left, GREY))?;
        self.histograms(area)?;
        self.worst(area)
    }
}

/// Draws a batch, as SVG or PNG.
///
/// # Errors
/// [`Error::File`] if it cannot be written, [`Error::NothingToDraw`] if no sample was scored.
pub fn draw(path: &Path, batch: &Batch) -> Result<()> {
    if batch.scored == 0 {
        return Err(Error::NothingToDraw("no sample was scored"));
    }
    save(path, batch)
}
