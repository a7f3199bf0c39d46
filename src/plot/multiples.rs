//! Many estimated spectra: a small chart for each, on a common scale.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::figure::{COLOURS, Drawn, FONT, Figure};
use super::sheet::Sheet;
use super::spectra::{draw_curve, ends, top};
use super::text::{GREY, SMALL, elided, say, style};

/// Most sheets in one drawing.
pub const MULTIPLES_MAX: usize = 60;
const ACROSS: usize = 4;
const CELL: (u32, u32) = (190, 140);
const MARGIN: i32 = 12;
/// Height of the text above all charts, and of the name above each.
const CAPTION: i32 = 30;
const NAME: i32 = 22;
/// Side of the swatch next to a sheet's name.
const SWATCH: i32 = 12;

/// The first sheets of `all`, at most [`MULTIPLES_MAX`] and at least one.
pub(super) struct Multiples<'a> {
    pub sheets: &'a [Sheet],
    pub all: usize,
}

impl Figure for Multiples<'_> {
    fn size(&self) -> (u32, u32) {
        let down = self.sheets.len().div_ceil(ACROSS) as u32;
        (ACROSS as u32 * CELL.0 + 2 * MARGIN as u32, CAPTION as u32 + down * CELL.1 + MARGIN as u32)
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        let shown = match self.sheets.len() {
            some if some < self.all => format!("{some} of {} samples; ", self.all),
            _ => String::new(),
        };
        let truth =
            if self.sheets.iter().any(|sheet| sheet.curve.truth.is_some()) { ", dashed: true" } else { "" };
        let caption =
            format!("{shown}reflectance over wavelength in nm, shaded: ± 2 standard deviations{truth}");
        say(area, &caption, (MARGIN, CAPTION / 2), &style(SMALL, HPos::Left, GREY))?;
        let curves = || self.sheets.iter().map(|sheet| &sheet.curve);
        let (ends, top) = (ends(curves()), top(curves()));
        for (place, sheet) in self.sheets.iter().enumerate() {
            let left = MARGIN + (place % ACROSS) as i32 * CELL.0 as i32;
            let above = CAPTION + (place / ACROSS) as i32 * CELL.1 as i32;
            draw_one(&area.clone().shrink((left, above), CELL), sheet, ends.clone(), top)?;
        }
        Ok(())
    }
}

fn draw_one<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    sheet: &Sheet,
    ends: std::ops::Range<f64>,
    top: f64,
) -> Drawn<B> {
    let words = style(SMALL, HPos::Left, BLACK);
    let name = elided(area, &sheet.curve.name, &words, CELL.0 - 2 * SWATCH as u32);
    say(area, &name, (SWATCH + 6, NAME / 2), &words)?;
    if let Some(colours) = &sheet.colours {
        let [r, g, b] = colours.estimate.map(|level| (255.0 * level).round() as u8);
        let above = (NAME - SWATCH) / 2;
        area.draw(&Rectangle::new([(0, above), (SWATCH, above + SWATCH)], RGBColor(r, g, b).filled()))?;
    }
    let (_, below) = area.split_vertically(NAME);
    let mut chart = ChartBuilder::on(&below)
        .margin_top(6)
        .margin_right(MARGIN)
        .x_label_area_size(18)
        .y_label_area_size(26)
        .build_cartesian_2d(ends, 0.0..top)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_labels(4)
        .y_labels(4)
        .x_label_formatter(&|nm| format!("{nm:.0}"))
        .y_label_formatter(&|reflectance| format!("{reflectance:.1}"))
        .label_style((FONT, 10))
        .draw()?;
    draw_curve(&mut chart, &sheet.curve, COLOURS[0], BLACK.stroke_width(1))
}
