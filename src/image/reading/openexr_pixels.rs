//! The pixels of an OpenEXR file, decoded in place.
//!
//! `image` decodes them elsewhere and then copies them: twice the memory, and a third of the time.

use std::io::{BufRead, Seek};

use exr::prelude::{ReadChannels, ReadLayers, Vec2, read};
use image::{DynamicImage, ImageBuffer};

use super::openexr::is_in_colour;

/// The picture of this size in a file, with alpha if present; none on any error, which is left to `image` to
/// report.
pub(super) fn decode(
    file: impl BufRead + Seek,
    (width, height): (u32, u32),
    has_alpha: bool,
) -> Option<DynamicImage> {
    if has_alpha {
        let rgba = samples(file, (width, height), |(r, g, b, a)| [r, g, b, a])?;
        ImageBuffer::from_raw(width, height, rgba).map(DynamicImage::ImageRgba32F)
    } else {
        let rgb = samples(file, (width, height), |(r, g, b, _)| [r, g, b])?;
        ImageBuffer::from_raw(width, height, rgb).map(DynamicImage::ImageRgb32F)
    }
}

/// The samples in an OpenEXR file's display window; pixels beyond it are dropped.
fn samples<const N: usize>(
    file: impl BufRead + Seek,
    (width, height): (u32, u32),
    of_pixel: impl Fn((f32, f32, f32, f32)) -> [f32; N] + 'static,
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
            pixels[row * width + column] = of_pixel(stored);
        }
    };
    let layers = read().no_deep_data().largest_resolution_level();
    let layers = layers.rgba_channels(black, put).first_valid_layer().all_attributes();
    let picture = layers.from_chunks(file).ok()?;
    Some(picture.layer_data.channel_data.pixels.into_flattened())
}
