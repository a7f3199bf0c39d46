//! Places of errors in files, and numbers as written in files.

use crate::error::{Error, Result};

/// A line of a file.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub(super) path: &'a str,
    pub(super) line: usize,
}

impl Place<'_> {
    pub(super) fn fails(&self, problem: impl Into<String>, remedy: impl Into<String>) -> Error {
        let (path, line) = (self.path.to_owned(), self.line);
        Error::Table { path, line, problem: problem.into(), remedy: remedy.into() }
    }

    /// A finite number.
    pub(super) fn number(&self, column: &str, text: &str) -> Result<f64> {
        finite(text).ok_or_else(|| {
            let problem = format!("column '{column}': '{text}' is not a number");
            self.fails(problem, "write a finite number with '.' for decimals")
        })
    }
}

pub(super) fn finite(text: &str) -> Option<f64> {
    text.parse().ok().filter(|value: &f64| value.is_finite())
}
