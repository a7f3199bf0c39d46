//! Picture output: linear light for simulated photographs, 8 bits for the eye.
//!
//! A picture is written under a temporary name in the same folder and renamed when complete, so an
//! interrupted run leaves the old file or none.

use std::io::{BufWriter, Write};
use std::path::Path;

use super::for_the_eye::{MARK, MARK_KEYWORDS};
use crate::files::Saved;
use crate::{Error, Result};
use image::{DynamicImage, ImageBuffer, ImageFormat, Rgb};

/// Writes linear RGB as OpenEXR (32-bit float) or 16-bit TIFF or PNG, chosen by the file extension.
///
/// # Arguments
/// - `rgb`: row by row from the top, three numbers per pixel; integer formats store `round(65535 * value)`,
///   clipped to [0, 1].
///
/// # Errors
/// [`Error::Picture`] for another extension, a number that is not finite in single precision, or a count of
/// numbers other than width x height x 3; [`Error::File`] if the file cannot be written.
///
/// # Example
/// ```
/// use vfold::image::{Photograph, Pixel, ReadOptions, write_linear};
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("pixel.tif");
/// write_linear(&path, 1, 1, &[-0.1, 0.2, 0.6])?;
/// let photograph = Photograph::open(&path, &ReadOptions::default())?;
/// assert_eq!(photograph.pixel(0, 0), Pixel::Light([0.0, 0.2, 0.6])); // 65535 is a multiple of 5
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn write_linear(path: &Path, width: usize, height: usize, rgb: &[f64]) -> Result<()> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("exr") => {
            let buffer = buffer(path, width, height, rgb, |value| value as f32)?;
            save(path, &DynamicImage::ImageRgb32F(buffer), ImageFormat::OpenExr)
        }
        Some("tif" | "tiff") => save(path, &sixteen_bits(path, width, height, rgb)?, ImageFormat::Tiff),
        Some("png") => save(path, &sixteen_bits(path, width, height, rgb)?, ImageFormat::Png),
        _ => Err(Error::picture(path, "its ending is not known", "end the name in .exr, .tif or .png")),
    }
}

/// Writes RGB already encoded for display, in [0, 1], as 8-bit PNG marked as made for the eye; other values
/// are clipped.
///
/// # Errors
/// As [`write_linear`], whatever the extension.
///
/// # Example
/// ```
/// use vfold::image::write_srgb_png;
/// let folder = tempfile::tempdir().unwrap();
/// write_srgb_png(&folder.path().join("grey.png"), 1, 1, &[0.5, 0.5, 0.5])?;
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn write_srgb_png(path: &Path, width: usize, height: usize, rgb: &[f64]) -> Result<()> {
    write_srgb_png_with_texts(path, [width, height], rgb, Texts::default())
}

/// Bytes of a PNG of RGB already encoded for display, 8 bits per number.
///
/// # Errors
/// [`Error::Picture`] if the count of numbers is 0 or not width x height x 3.
///
/// # Example
/// ```
/// assert!(vfold::image::png_bytes(2, 1, vec![0, 0, 0, 255, 255, 255])?.starts_with(b"\x89PNG"));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn png_bytes(width: u32, height: u32, rgb: Vec<u8>) -> Result<Vec<u8>> {
    let failed = |problem: String| Error::picture(Path::new("drawing"), problem, "draw at least one pixel");
    let count = rgb.len();
    let picture: ImageBuffer<Rgb<u8>, _> = ImageBuffer::from_vec(width, height, rgb)
        .filter(|_| count > 0)
        .ok_or_else(|| failed(format!("{count} numbers do not fill {width} x {height} RGB pixels")))?;
    let mut png = Vec::new();
    encode_for_the_eye(&mut png, &picture, Texts::default()).map_err(|error| failed(error.to_string()))?;
    Ok(png)
}

