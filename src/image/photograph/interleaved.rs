//! Pixels stored with interleaved colours.
//!
//! Samples remain as stored and are converted when a pixel is read: measuring a large picture costs little
//! more than decoding it.

use std::ops::Range;
use std::sync::Arc;

use image::DynamicImage;
use ndarray::{ArcArray, Array3, Ix3, ShapeError};
use rayon::prelude::*;

use super::orientation::Orientation;
use super::pixel::Pixel;
use crate::image::numbers::{Development, Scale};

/// Pixels of one colour or three, with or without alpha.
#[derive(Debug, Clone)]
pub(in crate::image) struct Interleaved {
    samples: Samples,
    /// Indices of red, green and blue among a pixel's samples, and of alpha if there is one.
    colours: [usize; 3],
    alpha: Option<usize>,
    /// For red, green and blue.
    scales: [Scale; 3],
    /// Linear light of every integer under those scales, with one table for equal scales; empty for floats.
    tables: [Arc<[f64]>; 3],
    development: Option<Development>,
}

/// Samples of the upright picture, by row, column and place in the pixel.
#[derive(Debug, Clone)]
enum Samples {
    U8(ArcArray<u8, Ix3>),
    U16(ArcArray<u16, Ix3>),
    F32(ArcArray<f32, Ix3>),
    /// Already linear light, infinite where clipped.
    Light(ArcArray<f32, Ix3>),
}

impl Interleaved {
    /// The pixels of a decoded picture, stored in this orientation, with the development to be undone.
    ///
    /// # Errors
    /// If the decoder returned another number of samples than the picture has.
    pub fn from_picture(
        picture: DynamicImage,
        orientation: Orientation,
        scale: Scale,
        development: Option<Development>,
    ) -> Result<Self, ShapeError> {
        let color = picture.color();
        let channels = usize::from(color.channel_count()) - usize::from(color.has_alpha());
        Ok(Self {
            samples: Samples::new(picture, orientation)?,
            colours: colours(channels),
            alpha: color.has_alpha().then_some(channels),
            scales: [scale; 3],
            tables: one_for_all(&scale),
            development,
        })
    }

    /// Pixels that are already linear light, by row, column and channel of the upright picture, infinite
    /// where clipped.
    pub fn from_light(light: Array3<f32>) -> Self {
        let (_, _, channels) = light.dim();
        Self {
            samples: Samples::Light(light.into_shared()),
            colours: colours(channels),
            alpha: None,
            scales: [Scale::LINEAR; 3],
            tables: one_for_all(&Scale::LINEAR),
            development: None,
        }
    }

    /// The same pixels, turned.
    pub fn turned(&self, by: Orientation) -> Self {
        Self { samples: self.samples.turned(by), ..self.clone() }
    }

    /// Number of colours per pixel, 1 or 3.
    pub fn channels(&self) -> usize {
        let [red, _, blue] = self.colours;
        blue - red + 1
    }

    /// Whether its numbers are already light, not those of a file.
    pub fn is_light(&self) -> bool {
        matches!(self.samples, Samples::Light(_))
    }

    /// The stored numbers of a colour in `columns` of row `y`, if finite and not clipped.
    pub fn stored(&self, colour: usize, columns: Range<usize>, y: usize) -> Vec<f32> {
        let at = |x: usize| [y, x, self.colours[colour]];
        let stored = |x: usize| match &self.samples {
            Samples::U8(stored) => stored[at(x)].into(),
            Samples::U16(stored) => stored[at(x)].into(),
            Samples::F32(stored) | Samples::Light(stored) => stored[at(x)],
        };
        let scale = &self.scales[colour];
        columns
            .map(stored)
            .filter(|stored| stored.is_finite() && !scale.is_clipped((*stored).into()))
            .collect()
    }

    /// Changes the scale of each colour.
    pub fn rescale(&mut self, change: impl Fn(usize, Scale) -> Scale) {
        self.scales = [0, 1, 2].map(|k| change(k, self.scales[k]));
        match &mut self.samples {
            // these are already light, each number by its own scale
            Samples::Light(light) => {
                let scales = self.scales;
                light.outer_iter_mut().into_par_iter().for_each(|mut row| {
                    for ((_, channel), light) in row.indexed_iter_mut().filter(|(_, light)| light.is_finite())
                    {
                        *light = scales[channel].linear((*light).into()) as f32;
                    }
                });
                self.scales = [Scale::LINEAR; 3];
            }
            _ => self.tables = [0, 1, 2].map(|k| self.scales[k].table().into()),
        }
    }

