//! The pixels of a photograph, however they are stored.

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
}
