//! From the bytes of a picture file of any format to stored samples.

use std::io::{BufRead, Cursor, Read, Seek};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, ImageResult, Limits};

use super::exif::{self, Tags};
use super::exif_block::block as exif_block;
use super::jpeg::Jpeg;
use super::levels::Levels;
use super::openexr::{self, Kind};
use super::picture_file::PictureFile;
use super::png_chunks::Chunks;
use super::refused::{
    DAMAGED, MAX_BYTES, MAX_SIDE, RESAVE, TOO_LARGE, check_size, inks, one_line, undecodable,
};
use super::stated::Statement;
use super::tiff::Tiff;
use super::{alpha, icc, jpeg_data, openexr_pixels, pixel_shape};
use crate::image::photograph::CameraNotes;
use crate::{Error, Result, room};

/// The contents of a file.
pub(super) enum Decoded {
    Picture(Box<Picture>),
    /// A camera's RAW file, not decoded here.
    Raw,
}

/// A picture as stored, not yet turned upright, with the camera's notes.
pub(super) struct Picture {
    pub format: ImageFormat,
    pub pixels: DynamicImage,
    pub camera: CameraNotes,
    /// The file's statements on its numbers.
    pub stated: Vec<Statement>,
    /// The numbers that it states for black and white.
    pub levels: Option<Levels>,
}

/// Reads and decodes a picture file; its content, not its name, determines the format.
pub(super) fn decode(file: &mut PictureFile) -> Result<Decoded> {
    let (path, length) = (&file.path().to_owned(), file.length());
    let failed = |source| Error::file(path.display(), source);
    // as much as EXIF's block in a TIFF file takes
    room::ask(length, &path.display().to_string(), TOO_LARGE)?;
    file.rewind().map_err(failed)?;
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
            "BigTIFF files are not supported",
            "save it as TIFF of less than 4 GiB",
        ));
    }
    let format = image::guess_format(head).ok().filter(is_supported);
    let format = format.ok_or_else(|| unknown(path))?;
    if format == ImageFormat::Tiff {
        return decode_tiff(file, path, length);
    }
    not_named_raw(path, format)?;
    let (pixels, block, mut stated) = foreseen(path, || decode_whole(path, file, length, format))?;
    let block = block.map(|bytes| exif_block(&mut Cursor::new(bytes))).transpose().map_err(failed)?;
    let Tags { camera, stated: by_exif, density } = exif::read(block, 0);
    pixel_shape::check(path, "EXIF resolution", density)?;
    stated.extend(by_exif);
    Ok(Decoded::Picture(Box::new(Picture { format, pixels, camera, stated, levels: None })))
}

fn decode_tiff(file: &mut PictureFile, path: &Path, length: u64) -> Result<Decoded> {
    let cut_short = |error| Error::picture(path, one_line(&format!("{error}")), DAMAGED);
    let tiff = Tiff::open(file, length).map_err(cut_short)?;
    if tiff.is_raw() {
        return Ok(Decoded::Raw);
    }
    let format = ImageFormat::Tiff;
    not_named_raw(path, format)?;
    let block = exif_block(file).map_err(|source| Error::file(path.display(), source))?;
    let Tags { mut camera, stated: by_exif, .. } = exif::read(Some(block), tiff.page());
    camera.notes.extend(tiff.note());
    let mut stated = tiff.statements();
    stated.extend(by_exif);
    let levels = tiff.levels();
    let pixels = foreseen(path, || tiff.pixels(path, file))?;
    Ok(Decoded::Picture(Box::new(Picture { format, pixels, camera, stated, levels })))
}

/// The name of a format.
pub(super) fn name(format: ImageFormat) -> &'static str {
    match format {
        ImageFormat::Png => "PNG",
        ImageFormat::Tiff => "TIFF",
        ImageFormat::Jpeg => "JPEG",
        _ => "OpenEXR",
    }
}

/// Extensions of RAW files.
const RAW_ENDINGS: [&str; 16] = [
    "3fr", "arw", "cr2", "cr3", "crw", "dng", "erf", "iiq", "mef", "mrw", "nef", "nrw", "orf", "pef", "raf",
    "rw2",
];

fn is_named_raw(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    ending.is_some_and(|ending| RAW_ENDINGS.contains(&ending.as_str()))
}

/// A file that begins like no picture.
fn unknown(path: &Path) -> Error {
    if is_named_raw(path) {
        let problem = "named like a camera's RAW file, but it does not begin like one";
        return Error::picture(path, problem, DAMAGED);
    }
    Error::picture(path, "not a PNG, TIFF, JPEG, OpenEXR or RAW picture", RESAVE)
}

fn not_named_raw(path: &Path, format: ImageFormat) -> Result<()> {
    if !is_named_raw(path) {
        return Ok(());
    }
    let article = if format == ImageFormat::OpenExr { "an" } else { "a" };
    let problem = format!("named like a camera's RAW file, but it is {article} {} picture", name(format));
    Err(Error::picture(path, problem, "give the RAW file, or rename the picture"))
}

/// First bytes of the RAW files that are not plain TIFF, or TIFF with another mark: offset and content.
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

