//! Identifies a version of a file, to detect replacement.

use std::fs::Metadata;
use std::time::UNIX_EPOCH;

/// Size and time of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FileStamp {
    /// Size, bytes.
    pub bytes: u64,
    /// When it was last written, seconds after 1970-01-01T00:00Z.
    pub modified_s: f64,
}

impl FileStamp {
    /// That of a file; none for a pipe or a device, which cannot be compared.
    #[must_use]
    pub fn of(metadata: &Metadata) -> Option<Self> {
        let modified = metadata.modified().ok().filter(|_| metadata.is_file())?;
        let modified_s = match modified.duration_since(UNIX_EPOCH) {
            Ok(after) => after.as_secs_f64(),
            Err(before) => -before.duration().as_secs_f64(),
        };
        Some(Self { bytes: metadata.len(), modified_s })
    }
}
