//! Uneven light, undone with a photograph of a white sheet.

use std::path::Path;

use super::pixel::Pixel;
use super::pixels::Pixels;
use crate::{Error, Result};

/// A photograph of an evenly coloured sheet: where the light falls, and what the lens takes from it towards the corners.
#[derive(Debug, Clone)]
pub struct FlatField {
    pixels: Pixels,
    size: (usize, usize),
    /// One over the mean light per channel.
    per_mean: [f64; 3],
}

impl FlatField {
    /// The flat field in the pixels of a picture of this width and height; `path` is for errors.
    ///
    /// # Errors
    /// As [`Photograph::into_flat_field`](super::Photograph::into_flat_field).
    pub(super) fn new(pixels: Pixels, size: (usize, usize), path: &Path) -> Result<Self> {
        let (width, height) = size;
        let (mut seen, mut counts, mut sums) = (0, [0.0; 3], [0.0; 3]);
        for layer in pixels.layers() {
            let numbers = layer.numbers();
            for y in 0..height {
                layer.visit(0..width, y, |_, pixel| {
                    seen += numbers.len();
                    let Pixel::Light(light) = pixel else { return };
                    for channel in numbers.clone() {
                        counts[channel] += 1.0;
                        sums[channel] += light[channel];
                    }
                });
            }
        }
        if 2.0 * counts.iter().sum::<f64>() < seen as f64 {
            let problem = "most of the flat field is clipped or not finite";
            return Err(Error::picture(path, problem, "expose it less, or check --white-level"));
        }
        if sums.iter().any(|sum| *sum <= 0.0) {
            return Err(Error::picture(
                path,
                "the flat field is dark",
                "expose it more, or check --black-level",
            ));
        }
        Ok(Self { pixels, size, per_mean: [0, 1, 2].map(|channel| counts[channel] / sums[channel]) })
    }

    /// Width and height, px.
    pub(super) fn size(&self) -> (usize, usize) {
        self.size
    }

    /// A pixel as even light would have shown it.
    pub(super) fn divide(&self, x: usize, y: usize, pixel: Pixel) -> Pixel {
        match (pixel, self.pixels.pixel(x, y)) {
            (Pixel::Light(light), Pixel::Light(flat)) if flat.iter().all(|flat| *flat > 0.0) => {
                Pixel::Light([0, 1, 2].map(|k| light[k] / (flat[k] * self.per_mean[k])))
            }
            (Pixel::Clipped, _) | (_, Pixel::Clipped) => Pixel::Clipped,
            _ => Pixel::NotFinite,
        }
    }
}
