//! In the place of the reader of RAW files, where the feature `raw` is off.

use std::path::Path;

use crate::image::numbers::ReadOptions;
use crate::image::photograph::Photograph;
use crate::{Error, Result};

/// Says how RAW files are read.
pub(super) fn open(path: &Path, _bytes: Vec<u8>, _options: &ReadOptions) -> Result<Photograph> {
    let remedy = "build vfold with 'cargo install --path . --features raw', or convert the file to linear TIFF ('dcraw -4 -T -o 0 -r 1 1 1 1')";
    Err(Error::picture(path, "a RAW file, which this vfold was built without", remedy))
}
