//! Common parts of all drawings: SVG or PNG by the file's extension, an embedded font, colours that all
//! readers can distinguish.

use std::path::Path;
use std::sync::Once;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;

use super::bitmap::Bitmap;
use crate::error::{Error, Result};
use crate::files::Saved;
use crate::image::png_bytes;

/// Okabe and Ito's colours, which colour-blind readers can distinguish; black is reserved for the truth.
pub const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(153, 153, 153),
];
/// Text is set in this font, and measured in it where a browser sets it.
pub(super) const FONT: &str = "sans-serif";

/// The result of a drawing step.
pub(super) type Drawn<B> = std::result::Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// A drawing for any backend.
pub(super) trait Figure {
    /// Width and height, pixels.
    fn size(&self) -> (u32, u32);

    /// Draws it on an area of this size, initially white.
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B>;

    /// Bitmaps drawn over it.
    fn bitmaps(&self) -> Vec<Bitmap<'_>> {
        Vec::new()
    }
}

/// One figure above an optional other.
pub(super) struct Above<A, B>(pub A, pub Option<B>);

impl<A: Figure, B: Figure> Figure for Above<A, B> {
    fn size(&self) -> (u32, u32) {
        let (width, height) = self.0.size();
        let (other_width, other_height) = self.1.as_ref().map_or((0, 0), Figure::size);
        (width.max(other_width), height + other_height)
    }

    fn draw<D: DrawingBackend>(&self, area: &DrawingArea<D, Shift>) -> Drawn<D> {
        let (upper, lower) = area.split_vertically(self.0.size().1);
        self.0.draw(&upper)?;
        self.1.as_ref().map_or(Ok(()), |other| other.draw(&lower))
    }

    fn bitmaps(&self) -> Vec<Bitmap<'_>> {
        let down = (0, self.0.size().1 as i32);
        let lower = self.1.iter().flat_map(Figure::bitmaps).map(|bitmap| bitmap.moved(down));
        self.0.bitmaps().into_iter().chain(lower).collect()
    }
}

/// Writes a figure as PNG if the extension says so, else as SVG.
///
/// # Errors
/// [`Error::File`] if the file cannot be written.
pub(super) fn save(path: &Path, figure: &impl Figure) -> Result<()> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("png") => png(path, figure),
        _ => Saved::write(path, svg(figure)?.as_bytes()),
    }
}

/// The figure as SVG.
///
/// # Errors
/// [`Error::Numeric`] if it cannot be drawn.
pub(super) fn svg(figure: &impl Figure) -> Result<String> {
    let mut text = String::new();
    draw_on(SVGBackend::with_string(&mut text, figure.size()), figure).map_err(undrawable)?;
    let pictures: String = figure.bitmaps().iter().map(Bitmap::svg).collect::<Result<_>>()?;
    let end = text.rfind("</svg>").unwrap_or(text.len());
    text.insert_str(end, &pictures);
    Ok(text)
}

fn png(path: &Path, figure: &impl Figure) -> Result<()> {
    let (width, height) = figure.size();
    let mut pixels = vec![0; 3 * (width * height) as usize];
    draw_on(BitMapBackend::with_buffer(&mut pixels, (width, height)), figure).map_err(undrawable)?;
    figure.bitmaps().iter().for_each(|bitmap| bitmap.paint(&mut pixels, width));
    Saved::write(path, &png_bytes(width, height, pixels)?)
}

/// Registers the font of all drawings, "sans-serif", with plotters, which measures text in it; repeated calls
/// are harmless.
pub fn load_font() {
    static FONT_LOADED: Once = Once::new();
    // fails only for a file that is not a font
    FONT_LOADED.call_once(|| drop(register_font(FONT, FontStyle::Normal, dejavu::sans::regular())));
}

fn draw_on<B: DrawingBackend>(backend: B, figure: &impl Figure) -> Drawn<B> {
    load_font();
    let area = backend.into_drawing_area();
    area.fill(&WHITE)?;
    figure.draw(&area)?;
    area.present()
}

fn undrawable(error: impl std::fmt::Display) -> Error {
    Error::Numeric(format!("cannot draw: {error}"))
}
