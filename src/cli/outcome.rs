//! Abnormal ends of a tool: panics and wrong usage, each in one line.

use std::panic::{self, AssertUnwindSafe};

use crate::error::{Error, Result};

/// The result of `run`, or an error if it panics; developers get a backtrace if `RUST_BACKTRACE` is set.
pub(super) fn without_panic<T>(run: impl FnOnce() -> Result<T>) -> Result<T> {
    if std::env::var_os("RUST_BACKTRACE").is_none() {
        panic::set_hook(Box::new(|_| ()));
    }
    let fault = |panic: Box<dyn std::any::Any + Send>| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or_default();
        Err(Error::Fault(text.to_owned()))
    };
    panic::catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(fault)
}

/// A message of clap in one line, without the usage, which `--help` contains.
pub(super) fn misuse(rendered: &str) -> String {
    let paragraphs = rendered.trim_start_matches("error: ").split("\n\n");
    let text = paragraphs.take_while(|text| !text.starts_with("Usage:") && !text.starts_with("For more"));
    let text =
        text.map(|text| text.split_whitespace().collect::<Vec<_>>().join(" ")).collect::<Vec<_>>().join("; ");
    NUMBERS.iter().fold(text, |text, (theirs, ours)| text.replace(theirs, ours))
}

/// Rust's messages for text that is not a number, and plain ones.
const NUMBERS: [(&str, &str); 5] = [
    ("invalid float literal", "not a number"),
    ("invalid digit found in string", "not a whole number of 0 or more"),
    ("cannot parse integer from empty string", "a number is missing"),
    ("cannot parse float from empty string", "a number is missing"),
    ("number too large to fit in target type", "too large"),
];
