//! From the bytes of a picture file to stored samples, whatever the file turns out to be.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};

use super::exif;
use crate::image::photograph::CameraNotes;
use crate::{Error, Result};

/// What a file turned out to hold.
pub(super) enum Decoded {
    Picture(Box<Picture>),
    /// A camera's RAW file, which was not decoded.
    Raw,
}

/// A picture as it is stored, not yet turned upright, with what the camera wrote beside it.
pub(super) struct Picture {
    pub format: ImageFormat,
    pub pixels: DynamicImage,
    pub camera: CameraNotes,
}

/// Largest picture, decoded, and largest file: 2 GiB, some 350 megapixels of 16-bit RGB.
pub(super) const MAX_BYTES: u64 = 2 << 30;
/// Largest width and height, px.
const MAX_SIDE: u32 = 1 << 16;
/// Bytes of a picture that one byte of a file may stand for: deflate makes at most 1032 of one, other compressions fewer than these.
const MAX_COMPRESSION: u64 = 1 << 16;

pub(super) const TOO_LARGE: &str = "crop the picture to the sheet";
pub(super) const DAMAGED: &str = "the file is damaged or cut short: copy it again";
const RESAVE: &str = "save it again as PNG, TIFF, JPEG or OpenEXR, RGB or grey";

/// Reads and decodes a picture file; the content, not the name, says which format it is.
pub(super) fn decode(path: &Path) -> Result<Decoded> {
    let failed = |source| Error::file(path.display(), source);
    let file = File::open(path).map_err(failed)?;
    let length = file.metadata().map_err(failed)?.len();
    if length > MAX_BYTES {
        return Err(Error::picture(path, "the file is larger than 2 GiB", TOO_LARGE));
    }
    let mut file = BufReader::new(file);
    let head = file.fill_buf().map_err(failed)?;
    if head.is_empty() {
        return Err(Error::picture(path, "the file is empty", "copy it again"));
    }
    if begins_like_raw(head) {
        return Ok(Decoded::Raw);
    }
    let format = image::guess_format(head).ok().filter(is_supported);
    let format =
        format.ok_or_else(|| Error::picture(path, "not a PNG, TIFF, JPEG or OpenEXR picture", RESAVE))?;
    if format != ImageFormat::Tiff {
        let (pixels, block) = decode_as(path, &mut file, length, format)?;
        if format == ImageFormat::Jpeg && !jpeg_is_complete(&mut file).map_err(failed)? {
            return Err(Error::picture(path, "the JPEG data ends too early", "copy the file again"));
        }
        let camera = exif::read(block);
        return Ok(Decoded::Picture(Box::new(Picture { format, pixels, camera })));
    }
    let camera = exif::read(Some(exif::tiff_tags(&mut file).map_err(failed)?));
    if camera.is_raw {
        return Ok(Decoded::Raw);
    }
    file.rewind().map_err(failed)?;
    let (pixels, _) = decode_as(path, &mut file, length, format)?;
    Ok(Decoded::Picture(Box::new(Picture { format, pixels, camera })))
}

/// First bytes of the RAW files that are not, or not only, laid out as TIFF: where they stand, and what they are.
const RAW_MARKS: [(usize, &[u8]); 3] = [
    (0, b"FUJIFILMCCD-RAW"), // RAF
    (4, b"ftypcrx "),        // CR3
    (8, b"CR\x02"),          // CR2
];

fn begins_like_raw(head: &[u8]) -> bool {
    RAW_MARKS.iter().any(|(at, mark)| head.get(*at..).is_some_and(|rest| rest.starts_with(mark)))
}

fn is_supported(format: &ImageFormat) -> bool {
    matches!(format, ImageFormat::Png | ImageFormat::Tiff | ImageFormat::Jpeg | ImageFormat::OpenExr)
}

/// A picture and, for PNG and JPEG, its EXIF block.
type PictureAndExif = (DynamicImage, Option<Vec<u8>>);

/// Decodes a file that may be damaged in ways that its decoder does not foresee: a panic of theirs is the file's fault.
fn decode_as(
    path: &Path,
    file: &mut BufReader<File>,
    length: u64,
    format: ImageFormat,
) -> Result<PictureAndExif> {
    let unforeseen = |_| Err(Error::picture(path, "its decoder failed on it", DAMAGED));
    catch_unwind(AssertUnwindSafe(|| decode_whole(path, file, length, format))).unwrap_or_else(unforeseen)
}

fn decode_whole(
    path: &Path,
    file: &mut BufReader<File>,
    length: u64,
    format: ImageFormat,
) -> Result<PictureAndExif> {
    let mut reader = ImageReader::with_format(file, format);
    reader.limits(limits());
    let mut decoder = reader.into_decoder().map_err(|error| undecodable(path, error))?;
    let (width, height) = decoder.dimensions();
    if width == 0 || height == 0 {
        let problem = format!("the picture is {width} x {height} px");
        return Err(Error::picture(path, problem, "copy the file again"));
    }
    if decoder.total_bytes() > MAX_BYTES {
        let problem = format!("{width} x {height} px would take more than 2 GiB");
        return Err(Error::picture(path, problem, TOO_LARGE));
    }
    if decoder.total_bytes() > length.saturating_mul(MAX_COMPRESSION) {
        let problem = format!("{width} x {height} px cannot be in its {length} bytes");
        return Err(Error::picture(path, problem, DAMAGED));
    }
    let block = decoder.exif_metadata().ok().flatten();
    let picture = DynamicImage::from_decoder(decoder).map_err(|error| undecodable(path, error))?;
    Ok((picture, block))
}

fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    // a decoder's own buffers besides the picture
    limits.max_alloc = Some(2 * MAX_BYTES);
    limits
}

fn undecodable(path: &Path, error: ImageError) -> Error {
    let remedy = match &error {
        ImageError::Limits(_) => "crop the picture to the sheet; at most 65536 px a side and 2 GiB are read",
        ImageError::Unsupported(_) => RESAVE,
        _ => DAMAGED,
    };
    Error::picture(path, one_line(&error.to_string()), remedy)
}

/// A decoder's message, which may have several lines, in one.
pub(super) fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Whether a JPEG reaches its end marker; the decoder paints what is missing grey and does not say so.
fn jpeg_is_complete(file: &mut BufReader<File>) -> io::Result<bool> {
    const END: u8 = 0xd9;
    let mut bytes = Vec::new();
    file.rewind()?;
    file.read_to_end(&mut bytes)?;
    let mut at = 2;
    while let Some([0xff, marker]) = bytes.get(at..at + 2) {
        at += match marker {
            &END => return Ok(true),
            0x00 | 0x01 | 0xd0..=0xd7 => 2,
            0xff => 1,
            _ => {
                2 + bytes
                    .get(at + 2..at + 4)
                    .map_or(0, |length| usize::from(length[0]) << 8 | usize::from(length[1]))
            }
        };
        // after a scan's header come its data, up to the next marker
        at += bytes
            .get(at..)
            .and_then(|rest| rest.iter().position(|byte| *byte == 0xff))
            .unwrap_or(bytes.len());
    }
    Ok(false)
}
