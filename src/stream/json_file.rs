//! JSON files passed to flags.

use std::fmt::Display;
use std::path::Path;

use serde::de::DeserializeOwned;

use super::fields::problem;
use super::piped::stdin_is_pipe;
use crate::error::{Error, Result};
use crate::files::forms::{TOO_LARGE, Text, bytes};

/// Reads a JSON file, or standard input for `-`; `example` shows its form.
///
/// # Errors
/// [`Error::File`] if it cannot be read, [`Error::Record`] with the line if it is too large or holds
/// something else.
pub(super) fn read<T: DeserializeOwned>(path: &str, example: &str) -> Result<T> {
    parse(path, &text(path, example)?, example)
}

/// Parses the contents of a JSON file.
///
/// # Errors
/// As [`read`].
pub(super) fn parse<T: DeserializeOwned>(path: &str, text: &str, example: &str) -> Result<T> {
    serde_json::from_str(text).map_err(|error| wrong(path, &error, example))
}

/// Reads a file of successive JSON values, such as NDJSON; `-` is standard input.
///
/// # Errors
/// As [`read`].
pub(super) fn read_all<T: DeserializeOwned>(path: &str, example: &str) -> Result<Vec<T>> {
    let text = text(path, example)?;
    let values = serde_json::Deserializer::from_str(&text).into_iter();
    values.map(|value| value.map_err(|error| wrong(path, &error, example))).collect()
}

fn text(path: &str, example: &str) -> Result<String> {
    let bytes = bytes(Path::new(path))?.ok_or_else(|| fault(path, 1, TOO_LARGE, example))?;
    if bytes.is_empty() && path == "-" && stdin_is_pipe() {
        return Err(Error::EmptyPipe);
    }
    let Text { text, is_unicode } = Text::decode(&bytes).map_err(|form| {
        let (problem, remedy) = (format!("the file is {}", form.name), form.way_out());
        let remedy = remedy.unwrap_or_else(|| format!("write {example}"));
        Error::Record { path: path.to_owned(), line: 1, problem, remedy }
    })?;
    if is_unicode { Ok(text) } else { Err(fault(path, 1, "not text in UTF-8", example)) }
}

fn wrong(path: &str, error: &serde_json::Error, example: &str) -> Error {
    let problem = format!("{}, column {}", problem(error), error.column());
    let problem = if error.is_data() { problem } else { format!("not JSON ({problem})") };
    fault(path, error.line(), problem, example)
}

fn fault(path: &str, line: usize, problem: impl Display, example: &str) -> Error {
    let (problem, remedy) = (problem.to_string(), format!("write {example}"));
    Error::Record { path: path.to_owned(), line: line.max(1), problem, remedy }
}
