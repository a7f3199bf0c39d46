//! Files of surfaces, limited to the size of a surface that can be computed.

use std::fs::File;
use std::io::{BufReader, Read, Take};
use std::path::Path;

use crate::error::{Error, Result};

/// 22000 facets take a quarter of it; parsing may take hundreds of bytes per byte.
const MAX_BYTES: u64 = 16 << 20;

/// Opens the file of a surface; of anything but a regular file, only the first bytes are read.
///
/// # Errors
/// [`Error::File`] if it cannot be opened, [`Error::Shape`] if it is too large.
pub(super) fn open(path: &Path) -> Result<BufReader<Take<File>>> {
    let failed = |e| Error::file(path.display(), e);
    let file = File::open(path).map_err(failed)?;
    if file.metadata().map_err(failed)?.len() > MAX_BYTES {
        return Err(Error::shape("the file is larger than 16 MiB", "give a coarser mesh").of_file(path));
    }
    Ok(BufReader::new(file.take(MAX_BYTES)))
}
