//! From the bytes of a picture file to stored samples, whatever the file turns out to be.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use image::codecs::tiff::TiffDecoder;
use image::{
    DynamicImage, ExtendedColorType, ImageDecoder, ImageError, ImageFormat, ImageReader, ImageResult, Limits,
};

use super::exif::{self, Tags};
use super::jpeg::Jpeg;
use super::openexr::{self, Kind};
use super::stated::Statement;
use super::{icc, in_place, png_chunks};
use crate::image::photograph::CameraNotes;
use crate::room;
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
    /// What the file says of its numbers.
    pub stated: Vec<Statement>,
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
    // the directories of a TIFF file are read with all of it
    room::ask(length, &path.display().to_string(), TOO_LARGE)?;
    let mut file = BufReader::new(file);
    let head = file.fill_buf().map_err(failed)?;
    if head.is_empty() {
        return Err(Error::picture(path, "the file is empty", "copy it again"));
    }
    if begins_like_raw(head) {
        return Ok(Decoded::Raw);
    }
    if head.starts_with(b"II+\0") || head.starts_with(b"MM\0+") {
        return Err(Error::picture(
            path,
            "a BigTIFF file, which is not read",
            "save it as TIFF of less than 4 GiB",
        ));
    }
    let format = image::guess_format(head).ok().filter(is_supported);
    let format =
        format.ok_or_else(|| Error::picture(path, "not a PNG, TIFF, JPEG or OpenEXR picture", RESAVE))?;
    let tags = match format {
        ImageFormat::Tiff => Some(exif::read(Some(exif::tiff_tags(&mut file).map_err(failed)?))),
        _ => None,
    };
    if tags.as_ref().is_some_and(|tags| tags.is_raw) {
        return Ok(Decoded::Raw);
    }
    if tags.as_ref().is_some_and(|tags| tags.has_wide_integers) {
        const REMEDY: &str = "save it again with 16 bits, or as floats";
        return Err(Error::picture(path, "its numbers are integers of 32 bits, which are not read", REMEDY));
    }
    if is_named_raw(path) {
        let problem = format!("named like a camera's RAW file, but a {} picture", name(format));
        return Err(Error::picture(path, problem, "give the RAW file, or give the picture the name of one"));
    }
    file.rewind().map_err(failed)?;
    let (pixels, block, mut stated) = decode_as(path, &mut file, length, format)?;
    let Tags { camera, colour_space, has_profile, .. } = tags.unwrap_or_else(|| exif::read(block));
    if has_profile && stated.is_empty() {
        stated.push(icc::unreadable());
    }
    stated.extend(colour_space);
    Ok(Decoded::Picture(Box::new(Picture { format, pixels, camera, stated })))
}

/// What a format is called.
pub(super) fn name(format: ImageFormat) -> &'static str {
    match format {
        ImageFormat::Png => "PNG",
        ImageFormat::Tiff => "TIFF",
        ImageFormat::Jpeg => "JPEG",
        _ => "OpenEXR",
    }
}

/// How the names of RAW files end.
const RAW_ENDINGS: [&str; 16] = [
    "3fr", "arw", "cr2", "cr3", "crw", "dng", "erf", "iiq", "mef", "mrw", "nef", "nrw", "orf", "pef", "raf",
    "rw2",
];

fn is_named_raw(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    ending.is_some_and(|ending| RAW_ENDINGS.contains(&ending.as_str()))
}

/// First bytes of the RAW files that are not, or not only, laid out as TIFF, or as TIFF with another mark: where they stand, and what they are.
const RAW_MARKS: [(usize, &[u8]); 9] = [
    (0, b"FUJIFILMCCD-RAW"), // RAF
    (4, b"ftypcrx "),        // CR3
    (8, b"CR\x02"),          // CR2
    (6, b"HEAPCCDR"),        // CRW
    (0, b"IIRO"),            // ORF, and two older kinds
    (0, b"IIRS"),
    (0, b"MMOR"),
    (0, b"IIU\0"), // RW2
    (0, b"\0MRM"), // MRW
];

fn begins_like_raw(head: &[u8]) -> bool {
    RAW_MARKS.iter().any(|(at, mark)| head.get(*at..).is_some_and(|rest| rest.starts_with(mark)))
}

