//! Messages for people, one line each.

use std::borrow::Cow;

use crate::error::cut;

/// A message as one line that a terminal shows unchanged: characters escaped by [`printable`], which names in
/// files may contain, are escaped, and a text longer than any message is cut in the middle.
///
/// # Example
/// ```
/// assert_eq!(
///     vfold::message::one_line("column 'a\tb\x1b[31m' is no number"),
///     "column 'a\\tb\\u{1b}[31m' is no number"
/// );
/// assert_eq!(vfold::message::one_line(&"x".repeat(9999)).chars().count(), 2001);
/// ```
#[must_use]
pub fn one_line(message: &str) -> String {
    printable(&cut(message, 2000)).into_owned()
}

/// A text that a terminal or a spreadsheet shows letter by letter, from left to right and on one line:
/// control characters (C0, C1, DEL), line separators and marks of writing direction (Unicode Standard
/// Annex #9) become visible escapes.
///
/// # Example
/// ```
/// use vfold::message::printable;
/// assert_eq!(printable("\u{1b}[2J red\n\u{202e}der"), "\\u{1b}[2J red\\n\\u{202e}der");
/// assert_eq!(printable("Grün, 緑, \u{5e9}"), "Grün, 緑, \u{5e9}");
/// ```
#[must_use]
pub fn printable(text: &str) -> Cow<'_, str> {
    if !text.contains(misleads) {
        return text.into();
    }
    let shown = |letter: char| match misleads(letter) {
        true => letter.escape_default().collect(),
        false => letter.to_string(),
    };
    text.chars().map(shown).collect()
}

/// True if a spreadsheet would take a text for a formula and run it.
///
/// # Example
/// ```
/// use vfold::message::is_formula;
/// assert!(is_formula("=1+1") && is_formula(" @sum") && !is_formula("5YR 7/12"));
/// ```
#[must_use]
pub fn is_formula(text: &str) -> bool {
    text.trim_start().starts_with(['=', '+', '-', '@'])
}

/// True for a character that is not printed but acts on those around it.
fn misleads(letter: char) -> bool {
    let turns = matches!(letter, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}');
    let isolates = ('\u{2066}'..='\u{2069}').contains(&letter);
    turns || isolates || letter.is_control() || matches!(letter, '\u{2028}' | '\u{2029}')
}
