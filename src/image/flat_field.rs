//! Uneven light, undone with a photograph of a white sheet.

use std::path::Path;

use super::photograph::Photograph;
use super::pixel::Pixel;
use crate::{Error, Result};

/// A photograph of an evenly coloured sheet: where the light falls, and what the lens takes from it towards the corners.
#[derive(Debug, Clone)]
pub struct FlatField {
    photograph: Photograph,
    /// One over the mean light per channel.
    per_mean: [f64; 3],
}

impl FlatField {
    /// The flat field in a photograph; `path` is for errors.
    ///
    /// # Errors
    /// [`Error::Picture`] if more than half of its pixels cannot be used, or a channel has no light.
    ///
    /// # Example
    /// ```
    /// use vfold::image::{FlatField, Photograph, Pixel, ReadOptions, write_linear};
    /// let folder = tempfile::tempdir().unwrap();
    /// let path = folder.path().join("two.exr");
    /// write_linear(&path, 2, 1, &[0.25, 0.25, 0.25, 0.75, 0.75, 0.75])?; // mean 0.5
    /// let photograph = Photograph::open(&path, &ReadOptions::default())?;
    /// let flat = FlatField::new(photograph.clone(), &path)?;
    /// assert_eq!(photograph.with_flat_field(flat.into(), &path)?.pixel(0, 0), Pixel::Light([0.5; 3]));
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(photograph: Photograph, path: &Path) -> Result<Self> {
        let (width, height) = (photograph.width(), photograph.height());
        let (mut seen, mut counts, mut sums) = (0, [0.0; 3], [0.0; 3]);
        for layer in photograph.layers() {
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
        Ok(Self { photograph, per_mean: [0, 1, 2].map(|channel| counts[channel] / sums[channel]) })
    }

    /// Width and height, px.
    pub(super) fn size(&self) -> [usize; 2] {
        [self.photograph.width(), self.photograph.height()]
    }

    /// A pixel as even light would have shown it.
    pub(super) fn divide(&self, x: usize, y: usize, pixel: Pixel) -> Pixel {
        match (pixel, self.photograph.pixel(x, y)) {
            (Pixel::Light(light), Pixel::Light(flat)) if flat.iter().all(|flat| *flat > 0.0) => {
                Pixel::Light([0, 1, 2].map(|k| light[k] / (flat[k] * self.per_mean[k])))
            }
            (Pixel::Clipped, _) | (_, Pixel::Clipped) => Pixel::Clipped,
            _ => Pixel::NotFinite,
        }
    }
}