fn is_supported(format: &ImageFormat) -> bool {
    matches!(format, ImageFormat::Png | ImageFormat::Tiff | ImageFormat::Jpeg | ImageFormat::OpenExr)
}

/// A picture; for PNG and JPEG, its EXIF block; what else the file says of its numbers.
type PictureAndMore = (DynamicImage, Option<Vec<u8>>, Vec<Statement>);

/// Decodes a file that may be damaged in ways that its decoder does not foresee: a panic of theirs is the file's fault.
fn decode_as(
    path: &Path,
    file: &mut BufReader<File>,
    length: u64,
    format: ImageFormat,
) -> Result<PictureAndMore> {
    let unforeseen = |_| Err(Error::picture(path, "its decoder failed on it", DAMAGED));
    catch_unwind(AssertUnwindSafe(|| decode_whole(path, file, length, format))).unwrap_or_else(unforeseen)
}

fn decode_whole(
    path: &Path,
    file: &mut BufReader<File>,
    length: u64,
    format: ImageFormat,
) -> Result<PictureAndMore> {
    let mut stated = before_pixels(path, file, format)?;
    let mut decoder = image_decoder(file, format).map_err(|error| undecodable(path, error))?;
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
    let bytes = decoder.total_bytes();
    room::ask(bytes, &path.display().to_string(), TOO_LARGE)?;
    if matches!(decoder.original_color_type(), ExtendedColorType::Cmyk8 | ExtendedColorType::Cmyk16) {
        return Err(inks(path));
    }
    stated.extend(decoder.icc_profile().ok().flatten().map(|profile| icc::statement(&profile)));
    let block = decoder.exif_metadata().ok().flatten();
    let (dimensions, color_type) = (decoder.dimensions(), decoder.color_type());
    drop(decoder);
    file.rewind().map_err(|source| Error::file(path.display(), source))?;
    if let Some(picture) = in_place::decode(&mut *file, format, dimensions, color_type) {
        return Ok((picture, block, stated));
    }
    // once decoded, once copied
    room::ask(2 * bytes, &path.display().to_string(), TOO_LARGE)?;
    let picture = image_decoder(file, format).and_then(DynamicImage::from_decoder);
    let picture = picture.map_err(|error| undecodable(path, error))?;
    Ok((picture, block, stated))
}

/// The decoder of a file from its beginning.
fn image_decoder(file: &mut BufReader<File>, format: ImageFormat) -> ImageResult<impl ImageDecoder> {
    file.rewind()?;
    let mut reader = ImageReader::with_format(file, format);
    reader.limits(limits());
    reader.into_decoder()
}

/// What the decoders do not tell, or take for something else: what a file says of its numbers.
fn before_pixels(path: &Path, file: &mut BufReader<File>, format: ImageFormat) -> Result<Vec<Statement>> {
    match format {
        ImageFormat::Png => Ok(png_chunks::statements(file)),
        ImageFormat::OpenExr => match openexr::kind(file) {
            Some(Kind::Colours(stated)) => Ok(stated),
            Some(Kind::Other { is, remedy }) => Err(Error::picture(path, is, remedy)),
            None => Ok(Vec::new()),
        },
        ImageFormat::Jpeg => {
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).map_err(|source| Error::file(path.display(), source))?;
            let jpeg = Jpeg(&bytes);
            match jpeg.components() {
                Some(4) => Err(inks(path)),
                Some(_) if !jpeg.is_complete() => {
                    Err(Error::picture(path, "the JPEG data ends too early", "copy the file again"))
                }
                _ => Ok(Vec::new()),
            }
        }
        // asked for before the decoder is given its limits: they are those of the picture, and a small one's are too narrow for a profile
        _ => {
            let profile = TiffDecoder::new(file).ok().and_then(|mut decoder| decoder.icc_profile().ok()?);
            Ok(profile.iter().map(|profile| icc::statement(profile)).collect())
        }
    }
}

fn inks(path: &Path) -> Error {
    Error::picture(
        path,
        "its colours are those of inks (CMYK)",
        "photographs have red, green and blue: export it as RGB",
    )
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
