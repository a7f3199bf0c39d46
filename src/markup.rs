//! Text within XML and HTML.

use crate::message;

/// A text that XML shows letter by letter: characters escaped by [`message::printable`] are escaped, and
/// noncharacters are replaced.
///
/// # Example
/// ```
/// assert_eq!(vfold::markup::printable("a\0\u{202e}b\u{ffff}"), "a\\u{0}\\u{202e}b\u{fffd}");
/// ```
#[must_use]
pub fn printable(text: &str) -> String {
    message::printable(text).replace(['\u{fffe}', '\u{ffff}'], "\u{fffd}")
}

/// A text as the content of an element or the value of an attribute.
///
/// # Example
/// ```
/// assert_eq!(vfold::markup::escaped("a < \"b\" & c"), "a &lt; &quot;b&quot; &amp; c");
/// ```
#[must_use]
pub fn escaped(text: &str) -> String {
    // the ampersand first: it occurs in the names of the others
    let names = [('&', "&amp;"), ('<', "&lt;"), ('>', "&gt;"), ('"', "&quot;")];
    names.iter().fold(printable(text), |text, (letter, name)| text.replace(*letter, name))
}
