//! Pixels decoded to where they stay.
//!
//! `image` has TIFF and OpenEXR files decoded elsewhere and then copies the pixels: twice the memory, and a third of the time. Most
//! files can do without.

use std::io::{BufRead, Seek};

use exr::prelude::{ReadChannels, ReadLayers, Vec2, read};
use image::error::{UnsupportedError, UnsupportedErrorKind};
use image::{ColorType, DynamicImage, ImageBuffer, ImageDecoder, ImageError, ImageFormat, ImageResult};
use tiff::decoder::{Decoder, Limits};

use super::openexr::is_in_colour;

/// What a TIFF decoder may take besides the picture itself, bytes.
const MAX_BESIDES: usize = 2 << 30;

/// The picture in a file that `image` takes for one of such a size and such colours.
///
/// None if its pixels must be put in order first, or something is wrong with it: both are left to `image`.
pub(super) fn decode(
    file: impl BufRead + Seek,
    format: ImageFormat,
    dimensions: (u32, u32),
    color_type: ColorType,
) -> Option<DynamicImage> {
    match format {
        ImageFormat::Tiff => DynamicImage::from_decoder(Tiff { file, dimensions, color_type }).ok(),
        ImageFormat::OpenExr if color_type.has_alpha() => {
            let (width, height) = dimensions;
            let rgba = open_exr(file, dimensions, |(r, g, b, a)| [r, g, b, a])?;
            ImageBuffer::from_raw(width, height, rgba).map(DynamicImage::ImageRgba32F)
        }
        ImageFormat::OpenExr => {
            let (width, height) = dimensions;
            let rgb = open_exr(file, dimensions, |(r, g, b, _)| [r, g, b])?;
            ImageBuffer::from_raw(width, height, rgb).map(DynamicImage::ImageRgb32F)
        }
        _ => None,
    }
}

struct Tiff<R> {
    file: R,
    dimensions: (u32, u32),
    color_type: ColorType,
}

impl<R: BufRead + Seek> ImageDecoder for Tiff<R> {
    fn dimensions(&self) -> (u32, u32) {
        self.dimensions
    }

    fn color_type(&self) -> ColorType {
        self.color_type
    }

    fn read_image(self, pixels: &mut [u8]) -> ImageResult<()> {
        let mut limits = Limits::unlimited();
        limits.intermediate_buffer_size = MAX_BESIDES;
        let mut decoder = Decoder::new(self.file).map_err(left_to_image)?.with_limits(limits);
        // colours that are stored one after another, or several pixels to a byte
        if decoder.image_buffer_layout().map_err(left_to_image)?.len != pixels.len() {
            return Err(left_to_image("the pixels are stored in another order"));
        }
        decoder.read_image_bytes(pixels).map_err(left_to_image)
    }

    fn read_image_boxed(self: Box<Self>, pixels: &mut [u8]) -> ImageResult<()> {
        (*self).read_image(pixels)
    }
}

fn left_to_image(why: impl ToString) -> ImageError {
    let kind = UnsupportedErrorKind::GenericFeature(why.to_string());
    ImageError::Unsupported(UnsupportedError::from_format_and_kind(ImageFormat::Tiff.into(), kind))
}

/// The samples of what an OpenEXR file shows; pixels beyond are left out.
fn open_exr<const N: usize>(
    file: impl BufRead + Seek,
    (width, height): (u32, u32),
    samples: impl Fn((f32, f32, f32, f32)) -> [f32; N] + 'static,
) -> Option<Vec<f32>> {
    let (width, height) = (width as usize, height as usize);
    let file = exr::block::read(file, false).ok()?;
    let header = file.headers().iter().find(|header| is_in_colour(header))?;
    let (shown, data) =
        (header.shared_attributes.display_window.position, header.own_attributes.layer_position);
    let (left, top) = (shown.x() - data.x(), shown.y() - data.y());
    let black = move |_, _: &_| vec![[0.0; N]; width * height];
    let put = move |pixels: &mut Vec<[f32; N]>, at: Vec2<usize>, stored: (f32, f32, f32, f32)| {
        let column = usize::try_from(at.to_i32().x() - left).ok().filter(|column| *column < width);
        let row = usize::try_from(at.to_i32().y() - top).ok().filter(|row| *row < height);
        if let (Some(column), Some(row)) = (column, row) {
            pixels[row * width + column] = samples(stored);
        }
    };
    let layers = read().no_deep_data().largest_resolution_level();
    let layers = layers.rgba_channels(black, put).first_valid_layer().all_attributes();
    let picture = layers.from_chunks(file).ok()?;
    Some(picture.layer_data.channel_data.pixels.into_flattened())
}
