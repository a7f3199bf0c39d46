//! Corrects uneven light by a photograph of a white sheet.

use std::path::Path;

use super::pixel::Pixel;
use super::{Photograph, PhotographInfo};
use crate::{Error, Result};

/// A photograph of a uniformly coloured sheet, which shows the distribution of the light and the vignetting.
#[derive(Debug, Clone)]
pub struct FlatField {
    sheet: Box<Photograph>,
    /// One over the mean light per channel.
    per_mean: [f64; 3],
}

impl FlatField {
    /// The flat field from a photograph of a sheet; `path` is for errors.
    ///
    /// # Errors
    /// As [`Photograph::into_flat_field`].
    pub(super) fn new(sheet: Photograph, path: &Path) -> Result<Self> {
        let (mut seen, mut counts, mut sums) = (0, [0.0; 3], [0.0; 3]);
        for layer in sheet.layers() {
            let numbers = layer.numbers();
            for y in 0..sheet.height() {
                layer.visit(0..sheet.width(), y, |_, pixel| {
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
                "the flat field is too dark",
                "expose it more, or check --black-level",
            ));
        }
        let per_mean = [0, 1, 2].map(|channel| counts[channel] / sums[channel]);
        Ok(Self { sheet: Box::new(sheet), per_mean })
    }

    /// Mean of each channel of the sheet, which counts as 1 in what is divided by it.
    #[must_use]
    pub fn mean(&self) -> [f64; 3] {
        self.per_mean.map(f64::recip)
    }

    /// The photograph of the sheet.
    #[must_use]
    pub fn info(&self) -> &PhotographInfo {
        self.sheet.info()
    }

    /// Width and height, px.
    pub(super) fn size(&self) -> (usize, usize) {
        (self.sheet.width(), self.sheet.height())
    }

    /// A pixel as it would be in uniform light.
    pub(super) fn divide(&self, x: usize, y: usize, pixel: Pixel) -> Pixel {
        match (pixel, self.sheet.pixel(x, y)) {
            (Pixel::Light(light), Pixel::Light(flat)) if flat.iter().all(|flat| *flat > 0.0) => {
                Pixel::Light([0, 1, 2].map(|k| light[k] / (flat[k] * self.per_mean[k])))
            }
            (Pixel::Clipped, _) | (_, Pixel::Clipped) => Pixel::Clipped,
            _ => Pixel::NotFinite,
        }
    }
}
