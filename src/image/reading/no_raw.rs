//! Replaces the reader of RAW files if the feature `raw` is off.

use std::path::Path;

use crate::image::numbers::ReadOptions;
use crate::image::photograph::Photograph;
use crate::{Error, Result};

/// Explains how to read RAW files.
pub(super) fn open(path: &Path, _bytes: Vec<u8>, _options: &ReadOptions) -> Result<Photograph> {
    const REMEDY: &str = "in a clone of vfold run share/install, or cargo build --release --features raw; \
                          or convert the file to linear TIFF ('dcraw -4 -T -o 0 -r 1 1 1 1')";
    Err(Error::picture(path, "a camera's RAW file, but this vfold was built without RAW support", REMEDY))
}
