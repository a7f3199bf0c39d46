//! The pixels of a photograph, however they are stored.

use std::ops::Range;

use super::interleaved::Interleaved;
use super::orientation::Orientation;
use super::pixel::Pixel;
use super::sites::Sites;
use crate::image::numbers::Scale;

/// Pixels with interleaved colours, or sites of one colour each.
#[derive(Debug, Clone)]
pub(super) enum Pixels {
    Interleaved(Box<Interleaved>),
    Sites(Sites),
}

impl Pixels {
    /// The same pixels, turned.
    pub fn turned(&self, by: Orientation) -> Self {
        match self {
            Self::Interleaved(pixels) => Self::Interleaved(Box::new(pixels.turned(by))),
            Self::Sites(sites) => Self::Sites(sites.turned(by)),
        }
    }

    /// Number of colours per pixel: 3, or 1 for a grey picture.
    pub fn channels(&self) -> usize {
        match self {
            Self::Interleaved(pixels) => pixels.channels(),
            Self::Sites(_) => 3,
        }
    }

    /// The pixel in column `x` and row `y` of the upright picture; for sites the mean of each colour over the
    /// nine around it.
    #[inline]
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

    /// Whether its numbers are already light, not those of a file.
    pub fn are_light(&self) -> bool {
        match self {
            Self::Interleaved(pixels) => pixels.is_light(),
            Self::Sites(_) => true,
        }
    }

    /// Adjacent numbers of a colour in `columns`, in row `y` or just below it, as stored or as a sensor's
    /// light; those that are finite and not clipped.
    pub fn stored(&self, colour: usize, columns: Range<usize>, y: usize) -> Vec<f32> {
        match self {
            Self::Interleaved(pixels) => pixels.stored(colour, columns, y),
            Self::Sites(sites) => sites.stored(colour, columns, y),
        }
    }

    /// Changes the scale of each colour.
    pub fn rescale(&mut self, change: impl Fn(usize, Scale) -> Scale) {
        match self {
            Self::Interleaved(pixels) => pixels.rescale(change),
            Self::Sites(sites) => sites.rescale(change),
        }
    }
}