/// Texts of a PNG in addition to the mark: one keyword with ASCII text, and keywords with texts in any
/// script.
#[derive(Default)]
pub(super) struct Texts<'a> {
    pub plain: Option<(&'a str, String)>,
    pub international: Vec<(&'a str, String)>,
}

/// As [`write_srgb_png`], with texts.
pub(super) fn write_srgb_png_with_texts(
    path: &Path,
    [width, height]: [usize; 2],
    rgb: &[f64],
    texts: Texts,
) -> Result<()> {
    let failed = |error| match error {
        png::EncodingError::IoError(source) => Error::file(path.display(), source),
        other => Error::picture(path, other, "write another format"),
    };
    let picture = eight_bits(path, width, height, rgb)?;
    let mut saved = Saved::new(path)?;
    encode_for_the_eye(BufWriter::new(saved.file_mut()), &picture, texts).map_err(failed)?;
    saved.keep()
}

/// Writes a PNG marked as sRGB and as made for the eye.
fn encode_for_the_eye(
    out: impl Write,
    picture: &ImageBuffer<Rgb<u8>, Vec<u8>>,
    texts: Texts,
) -> std::result::Result<(), png::EncodingError> {
    let mut encoder = png::Encoder::new(out, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let marks = MARK_KEYWORDS.map(|keyword| (keyword, MARK.to_owned()));
    for (keyword, text) in marks.into_iter().chain(texts.plain) {
        encoder.add_text_chunk(keyword.to_owned(), text)?;
    }
    for (keyword, text) in texts.international {
        encoder.add_itxt_chunk(keyword.to_owned(), text)?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(picture.as_raw())?;
    writer.finish()
}

fn eight_bits(
    path: &Path,
    width: usize,
    height: usize,
    rgb: &[f64],
) -> Result<ImageBuffer<Rgb<u8>, Vec<u8>>> {
    // `as` clamps to the integer's range
    buffer(path, width, height, rgb, |value| (value * 255.0).round() as u8)
}

fn sixteen_bits(path: &Path, width: usize, height: usize, rgb: &[f64]) -> Result<DynamicImage> {
    buffer(path, width, height, rgb, |value| (value * 65535.0).round() as u16).map(DynamicImage::ImageRgb16)
}

fn buffer<T: image::Primitive>(
    path: &Path,
    width: usize,
    height: usize,
    rgb: &[f64],
    store: impl Fn(f64) -> T,
) -> Result<ImageBuffer<Rgb<T>, Vec<T>>>
where
    Rgb<T>: image::Pixel<Subpixel = T>,
{
    // pictures hold single precision at most
    if let Some(k) = rgb.iter().position(|value| !(*value as f32).is_finite()) {
        let problem = format!("number {k} of the picture's RGB is {}", rgb[k]);
        return Err(Error::picture(path, problem, "look for zero, infinite or huge input"));
    }
    let size = (u32::try_from(width).ok().zip(u32::try_from(height).ok()))
        .filter(|_| width * height * 3 == rgb.len());
    size.filter(|_| !rgb.is_empty())
        .and_then(|(width, height)| {
            ImageBuffer::from_vec(width, height, rgb.iter().map(|&value| store(value)).collect())
        })
        .ok_or_else(|| {
            let problem = format!("{} numbers do not fill {width} x {height} RGB pixels", rgb.len());
            Error::picture(path, problem, "give a picture of at least one pixel")
        })
}

fn save(path: &Path, picture: &DynamicImage, format: ImageFormat) -> Result<()> {
    let failed = |source: std::io::Error| Error::file(path.display(), source);
    let mut saved = Saved::new(path)?;
    let mut out = BufWriter::new(saved.file_mut());
    picture.write_to(&mut out, format).map_err(|error| match error {
        image::ImageError::IoError(source) => failed(source),
        other => Error::picture(path, other, "write another format"),
    })?;
    out.flush().map_err(failed)?; // a full disk would go unnoticed when dropped
    drop(out);
    saved.keep()
}
