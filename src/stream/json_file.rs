//! JSON files beside the stream: what a user gives a flag.

use std::fs::File;
use std::io::Read;

use serde::de::DeserializeOwned;

use crate::error::{Error, Result};

/// A list of regions for a hundred thousand photographs is smaller.
const MAX_BYTES: u64 = 64 << 20;

/// Reads a JSON file; `example` shows what it should hold.
///
/// # Errors
/// [`Error::File`] if it cannot be read, [`Error::Record`] with the line if it is too large or holds something else.
pub(super) fn read<T: DeserializeOwned>(path: &str, example: &str) -> Result<T> {
    let failed = |source| Error::file(path, source);
    let mut bytes = Vec::new();
    File::open(path).map_err(failed)?.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(failed)?;
    let fault = |line: usize, problem: String| Error::Record {
        path: path.to_owned(),
        line: line.max(1),
        problem,
        remedy: format!("write {example}"),
    };
    if bytes.len() as u64 > MAX_BYTES {
        return Err(fault(1, "the file is larger than 64 MiB".to_owned()));
    }
    serde_json::from_slice(&bytes).map_err(|error| fault(error.line(), error.to_string()))
}
