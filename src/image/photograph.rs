//! A photograph as linear light, pixel by pixel.
//!
//! The samples stay as they were stored and become numbers only when a pixel is read: measuring a large picture
//! costs little more than decoding it.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use image::{DynamicImage, ImageFormat};

use super::decode::{Decoded, decode};
use super::exif::CameraNotes;
use super::flat_field::FlatField;
use super::orientation::{Layout, Orientation};
use super::scale::{ReadOptions, Scale};
use super::transfer::Transfer;
use crate::{Error, Result};

/// What is known about a photograph besides its pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct PhotographInfo {
    /// The camera's maker.
    pub make: Option<String>,
    /// The camera.
    pub model: Option<String>,
    /// Exposure time, s.
    pub exposure_s: Option<f64>,
    /// Focal length over aperture.
    pub f_number: Option<f64>,
    /// ISO sensitivity.
    pub iso: Option<u32>,
    /// How the picture was stored; coordinates are those of the upright picture.
    pub orientation: Orientation,
    /// Width of the upright picture, px.
    pub width: usize,
    /// Height of the upright picture, px.
    pub height: usize,
    /// File format, depth and colours as stored: `TIFF, 16-bit, RGB`.
    pub format: String,
    /// The curve that was undone, [`Transfer::Linear`] or [`Transfer::Srgb`].
    pub transfer_used: Transfer,
    /// The stored number taken as no light.
    pub black_level: f64,
    /// The stored number taken as 1.
    pub white_level: f64,
    /// What was wrong but did no harm.
    pub notes: Vec<String>,
}

impl PhotographInfo {
    fn new(camera: CameraNotes, stored_size: (usize, usize), format: String, scale: &Scale) -> Self {
        let (width, height) = camera.orientation.upright_size(stored_size);
        Self {
            make: camera.make,
            model: camera.model,
            exposure_s: camera.exposure_s,
            f_number: camera.f_number,
            iso: camera.iso,
            orientation: camera.orientation,
            width,
            height,
            format,
            transfer_used: scale.transfer,
            black_level: scale.black,
            white_level: scale.white,
            notes: camera.notes,
        }
    }
}

/// What a pixel says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pixel {
    /// Linear light, 1 at the white level; a grey picture gives three equal numbers.
    Light([f64; 3]),
    /// A channel is at or above the white level: the light may have been anything brighter.
    Clipped,
    /// A channel is NaN or infinite, or the pixel is fully transparent.
    NotFinite,
}

/// A decoded photograph, seen upright.
#[derive(Debug, Clone)]
pub struct Photograph {
    samples: Samples,
    layout: Layout,
    /// Colours a pixel, 1 or 3.
    channels: usize,
    /// Samples a pixel.
    stride: usize,
    /// Where red, green and blue are among a pixel's samples, and alpha if there is one.
    colours: [usize; 3],
    alpha: Option<usize>,
    scale: Scale,
    /// Linear light of every integer; empty for floats.
    table: Vec<f64>,
    flat_field: Option<Arc<FlatField>>,
    info: PhotographInfo,
}

/// Samples as stored, row by row.
#[derive(Debug, Clone)]
enum Samples {
    U8(Vec<u8>),
    U16(Vec<u16>),
    F32(Vec<f32>),
}

impl Photograph {
    /// Reads a PNG, TIFF, JPEG or OpenEXR file: 8-bit, 16-bit or float, grey or RGB, with or without alpha.
    ///
    /// The content, not the name, tells the format. Alpha is dropped, except that a fully transparent pixel counts as
    /// missing. The picture is turned upright by its EXIF orientation. At most 2 GiB decoded and 65536 px a side.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) if the file cannot be read, [`Error::Picture`](crate::Error::Picture) if it
    /// is no picture, damaged, cut short, empty or too large, [`Error::Usage`](crate::Error::Usage) if the white level
    /// is not above the black level.
    ///
    /// # Example
    /// ```
    /// use vfold::image::{Photograph, Pixel, ReadOptions, write_linear};
    /// let folder = tempfile::tempdir().unwrap();
    /// let path = folder.path().join("pixel.exr");
    /// write_linear(&path, 1, 1, &[0.25, 0.5, 2.0])?;
    /// let photograph = Photograph::open(&path, &ReadOptions::default())?;
    /// assert_eq!(photograph.pixel(0, 0), Pixel::Light([0.25, 0.5, 2.0]));
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn open(path: &Path, options: &ReadOptions) -> Result<Self> {
        let Decoded { format, picture, camera } = decode(path)?;
        let color = picture.color();
        let stride = usize::from(color.channel_count());
        let channels = stride - usize::from(color.has_alpha());
        let bits = u32::from(color.bits_per_pixel()) / u32::from(color.channel_count());
        let scale = Scale::new(options, bits)?;
        let stored_size = (picture.width() as usize, picture.height() as usize);
        let format = describe(format, bits, color.has_color());
        Ok(Self {
            samples: Samples::from(picture),
            layout: camera.orientation.layout(stored_size),
            channels,
            stride,
            colours: [0, 1, 2].map(|channel| channel.min(channels - 1)),
            alpha: color.has_alpha().then_some(channels),
            table: scale.table(bits),
            flat_field: None,
            info: PhotographInfo::new(camera, stored_size, format, &scale),
            scale,
        })
    }

