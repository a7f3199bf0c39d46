//! The pixels of an OpenEXR file, decoded in place.
//!
//! `image` decodes them elsewhere and then copies them: twice the memory, and a third of the time.

use exr::prelude::{ReadChannels, ReadLayers, Vec2, read};
use image::{DynamicImage, ImageBuffer};

use super::openexr::is_in_colour;
use super::picture_file::PictureFile;

/// The picture of this size in a file, with alpha if present; none on any error, which is left to `image` to
/// report.
pub(super) fn decode(
    file: &mut PictureFile,
    (width, height): (u32, u32),
    has_alpha: bool,
) -> Option<DynamicImage> {
    let samples = samples(file, (width, height), if has_alpha { 4 } else { 3 })?;
    if has_alpha {
        ImageBuffer::from_raw(width, height, samples).map(DynamicImage::ImageRgba32F)
    } else {
        ImageBuffer::from_raw(width, height, samples).map(DynamicImage::ImageRgb32F)
    }
}

/// The first `count` samples of each pixel, red, green, blue and alpha, in an OpenEXR file's display window;
/// pixels beyond it are dropped.
fn samples(file: &mut PictureFile, (width, height): (u32, u32), count: usize) -> Option<Vec<f32>> {
    let (width, height) = (width as usize, height as usize);
    let file = exr::block::read(file, false).ok()?;
    let header = file.headers().iter().find(|header| is_in_colour(header))?;
    let (shown, data) =
        (header.shared_attributes.display_window.position, header.own_attributes.layer_position);
    let (left, top) = (shown.x() - data.x(), shown.y() - data.y());
    let black = move |_, _: &_| vec![0.0; width * height * count];
    let put = move |samples: &mut Vec<f32>, at: Vec2<usize>, (r, g, b, a): (f32, f32, f32, f32)| {
        let column = usize::try_from(at.to_i32().x() - left).ok().filter(|column| *column < width);
        let row = usize::try_from(at.to_i32().y() - top).ok().filter(|row| *row < height);
        let (Some(column), Some(row)) = (column, row) else { return };
        if let [red, green, blue, alpha @ ..] = &mut samples[(row * width + column) * count..][..count] {
            (*red, *green, *blue) = (r, g, b);
            alpha.iter_mut().for_each(|alpha| *alpha = a);
        }
    };
    let layers = read().no_deep_data().largest_resolution_level();
    let layers = layers.rgba_channels(black, put).first_valid_layer().all_attributes();
    let picture = layers.from_chunks(file).ok()?;
    Some(picture.layer_data.channel_data.pixels)
}
