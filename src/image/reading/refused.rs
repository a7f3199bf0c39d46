//! Which pictures are refused, and what to do.

use std::path::Path;

use image::ImageError;

use crate::{Error, Result};

/// Largest decoded picture, and largest file: 2 GiB, some 350 megapixels of 16-bit RGB.
pub(super) const MAX_BYTES: u64 = 2 << 30;
/// Largest width and height, px.
pub(super) const MAX_SIDE: u32 = 1 << 16;
/// Largest compression ratio: that of deflate is at most 1032, of other methods below this.
const MAX_COMPRESSION: u64 = 1 << 16;

pub(super) const TOO_LARGE: &str = "crop the picture to the sheet";
pub(super) const DAMAGED: &str = "the file is damaged or cut short: copy it again";
pub(super) const RESAVE: &str = "save it again as PNG, TIFF, JPEG or OpenEXR, RGB or grey";

/// Checks that a picture of this many bytes is not empty or too large, and fits into a file of this length.
pub(super) fn check_size(path: &Path, (width, height): (u32, u32), bytes: u64, length: u64) -> Result<()> {
    if width == 0 || height == 0 {
        let problem = format!("the picture is {width} x {height} px");
        return Err(Error::picture(path, problem, "copy the file again"));
    }
    if bytes > MAX_BYTES {
        let problem = format!("{width} x {height} px would take more than 2 GiB");
        return Err(Error::picture(path, problem, TOO_LARGE));
    }
    if bytes > length.saturating_mul(MAX_COMPRESSION) {
        let problem = format!("its {length} bytes are too few for {width} x {height} px");
        return Err(Error::picture(path, problem, DAMAGED));
    }
    Ok(())
}

pub(super) fn inks(path: &Path) -> Error {
    Error::picture(path, "its colours are CMYK", "export it as RGB")
}

pub(super) fn undecodable(path: &Path, error: ImageError) -> Error {
    let problem = one_line(&error.to_string());
    // OpenEXR's decoder reports this for undamaged files
    if let Some((_, what)) = problem.split_once("not supported: ") {
        return Error::picture(path, format!("this vfold does not read this file: {what}"), RESAVE);
    }
    let remedy = match &error {
        ImageError::Limits(_) => "crop the picture to the sheet; at most 65536 px a side and 2 GiB are read",
        ImageError::Unsupported(_) => RESAVE,
        _ => DAMAGED,
    };
    Error::picture(path, problem, remedy)
}

/// Joins the lines of a decoder's message.
pub(super) fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// For a file that contradicts itself.
pub(super) fn damaged(path: &Path, problem: impl Into<String>) -> Error {
    Error::picture(path, problem.into(), DAMAGED)
}
