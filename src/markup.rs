//! Text within XML and HTML.

/// A text without the characters that no XML may hold: control characters and what is not a character at all.
///
/// # Example
/// ```
/// assert_eq!(vfold::markup::printable("a\0\u{1b}b"), "a\u{fffd}\u{fffd}b");
/// ```
#[must_use]
pub fn printable(text: &str) -> String {
    let no_letter = |letter: char| letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}');
    text.replace(no_letter, "\u{fffd}")
}

/// A text as the content of an element or the value of an attribute.
///
/// # Example
/// ```
/// assert_eq!(vfold::markup::escaped("a < \"b\" & c"), "a &lt; &quot;b&quot; &amp; c");
/// ```
#[must_use]
pub fn escaped(text: &str) -> String {
    // the ampersand first: it is in the names of the others
    let names = [('&', "&amp;"), ('<', "&lt;"), ('>', "&gt;"), ('"', "&quot;")];
    names.iter().fold(printable(text), |text, (letter, name)| text.replace(*letter, name))
}
