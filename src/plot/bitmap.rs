//! Bitmaps in drawings: facets and gradients, which would make large files as shapes.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use plotters::prelude::RGBColor;

use crate::error::Result;
use crate::image::png_bytes;

/// Pixels of an embedded bitmap per pixel of the drawing: facets keep sharp sides on finer screens.
const FINENESS: u32 = 2;

/// A colour at every point of a rectangle, as a function of x and y from 0 to 1, y downwards.
pub(super) struct Bitmap<'a> {
    pub corner: (i32, i32),
    pub size: (u32, u32),
    pub colour: Box<dyn Fn(f64, f64) -> RGBColor + 'a>,
}

impl Bitmap<'_> {
    /// The same, moved to the right and down.
    pub fn moved(self, (x, y): (i32, i32)) -> Self {
        Self { corner: (self.corner.0 + x, self.corner.1 + y), ..self }
    }

    /// As an element of SVG.
    pub fn svg(&self) -> Result<String> {
        let ((x, y), (width, height)) = (self.corner, self.size);
        let (columns, rows) = (FINENESS * width, FINENESS * height);
        let picture = data_uri("image/png", &png_bytes(columns, rows, self.pixels(columns, rows))?);
        Ok(format!(
            "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
             style=\"image-rendering:pixelated\" href=\"{picture}\"/>\n"
        ))
    }

    /// Paints it into a picture of `width` pixels, entirely inside it.
    pub fn paint(&self, picture: &mut [u8], width: u32) {
        let pixels = self.pixels(self.size.0, self.size.1);
        for (row, line) in pixels.chunks_exact(3 * self.size.0 as usize).enumerate() {
            let start = 3 * ((self.corner.1 as usize + row) * width as usize + self.corner.0 as usize);
            picture[start..start + line.len()].copy_from_slice(line);
        }
    }

    fn pixels(&self, columns: u32, rows: u32) -> Vec<u8> {
        let place = |n: u32, count: u32| (f64::from(n) + 0.5) / f64::from(count);
        let pixels = (0..rows).flat_map(|y| (0..columns).map(move |x| (place(x, columns), place(y, rows))));
        pixels.map(|(x, y)| (self.colour)(x, y)).flat_map(|RGBColor(r, g, b)| [r, g, b]).collect()
    }
}

/// Bytes as a data URI: RFC 2397.
///
/// # Example
/// ```
/// assert_eq!(vfold::plot::data_uri("text/plain", b"fold"), "data:text/plain;base64,Zm9sZA==");
/// ```
#[must_use]
pub fn data_uri(media_type: &str, bytes: &[u8]) -> String {
    format!("data:{media_type};base64,{}", STANDARD.encode(bytes))
}
