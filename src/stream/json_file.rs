//! JSON files beside the stream: what a user gives a flag.

use std::fmt::Display;
use std::fs::File;
use std::io::Read;

use serde::de::DeserializeOwned;

use super::forms::{other_form, without_mark};
use crate::error::{Error, Result};

/// A list of regions for a hundred thousand photographs is smaller.
const MAX_BYTES: u64 = 64 << 20;

/// Reads a JSON file; `example` shows what it should hold.
///
/// # Errors
/// [`Error::File`] if it cannot be read, [`Error::Record`] with the line if it is too large or holds something else.
pub(super) fn read<T: DeserializeOwned>(path: &str, example: &str) -> Result<T> {
    parse(path, &bytes(path, example)?, example)
}

/// Reads what a JSON file holds.
///
/// # Errors
/// As [`read`].
pub(super) fn parse<T: DeserializeOwned>(path: &str, bytes: &[u8], example: &str) -> Result<T> {
    serde_json::from_slice(bytes).map_err(|error| fault(path, error.line(), &error, example))
}

/// Reads a file of JSON values one after the other, such as NDJSON.
///
/// # Errors
/// As [`read`].
pub(super) fn read_all<T: DeserializeOwned>(path: &str, example: &str) -> Result<Vec<T>> {
    let bytes = bytes(path, example)?;
    let values = serde_json::Deserializer::from_slice(&bytes).into_iter();
    values.map(|value| value.map_err(|error| fault(path, error.line(), &error, example))).collect()
}

fn bytes(path: &str, example: &str) -> Result<Vec<u8>> {
    let failed = |source| Error::file(path, source);
    let mut bytes = Vec::new();
    File::open(path).map_err(failed)?.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(fault(path, 1, "the file is larger than 64 MiB", example));
    }
    if let Some((form, remedy)) = other_form(&bytes) {
        return Err(Error::Record { path: path.to_owned(), line: 1, problem: form, remedy });
    }
    Ok(without_mark(&bytes).to_vec())
}

fn fault(path: &str, line: usize, problem: impl Display, example: &str) -> Error {
    let (problem, remedy) = (problem.to_string(), format!("write {example}"));
    Error::Record { path: path.to_owned(), line: line.max(1), problem, remedy }
}
