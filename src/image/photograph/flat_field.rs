//! Corrects uneven light by a photograph of a white sheet.

use std::path::Path;

use super::orientation::Orientation;
use super::pixel::Pixel;
use super::{Photograph, camera_name};
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
        if sheet.info.is_developed() {
            let problem = format!("the flat field ({}) was developed for the eye", sheet.info.format);
            let remedy = "give its RAW file, or --undo, or --transfer if its numbers are the camera's own";
            return Err(Error::picture(path, problem, remedy));
        }
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
    pub fn photograph(&self) -> &Photograph {
        &self.sheet
    }

    /// The same, as if its camera had been held in this orientation.
    pub(super) fn held(&self, orientation: Orientation) -> Self {
        Self { sheet: Box::new(self.sheet.held(orientation)), ..*self }
    }

    /// What shows that it is of another sensor than a photograph: stored size, colours or camera.
    pub(super) fn unlike(&self, photograph: &Photograph) -> Option<String> {
        let both = [photograph, &self.sheet];
        let [size, own_size] = both.map(|one| one.info.stored_size());
        let [colours, own_colours] = both.map(Photograph::has_colours);
        let [model, own_model] = both.map(|one| one.info.camera.model.as_deref().map(str::to_lowercase));
        match () {
            () if size != own_size => {
                let [picture, sheet] = both.map(stored_as);
                Some(format!("the picture has {picture} as stored, the flat field {sheet}"))
            }
            () if colours != own_colours => {
                let [picture, sheet] =
                    [colours, own_colours].map(|any| if any { "in colour" } else { "grey" });
                Some(format!("the picture is {picture}, the flat field {sheet}"))
            }
            () if model.zip(own_model).is_some_and(|(model, own)| model != own) => {
                let [picture, sheet] = both.map(|one| one.info.camera.called());
                let named = |(make, model): (String, String)| camera_name(&make, &model);
                let (picture, sheet) = (named(picture), named(sheet));
                Some(format!("the picture was taken by {picture}, the flat field by {sheet}"))
            }
            () => None,
        }
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

/// `640 x 480 px, orientation 6`, the latter unless upright.
fn stored_as(photograph: &Photograph) -> String {
    let ((width, height), orientation) = (photograph.info.stored_size(), photograph.info.camera.orientation);
    let held = match orientation {
        Orientation::UPRIGHT => String::new(),
        other => format!(", orientation {}", other.exif()),
    };
    format!("{width} x {height} px{held}")
}
