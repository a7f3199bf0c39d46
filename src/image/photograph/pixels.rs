//! The pixels of a photograph, however they are stored.

use std::ops::Range;

use super::interleaved::Interleaved;
use super::pixel::Pixel;
use super::sites::Sites;

/// Pixels with their colours side by side, or sites of one colour each.
#[derive(Debug, Clone)]
pub(super) enum Pixels {
    Interleaved(Box<Interleaved>),
    Sites(Sites),
}

impl Pixels {
    /// Colours of a pixel: 3, or 1 for a grey picture.
    pub fn channels(&self) -> usize {
        match self {
            Self::Interleaved(pixels) => pixels.channels(),
            Self::Sites(_) => 3,
        }
    }

    /// The pixel in column `x` and row `y` of the upright picture; of sites the mean of each colour in the nine around it.
    pub fn pixel(&self, x: usize, y: usize) -> Pixel {
        match self {
            Self::Interleaved(pixels) => {
                let mut pixel = Pixel::NotFinite;
                pixels.visit(x..x + 1, y, |_, seen| pixel = seen);
                pixel
            }
            Self::Sites(sites) => sites.pixel(x, y),
        }
    }

    /// The pictures that lie in one another: a mosaic is three grey ones, each with holes; any other is one.
    pub fn layers(&self) -> impl Iterator<Item = PixelLayer<'_>> {
        let colours = match self {
            Self::Interleaved(_) => 0..1,
            Self::Sites(_) => 0..3,
        };
        colours.map(|colour| PixelLayer { pixels: self, colour })
    }
}

/// One of the layers.
#[derive(Clone, Copy)]
pub(super) struct PixelLayer<'a> {
    pixels: &'a Pixels,
    colour: usize,
}

impl PixelLayer<'_> {
    /// Colours that its pixels have of their own.
    pub fn channels(self) -> usize {
        match self.pixels {
            Pixels::Interleaved(pixels) => pixels.channels(),
            Pixels::Sites(_) => 1,
        }
    }

    /// Which of the three numbers of a pixel are its own; a grey pixel has all three, equal.
    pub fn numbers(self) -> Range<usize> {
        match self.pixels {
            Pixels::Interleaved(_) => 0..3,
            Pixels::Sites(_) => self.colour..self.colour + 1,
        }
    }

    /// Shows its pixels in `columns` of row `y` one after another, with their columns.
    #[inline]
    pub fn visit(self, columns: Range<usize>, y: usize, visitor: impl FnMut(usize, Pixel)) {
        match self.pixels {
            Pixels::Interleaved(pixels) => pixels.visit(columns, y, visitor),
            Pixels::Sites(sites) => sites.visit(self.colour, columns, y, visitor),
        }
    }

    /// A site has its own colour's light in place of all three.
    pub fn of_own_colour(self, pixel: Pixel) -> Pixel {
        match (self.pixels, pixel) {
            (Pixels::Sites(_), Pixel::Light(light)) => Pixel::Light([light[self.colour]; 3]),
            (_, other) => other,
        }
    }
}
