//! Text in drawings: one font, measured before it is set.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::figure::{Drawn, FONT};
use crate::markup::printable;

/// Text size, px.
pub(super) const SIZE: i32 = 14;
/// Size of secondary text.
pub(super) const SMALL: i32 = 12;
/// Grey that is legible on white.
pub(super) const GREY: RGBColor = RGBColor(85, 85, 85);

/// Text of a size, extending from a point to the right, to both sides or to the left.
pub(super) fn style(size: i32, place: HPos, colour: RGBColor) -> TextStyle<'static> {
    TextStyle { color: colour.to_backend_color(), ..TextStyle::from((FONT, size).into_font()) }
        .pos(Pos::new(place, VPos::Center))
}

/// Draws a line of text.
pub(super) fn say<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    text: &str,
    at: (i32, i32),
    style: &TextStyle,
) -> Drawn<B> {
    area.draw_text(&printable(text), style, at)
}

/// The text, with its middle omitted if it is wider than `width` px.
pub(super) fn elided<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    text: &str,
    style: &TextStyle,
    width: u32,
) -> String {
    let text = printable(text);
    let fits = |text: &str| area.estimate_text_size(text, style).is_ok_and(|(wide, _)| wide <= width);
    let letters: Vec<char> = text.chars().collect();
    let short = |kept: usize| {
        let (start, end) = (&letters[..kept.div_ceil(2)], &letters[letters.len() - kept / 2..]);
        start.iter().chain(&['…']).chain(end).collect::<String>()
    };
    if fits(&text) {
        return text;
    }
    // more letters never fit, and measuring takes time
    let most = letters.len().min(width as usize);
    (0..most).rev().map(short).find(|short| fits(short)).unwrap_or_else(|| short(0))
}

/// A number with three significant digits.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e5).contains(&size) {
        let decimals = (2 - size.log10().floor() as i32).max(0) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        format!("{value:.2e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let shown = [0.0, 0.00123, 0.5, 12.345, 1999.0, 123_456.0, -0.25, 1e-7].map(number);
        assert_eq!(shown, ["0", "0.00123", "0.5", "12.3", "1999", "1.23e5", "-0.25", "1.00e-7"]);
    }
}