    /// The same photograph in even light: each pixel over that of a flat field, whose mean counts as 1; `path` is for errors.
    ///
    /// # Errors
    /// [`Error::Picture`] if the flat field has another size.
    pub fn with_flat_field(self, flat_field: Arc<FlatField>, path: &Path) -> Result<Self> {
        let ([w, h], [width, height]) = (flat_field.size(), [self.width(), self.height()]);
        if [w, h] != [width, height] {
            let problem = format!("the picture has {width} x {height} px, the flat field {w} x {h}");
            return Err(Error::picture(path, problem, "take both with the same camera and framing"));
        }
        Ok(Self { flat_field: Some(flat_field), ..self })
    }

    /// Width of the upright picture, px.
    #[must_use]
    pub fn width(&self) -> usize {
        self.info.width
    }

    /// Height of the upright picture, px.
    #[must_use]
    pub fn height(&self) -> usize {
        self.info.height
    }

    /// Colours of a pixel: 3, or 1 for a grey picture.
    #[must_use]
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// What is known about the photograph besides its pixels.
    #[must_use]
    pub fn info(&self) -> &PhotographInfo {
        &self.info
    }

    /// The pixel in column `x` and row `y` of the upright picture, both below its size.
    #[must_use]
    pub fn pixel(&self, x: usize, y: usize) -> Pixel {
        let mut pixel = Pixel::NotFinite;
        self.visit(x..x + 1, y, |_, seen| pixel = seen);
        pixel
    }

    /// Shows the pixels in `columns` of row `y` one after another, with their columns.
    #[inline]
    pub(super) fn visit(&self, columns: Range<usize>, y: usize, mut visitor: impl FnMut(usize, Pixel)) {
        match &self.flat_field {
            None => self.visit_uneven(columns, y, visitor),
            Some(flat) => self.visit_uneven(columns, y, |x, pixel| visitor(x, flat.divide(x, y, pixel))),
        }
    }

    #[inline]
    fn visit_uneven(&self, columns: Range<usize>, y: usize, visitor: impl FnMut(usize, Pixel)) {
        let integer = |v: usize| self.table[v];
        let float = |v: f32| self.scale.linear(v.into());
        match &self.samples {
            Samples::U8(stored) => self.visit_stored(stored, |v| integer(v.into()), columns, y, visitor),
            Samples::U16(stored) => self.visit_stored(stored, |v| integer(v.into()), columns, y, visitor),
            Samples::F32(stored) => self.visit_stored(stored, float, columns, y, visitor),
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

impl Pixel {
    #[inline]
    fn new(light: [f64; 3], transparent: bool) -> Self {
        let [r, g, b] = light;
        // one test for the many good pixels: a clipped channel is infinite
        if (r + g + b).is_finite() && !transparent {
            Self::Light(light)
        } else if transparent || light.iter().any(|y| y.is_nan()) {
            Self::NotFinite
        } else {
            Self::Clipped
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

fn describe(format: ImageFormat, bits: u32, colour: bool) -> String {
    let name = match format {
        ImageFormat::Png => "PNG",
        ImageFormat::Tiff => "TIFF",
        ImageFormat::Jpeg => "JPEG",
        _ => "OpenEXR",
    };
    let samples = if bits == 32 { "float".to_owned() } else { format!("{bits}-bit") };
    format!("{name}, {samples}, {}", if colour { "RGB" } else { "grey" })
}