    /// Visits the pixels in `columns` of row `y` in order, with their columns.
    #[inline]
    pub fn visit(&self, columns: Range<usize>, y: usize, mut visitor: impl FnMut(usize, Pixel)) {
        match &self.development {
            None => self.visit_linear(columns, y, visitor),
            Some(development) => {
                self.visit_linear(columns, y, |x, pixel| visitor(x, pixel.undeveloped(development)));
            }
        }
    }

    #[inline]
    fn visit_linear(&self, columns: Range<usize>, y: usize, visitor: impl FnMut(usize, Pixel)) {
        let tables = self.tables.each_ref().map(|table| &**table);
        let integer = |k: usize, v: usize| tables[k][v];
        let float = |k: usize, v: f32| self.scales[k].linear(v.into());
        match &self.samples {
            Samples::U8(stored) => {
                self.visit_stored(stored, |k, v| integer(k, v.into()), columns, y, visitor);
            }
            Samples::U16(stored) => {
                self.visit_stored(stored, |k, v| integer(k, v.into()), columns, y, visitor);
            }
            Samples::F32(stored) => self.visit_stored(stored, float, columns, y, visitor),
            Samples::Light(light) => self.visit_stored(light, |_, v| v.into(), columns, y, visitor),
        }
    }

    #[inline]
    fn visit_stored<T: Copy + Into<f64>>(
        &self,
        stored: &ArcArray<T, Ix3>,
        linear: impl Fn(usize, T) -> f64,
        columns: Range<usize>,
        y: usize,
        mut visitor: impl FnMut(usize, Pixel),
    ) {
        for x in columns {
            let light = [0, 1, 2].map(|k| linear(k, stored[[y, x, self.colours[k]]]));
            let transparent = self.alpha.is_some_and(|alpha| stored[[y, x, alpha]].into() <= 0.0);
            visitor(x, Pixel::new(light, transparent));
        }
    }
}

fn one_for_all(scale: &Scale) -> [Arc<[f64]>; 3] {
    let table: Arc<[f64]> = scale.table().into();
    [table.clone(), table.clone(), table]
}

/// Indices of red, green and blue in a pixel of this many channels.
fn colours(channels: usize) -> [usize; 3] {
    [0, 1, 2].map(|channel| channel.min(channels - 1))
}

impl Samples {
    fn new(picture: DynamicImage, orientation: Orientation) -> Result<Self, ShapeError> {
        let per_pixel = usize::from(picture.color().channel_count());
        let shape = (picture.height() as usize, picture.width() as usize, per_pixel);
        let u8s = |samples| ArcArray::from_shape_vec(shape, samples).map(Self::U8);
        let u16s = |samples| ArcArray::from_shape_vec(shape, samples).map(Self::U16);
        let f32s = |samples| ArcArray::from_shape_vec(shape, samples).map(Self::F32);
        let stored = match picture {
            DynamicImage::ImageLuma8(buffer) => u8s(buffer.into_raw()),
            DynamicImage::ImageLumaA8(buffer) => u8s(buffer.into_raw()),
            DynamicImage::ImageRgb8(buffer) => u8s(buffer.into_raw()),
            DynamicImage::ImageRgba8(buffer) => u8s(buffer.into_raw()),
            DynamicImage::ImageLuma16(buffer) => u16s(buffer.into_raw()),
            DynamicImage::ImageLumaA16(buffer) => u16s(buffer.into_raw()),
            DynamicImage::ImageRgb16(buffer) => u16s(buffer.into_raw()),
            DynamicImage::ImageRgba16(buffer) => u16s(buffer.into_raw()),
            DynamicImage::ImageRgba32F(buffer) => f32s(buffer.into_raw()),
            other => f32s(other.into_rgb32f().into_raw()),
        };
        Ok(stored?.turned(orientation))
    }

    /// The same samples, turned; they stay where they are in memory.
    fn turned(&self, by: Orientation) -> Self {
        match self {
            Self::U8(samples) => Self::U8(by.upright(samples.clone())),
            Self::U16(samples) => Self::U16(by.upright(samples.clone())),
            Self::F32(samples) => Self::F32(by.upright(samples.clone())),
            Self::Light(samples) => Self::Light(by.upright(samples.clone())),
        }
    }
}
