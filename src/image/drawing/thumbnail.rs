//! Small copies of pictures, for reports.

use std::io::{self, Seek};
use std::path::Path;

use image::codecs::jpeg::JpegEncoder;
use image::imageops::FilterType;
use image::{DynamicImage, ImageReader};

use super::preview::CAPTION_KEYWORD;
use crate::image::reading::PictureFile;
use crate::{Error, Result};

/// Quality of the JPEG, out of 100: thin lines stay clean.
const QUALITY: u8 = 88;

/// A JPEG.
#[derive(Clone, Debug)]
pub struct Thumbnail {
    /// Its bytes.
    pub jpeg: Vec<u8>,
    /// Width, px.
    pub width: u32,
    /// Height, px.
    pub height: u32,
    /// The caption of a PNG that vfold made.
    pub caption: Option<String>,
}

/// Reads a picture for the eye, PNG, JPEG or TIFF, and makes a JPEG of it with sides of at most `longest_px`.
///
/// # Errors
/// [`Error::File`] if the file cannot be read, [`Error::Picture`] if it is no picture.
///
/// # Example
/// ```
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("grey.png");
/// vfold::image::write_srgb_png(&path, 40, 20, &[0.5; 40 * 20 * 3])?;
/// let small = vfold::image::thumbnail(&path, 10)?;
/// assert_eq!((small.width, small.height), (10, 5));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn thumbnail(path: &Path, longest_px: u32) -> Result<Thumbnail> {
    let unreadable = |error: image::ImageError| Error::picture(path, error, "give a PNG, JPEG or TIFF");
    let no_file = |source| Error::file(path.display(), source);
    // opening a named pipe could block for ever
    if !path.metadata().map_err(no_file)?.is_file() {
        return Err(no_file(io::Error::other("not a regular file")));
    }
    let mut file = PictureFile::open(path)?;
    let caption = caption(&mut file);
    file.rewind().map_err(no_file)?;
    let reader = ImageReader::new(&mut file).with_guessed_format().map_err(no_file)?;
    let picture = reader.decode().map_err(unreadable)?;
    let picture = if picture.width().max(picture.height()) > longest_px {
        picture.resize(longest_px, longest_px, FilterType::Triangle)
    } else {
        picture
    };
    let rgb = DynamicImage::ImageRgb8(picture.to_rgb8());
    let mut jpeg = Vec::new();
    rgb.write_with_encoder(JpegEncoder::new_with_quality(&mut jpeg, QUALITY)).map_err(unreadable)?;
    Ok(Thumbnail { jpeg, width: rgb.width(), height: rgb.height(), caption })
}

/// The caption in the text chunks of a PNG; none in other files.
fn caption(file: &mut PictureFile) -> Option<String> {
    let png = png::Decoder::new(file).read_info().ok()?;
    let text = png.info().utf8_text.iter().find(|text| text.keyword == CAPTION_KEYWORD)?;
    text.get_text().ok()
}
