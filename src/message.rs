//! Messages for people, each on a line of its own.

use crate::error::cut;

/// A message as one line that a terminal shows as it is: control characters, which names in files may hold, are escaped, and
/// what is longer than any message is cut in the middle.
///
/// # Example
/// ```
/// assert_eq!(vfold::message::one_line("column 'a\tb\x1b[31m' is no number"), "column 'a\\tb\\u{1b}[31m' is no number");
/// assert_eq!(vfold::message::one_line(&"x".repeat(9999)).chars().count(), 2001);
/// ```
#[must_use]
pub fn one_line(message: &str) -> String {
    let shown = |letter: char| match letter.is_control() {
        true => letter.escape_default().collect(),
        false => letter.to_string(),
    };
    cut(message, 2000).chars().map(shown).collect()
}
