//! Output of `vextract --pick`: regions that a person marked in a photograph.

use serde_json::Value;

use super::{Fields, Regions};
use crate::error::{Error, Result};

/// The line of a regions file sent by a web page; `page` is its name in errors.
///
/// # Errors
/// [`Error::Regions`] if the text is not an object of regions, or has no panel.
///
/// # Example
/// ```
/// use vfold::stream::picked_line;
/// let line = picked_line("the page", "{\"panel0\": [[0, 0], [9, 0],\n [9, 9], [0, 9]]}")?;
/// assert_eq!(line, r#"{"panel0":[[0,0],[9,0],[9,9],[0,9]]}"#);
/// assert!(picked_line("the page", "{}").is_err());
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn picked_line(page: &str, text: &str) -> Result<String> {
    let remedy = "mark all four corners of a panel";
    let object: Value = serde_json::from_str(text)
        .map_err(|e| Error::regions(page, format!("this is not JSON ({e})"), remedy))?;
    if Regions::from_fields(page, &Fields::of(&object)?)?.panels.is_empty() {
        return Err(Error::regions(page, "no panel is marked", remedy));
    }
    Ok(object.to_string())
}
