//! Which RAW files are refused, and what is to be done about it.

use std::fmt::Display;
use std::path::Path;

use rawler::imgop::Dim2;

use crate::image::reading::refused::{DAMAGED, MAX_BYTES, TOO_LARGE};
use crate::{Error, Result, room};

/// What to do with a file that only others read, or that needs what is not done here.
pub(super) const ELSEWHERE: &str =
    "convert it to linear TIFF with a program that does, or take the camera's own RAW file";

/// Whether there is room for a sensor's numbers, and there are any.
pub(super) fn check_size(path: &Path, size: Dim2, samples: usize) -> Result<()> {
    let Dim2 { w, h } = size;
    let bytes = w.saturating_mul(h).saturating_mul(samples).saturating_mul(size_of::<f32>()) as u64;
    if bytes > MAX_BYTES {
        return Err(Error::picture(path, format!("{w} x {h} px would take more than 2 GiB"), TOO_LARGE));
    }
    if bytes == 0 {
        return Err(damaged(path, format!("the picture is {w} x {h} px of {samples} numbers")));
    }
    room::ask(bytes, &path.display().to_string(), TOO_LARGE)
}

/// What only a DNG can be.
pub(super) fn unread(path: &Path, what: &str) -> Error {
    Error::picture(path, format!("this vfold does not read DNG {what}"), ELSEWHERE)
}

pub(super) fn damaged(path: &Path, problem: impl Display) -> Error {
    Error::picture(path, problem, DAMAGED)
}
