//! Pixels stored with their colours side by side.
//!
//! The samples stay as they were stored and become numbers only when a pixel is read: measuring a large picture
//! costs little more than decoding it.

use std::ops::Range;

use image::DynamicImage;

use super::orientation::Layout;
use super::pixel::Pixel;
use crate::image::numbers::{Development, Scale};

/// Pixels of one colour or three, with or without alpha.
#[derive(Debug, Clone)]
pub(in crate::image) struct Interleaved {
    samples: Samples,
    layout: Layout,
    /// Samples per pixel.
    stride: usize,
    /// Where red, green and blue are among a pixel's samples, and alpha if there is one.
    colours: [usize; 3],
    alpha: Option<usize>,
    scale: Scale,
    /// Linear light of every integer; empty for floats.
    table: Vec<f64>,
    development: Option<Development>,
}

/// Samples, row by row.
#[derive(Debug, Clone)]
enum Samples {
    U8(Vec<u8>),
    U16(Vec<u16>),
    F32(Vec<f32>),
    /// Linear light already, infinite where it is clipped.
    Light(Vec<f32>),
}

impl Interleaved {
    /// The pixels of a decoded picture, and what was done to them that is to be undone.
    pub fn from_picture(
        picture: DynamicImage,
        layout: Layout,
        scale: Scale,
        development: Option<Development>,
    ) -> Self {
        let color = picture.color();
        let stride = usize::from(color.channel_count());
        let channels = stride - usize::from(color.has_alpha());
        Self {
            table: scale.table(),
            samples: Samples::from(picture),
            layout,
            stride,
            colours: [0, 1, 2].map(|channel| channel.min(channels - 1)),
            alpha: color.has_alpha().then_some(channels),
            scale,
            development,
        }
    }

    /// Pixels of `channels` numbers each that are linear light already, infinite where it is clipped.
    pub fn from_light(light: Vec<f32>, layout: Layout, channels: usize) -> Self {
        Self {
            samples: Samples::Light(light),
            layout,
            stride: channels,
            colours: [0, 1, 2].map(|channel| channel.min(channels - 1)),
            alpha: None,
            scale: Scale::LINEAR,
            table: Vec::new(),
            development: None,
        }
    }

    /// Colours of a pixel, 1 or 3.
    pub fn channels(&self) -> usize {
        self.stride - usize::from(self.alpha.is_some())
    }

    /// Shows the pixels in `columns` of row `y` one after another, with their columns.
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
        let integer = |v: usize| self.table[v];
        let float = |v: f32| self.scale.linear(v.into());
        match &self.samples {
            Samples::U8(stored) => self.visit_stored(stored, |v| integer(v.into()), columns, y, visitor),
            Samples::U16(stored) => self.visit_stored(stored, |v| integer(v.into()), columns, y, visitor),
            Samples::F32(stored) => self.visit_stored(stored, float, columns, y, visitor),
            Samples::Light(light) => self.visit_stored(light, f64::from, columns, y, visitor),
        }
    }

    #[inline]
    fn visit_stored<T: Copy + Into<f64>>(
        &self,
        stored: &[T],
        linear: impl Fn(T) -> f64,
        columns: Range<usize>,
        y: usize,
        mut visitor: impl FnMut(usize, Pixel),
    ) {
        for x in columns {
            let first = self.layout.stored(x, y) * self.stride;
            let channel = |k: usize| linear(stored[first + self.colours[k]]);
            let light = [channel(0), channel(1), channel(2)];
            let transparent = self.alpha.is_some_and(|offset| stored[first + offset].into() <= 0.0);
            visitor(x, Pixel::new(light, transparent));
        }
    }
}

impl From<DynamicImage> for Samples {
    fn from(picture: DynamicImage) -> Self {
        match picture {
            DynamicImage::ImageLuma8(buffer) => Self::U8(buffer.into_raw()),
            DynamicImage::ImageLumaA8(buffer) => Self::U8(buffer.into_raw()),
            DynamicImage::ImageRgb8(buffer) => Self::U8(buffer.into_raw()),
            DynamicImage::ImageRgba8(buffer) => Self::U8(buffer.into_raw()),
            DynamicImage::ImageLuma16(buffer) => Self::U16(buffer.into_raw()),
            DynamicImage::ImageLumaA16(buffer) => Self::U16(buffer.into_raw()),
            DynamicImage::ImageRgb16(buffer) => Self::U16(buffer.into_raw()),
            DynamicImage::ImageRgba16(buffer) => Self::U16(buffer.into_raw()),
            DynamicImage::ImageRgba32F(buffer) => Self::F32(buffer.into_raw()),
            other => Self::F32(other.into_rgb32f().into_raw()),
        }
    }
}
