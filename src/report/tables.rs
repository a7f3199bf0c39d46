//! Tables common to all sections, and collapsible parts.

use super::html::Html;
use super::words::{rounded_list, words};

/// Names and values.
pub(super) fn pairs(caption: &str, rows: Vec<(String, String)>) -> Html {
    Html::table(
        caption,
        &["what", "value"],
        rows.into_iter().map(|(name, value)| vec![words(&name).into(), rounded_list(&value).into()]),
    )
}

/// A part that opens on a click.
pub(super) fn folded(summary: &str, what: Html) -> Html {
    Html::element("details", &[], vec![Html::element("summary", &[], summary), what])
}
