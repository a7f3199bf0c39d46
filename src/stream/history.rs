//! How a record was made: the history entry that each tool adds to a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Fields;
use crate::error::Result;

/// Flags that change no record, long and short, and whether a value follows: runs that differ only in them
/// have the same history.
const NO_MATTER: [(&str, &str, bool); 6] = [
    ("--output", "-o", true),
    ("--resume", "--resume", true),
    ("--threads", "-j", true),
    ("--progress", "--progress", true),
    ("--quiet", "-q", false),
    ("--verbose", "-v", false),
];

/// A command that was run.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct HistoryRecord {
    /// Name of the tool.
    pub tool: String,
    /// Its version.
    pub version: String,
    /// Its arguments, without those that change no record.
    pub arguments: Vec<String>,
}

impl Fields {
    /// The tools' history entries, earliest first.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if `history` is not a list of such records.
    pub fn history(&self) -> Result<Vec<HistoryRecord>> {
        Ok(self.get("history")?.unwrap_or_default())
    }

    /// Adds an entry with the tool, its version and the arguments that made or changed this record, without
    /// arguments that change no record.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if `history` is not an array.
    pub fn add_history(&mut self, tool: &str) -> Result<()> {
        let arguments =
            that_matter(std::env::args_os().skip(1).map(|argument| argument.to_string_lossy().into_owned()));
        let version = env!("CARGO_PKG_VERSION").to_owned();
        self.push("history", HistoryRecord { tool: tool.to_owned(), version, arguments })
    }
}

fn that_matter(mut arguments: impl Iterator<Item = String>) -> Vec<String> {
    let mut kept = Vec::new();
    while let Some(argument) = arguments.next() {
        match NO_MATTER.iter().find(|(long, short, _)| argument == *long || argument == *short) {
            Some((.., true)) => drop(arguments.next()),
            Some(_) => {}
            None if NO_MATTER.iter().any(|flag| is_with_value(&argument, flag)) => {}
            None => kept.push(argument),
        }
    }
    kept
}

/// Whether flag and value form one word: `--threads=2`, `-j2`.
fn is_with_value(argument: &str, (long, short, takes_value): &(&str, &str, bool)) -> bool {
    let of_long = argument.strip_prefix(long).is_some_and(|rest| rest.starts_with('='));
    *takes_value && (of_long || (short.len() == 2 && argument.starts_with(short)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_matters_is_remembered() {
        let line =
            "-j4 photo.tif -o out --margin 2 --threads=3 --resume out -q --progress always --resume=x -j 2";
        assert_eq!(that_matter(line.split(' ').map(str::to_owned)), ["photo.tif", "--margin", "2"]);
    }
}
