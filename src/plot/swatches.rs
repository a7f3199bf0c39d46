//! The appearance of sheets: one row per sheet, with its name and its colours, flat and folded.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::bitmap::Bitmap;
use super::figure::{COLOURS, Drawn, Figure};
use super::maps::Surface;
use super::sheet::Sheet;
use super::text::{GREY, SIZE, SMALL, elided, say, style};

const WIDTH: u32 = 760;
const HEADING: i32 = 24;
const ROW: i32 = 36;
/// Height of a swatch.
const TALL: i32 = 28;
/// Start and width of names, swatches and folds.
const NAME: (i32, u32) = (62, 330);
const SWATCH: (i32, i32) = (410, 60);
const FOLD: (i32, u32) = (550, 180);

/// The names of curves, with the colours of their sheets.
pub(super) struct Swatches<'a>(pub &'a [Sheet]);

impl Swatches<'_> {
    fn top(row: usize) -> i32 {
        HEADING + ROW * row as i32 + (ROW - TALL) / 2
    }

    fn heading<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        let say = |text: &str, x: i32, place| say(area, text, (x, HEADING / 2), &style(SMALL, place, GREY));
        if self.0.iter().any(|sheet| sheet.curve.truth.is_some()) {
            let dashes = (0..3).map(|n| 20 + 10 * n);
            dashes.into_iter().try_for_each(|x| {
                area.draw(&PathElement::new([(x, HEADING / 2), (x + 6, HEADING / 2)], BLACK.stroke_width(2)))
            })?;
            say("true (dashed)", NAME.0, HPos::Left)?;
        }
        if self.0.iter().any(|sheet| sheet.colours.is_some()) {
            say("estimated", SWATCH.0 + SWATCH.1 - 4, HPos::Right)?;
        }
        if self.0.iter().any(|sheet| sheet.colours.as_ref().is_some_and(|colours| colours.truth.is_some())) {
            say("true", SWATCH.0 + SWATCH.1 + 4, HPos::Left)?;
        }
        if self.0.iter().any(|sheet| sheet.folded().is_some()) {
            say("folded", FOLD.0 + FOLD.1 as i32 / 2, HPos::Center)?;
        }
        Ok(())
    }

    fn row<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, row: usize) -> Drawn<B> {
        let (sheet, top) = (&self.0[row], Self::top(row));
        let (middle, colour) = (top + TALL / 2, COLOURS[row % COLOURS.len()]);
        area.draw(&PathElement::new([(20, middle), (46, middle)], colour.stroke_width(3)))?;
        let words = style(SIZE, HPos::Left, BLACK);
        let name = elided(area, &sheet.curve.name, &words, NAME.1);
        say(area, &name, (NAME.0, middle), &words)?;
        let Some(colours) = &sheet.colours else { return Ok(()) };
        let mut right = SWATCH.0;
        for (n, srgb) in std::iter::once(&colours.estimate).chain(&colours.truth).enumerate() {
            let left = SWATCH.0 + SWATCH.1 * n as i32;
            let patch = [(left, top), (left + SWATCH.1, top + TALL)];
            area.draw(&Rectangle::new(patch, screen(*srgb).filled()))?;
            right = left + SWATCH.1;
        }
        // outlined, so that a white sheet is visible on white paper; true and estimated colours meet without
        // a line
        area.draw(&Rectangle::new([(SWATCH.0, top), (right, top + TALL)], GREY.stroke_width(1)))
    }
}

impl Figure for Swatches<'_> {
    fn size(&self) -> (u32, u32) {
        (WIDTH, (HEADING + ROW * self.0.len() as i32 + 10) as u32)
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        self.heading(area)?;
        (0..self.0.len()).try_for_each(|row| self.row(area, row))
    }

    fn bitmaps(&self) -> Vec<Bitmap<'_>> {
        let folded =
            self.0.iter().enumerate().filter_map(|(row, sheet)| Some((row, &sheet.panels, sheet.folded()?)));
        let bitmaps = folded.flat_map(|(row, panels, facets)| {
            let colour = move |facet: usize| facets.get(facet).map_or(WHITE, |srgb| screen(*srgb));
            Surface::new(panels).bitmaps((FOLD.0, Self::top(row)), (FOLD.1, TALL as u32), colour)
        });
        bitmaps.collect()
    }
}

/// sRGB, each 0..1, as a screen colour.
fn screen(srgb: [f64; 3]) -> RGBColor {
    let [r, g, b] = srgb.map(|value| (255.0 * value).round() as u8);
    RGBColor(r, g, b)
}
