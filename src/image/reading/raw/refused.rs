//! Which RAW files are refused, and what to do.

use std::fmt::Display;
use std::path::Path;

use rawler::imgop::Dim2;

use crate::error::counted;
use crate::image::reading::refused::{DAMAGED, MAX_BYTES, TOO_LARGE};
use crate::{Error, Result, room};

/// Remedy for a file that only other programs read, or that needs unsupported operations.
pub(super) const ELSEWHERE: &str =
    "convert it to linear TIFF with a program that does, or use the camera's own RAW file";

/// Checks that a sensor's numbers fit into memory and that there are any.
pub(super) fn check_size(path: &Path, size: Dim2, samples: usize) -> Result<()> {
    let Dim2 { w, h } = size;
    let bytes = w.saturating_mul(h).saturating_mul(samples).saturating_mul(size_of::<f32>()) as u64;
    if bytes > MAX_BYTES {
        return Err(Error::picture(path, format!("{w} x {h} px would take more than 2 GiB"), TOO_LARGE));
    }
    if bytes == 0 {
        return Err(damaged(path, format!("the picture is {w} x {h} px of {}", counted(samples, "number"))));
    }
    room::ask(bytes, &path.display().to_string(), TOO_LARGE)
}

/// An unsupported property, possible only in a DNG.
pub(super) fn unread(path: &Path, what: &str) -> Error {
    Error::picture(path, format!("this vfold does not read DNG {what}"), ELSEWHERE)
}

pub(super) fn damaged(path: &Path, problem: impl Display) -> Error {
    Error::picture(path, problem, DAMAGED)
}
