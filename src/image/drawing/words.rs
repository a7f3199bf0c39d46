//! Words on a picture.

use std::sync::OnceLock;

use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};

use super::preview::Canvas;
use crate::image::placing::Point;

/// Height of a line, px.
const LINE_PX: f32 = 24.0;
/// Margin around words, px.
const MARGIN_PX: f64 = 5.0;

/// The font of all drawings; none if it cannot be read, and then no words are drawn.
fn font() -> Option<&'static FontRef<'static>> {
    static FONT: OnceLock<Option<FontRef<'static>>> = OnceLock::new();
    FONT.get_or_init(|| FontRef::try_from_slice(dejavu::sans::regular()).ok()).as_ref()
}

impl Canvas {
    /// Draws words, white on dark, centred on a point or as near to it as fits the picture.
    pub(super) fn say(&mut self, words: &str, middle: Point) {
        let Some(font) = font() else { return };
        let font = font.as_scaled(PxScale::from(LINE_PX));
        let (mut glyphs, mut right) = (Vec::new(), 0.0);
        for letter in words.chars() {
            let id = font.glyph_id(letter);
            glyphs.push(id.with_scale_and_position(LINE_PX, point(right, font.ascent())));
            right += font.h_advance(id);
        }
        let (height, width) = self.rgb.dim();
        let size = [f64::from(right), f64::from(font.height())].map(|side| side + 2.0 * MARGIN_PX);
        let place = |middle: f64, side: f64, most: usize| {
            (middle - side / 2.0).min(most as f64 - side).max(0.0).round()
        };
        let (x, y) = (place(middle.x, size[0], width), place(middle.y, size[1], height));
        let at = |dx: f64, dy: f64| Point::new(x + dx * size[0], y + dy * size[1]);
        self.fill(&[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)], [0.0; 3], 0.6);
        for glyph in glyphs {
            let Some(outline) = font.outline_glyph(glyph) else { continue };
            let (left, top) = (outline.px_bounds().min.x, outline.px_bounds().min.y);
            outline.draw(|column, row, share| {
                let start =
                    |corner: f64, from: f32, at: u32| corner + MARGIN_PX + f64::from(from) + f64::from(at);
                let (column, row) = (start(x, left, column), start(y, top, row));
                if let Some(pixel) = self.rgb.get_mut([row as usize, column as usize]) {
                    pixel.iter_mut().for_each(|value| *value += f64::from(share) * (1.0 - *value));
                }
            });
        }
    }
}