/// A picture; for PNG and JPEG, its EXIF block; the file's other statements on its numbers.
type PictureAndMore = (DynamicImage, Option<Vec<u8>>, Vec<Statement>);

/// Decodes a file that may be damaged in unforeseen ways: a panic of its decoder counts as a fault of the
/// file.
fn foreseen<T>(path: &Path, decode: impl FnOnce() -> Result<T>) -> Result<T> {
    let unforeseen = |_| Err(Error::picture(path, "its decoder failed", DAMAGED));
    catch_unwind(AssertUnwindSafe(decode)).unwrap_or_else(unforeseen)
}

fn decode_whole(
    path: &Path,
    file: &mut PictureFile,
    length: u64,
    format: ImageFormat,
) -> Result<PictureAndMore> {
    let Header { mut stated, has_profile, exif, jpeg } = header(path, file, format)?;
    let mut decoder = image_decoder(file, format).map_err(|error| undecodable(path, error))?;
    let (dimensions, bytes) = (decoder.dimensions(), decoder.total_bytes());
    check_size(path, dimensions, bytes, length)?;
    room::ask(bytes, &path.display().to_string(), TOO_LARGE)?;
    stated.extend(match decoder.icc_profile().ok().flatten() {
        Some(profile) => Some(icc::statement(&profile, decoder.color_type().has_color())),
        None => has_profile.then(icc::unreadable),
    });
    let exif = exif.or_else(|| decoder.exif_metadata().ok().flatten());
    let has_alpha = decoder.color_type().has_alpha();
    drop(decoder);
    file.rewind().map_err(|source| Error::file(path.display(), source))?;
    let in_place = if format == ImageFormat::OpenExr {
        openexr_pixels::decode(file, dimensions, has_alpha)
    } else {
        None
    };
    let mut picture = match in_place {
        Some(picture) => picture,
        None => {
            // once decoded, once copied
            room::ask(2 * bytes, &path.display().to_string(), TOO_LARGE)?;
            let picture = image_decoder(file, format).and_then(DynamicImage::from_decoder);
            picture.map_err(|error| undecodable(path, error))?
        }
    };
    if format == ImageFormat::OpenExr {
        alpha::divide(path, &mut picture)?;
    }
    if let Some(jpeg) = jpeg {
        // a copy of the file, and of the picture once more
        room::ask(length + 2 * bytes, &path.display().to_string(), TOO_LARGE)?;
        if !jpeg_data::are_whole(&jpeg, &picture) {
            return Err(ends_too_early(path));
        }
    }
    Ok((picture, exif, stated))
}

/// The decoder of a file, starting at its beginning.
fn image_decoder(file: &mut PictureFile, format: ImageFormat) -> ImageResult<impl ImageDecoder> {
    file.rewind()?;
    let mut reader = ImageReader::with_format(file, format);
    reader.limits(limits());
    reader.into_decoder()
}

/// What a file states besides its pixels, as far as decoders omit or misinterpret it.
#[derive(Default)]
struct Header {
    stated: Vec<Statement>,
    /// Whether it has an ICC profile, readable or not.
    has_profile: bool,
    exif: Option<Vec<u8>>,
    /// All of a JPEG file.
    jpeg: Option<Vec<u8>>,
}

fn header(path: &Path, file: &mut PictureFile, format: ImageFormat) -> Result<Header> {
    match format {
        ImageFormat::Png => {
            let chunks = Chunks::read(file);
            pixel_shape::check(path, "chunk pHYs", chunks.density())?;
            let (stated, has_profile) = (chunks.statements(), chunks.has_profile());
            Ok(Header { stated, has_profile, exif: chunks.exif(), jpeg: None })
        }
        ImageFormat::OpenExr => match openexr::kind(file) {
            Some(Kind::Colours(stated)) => Ok(Header { stated, ..Header::default() }),
            Some(Kind::Other { is, remedy }) => Err(Error::picture(path, is, remedy)),
            None => Ok(Header::default()),
        },
        ImageFormat::Jpeg => {
            let bytes = whole(path, file)?;
            let jpeg = Jpeg(&bytes);
            if let Some(kind) = jpeg.frame().and_then(|frame| frame.other_kind()) {
                return Err(Error::picture(path, format!("this vfold does not read {kind}"), RESAVE));
            }
            pixel_shape::check(path, "JFIF header", jpeg.density())?;
            match jpeg.components() {
                Some(4) => Err(inks(path)),
                Some(_) if !jpeg.is_complete() => Err(ends_too_early(path)),
                _ => {
                    let has_profile = jpeg.has_profile();
                    Ok(Header { has_profile, jpeg: Some(bytes), ..Header::default() })
                }
            }
        }
        _ => Ok(Header::default()),
    }
}

/// All of a file's bytes.
fn whole(path: &Path, file: &mut PictureFile) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.rewind()
        .and_then(|()| file.read_to_end(&mut bytes))
        .map_err(|source| Error::file(path.display(), source))?;
    Ok(bytes)
}

fn ends_too_early(path: &Path) -> Error {
    Error::picture(path, "the JPEG data ends too early", "copy the file again")
}

fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    // a decoder's own buffers as well as the picture
    limits.max_alloc = Some(2 * MAX_BYTES);
    limits
}
