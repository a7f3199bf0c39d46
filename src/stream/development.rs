//! A camera's development of a picture, in a file and in records.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::json_file;
use crate::error::{Error, Result};
use crate::image::Development;

/// White balance and colour matrix that the camera applied; other fields are ignored.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub(super) struct DevelopmentRecord {
    /// Factor by which the camera multiplied each channel.
    white_balance_gains: [f64; 3],
    /// Matrix from balanced camera values to linear sRGB, row by row.
    camera_to_linear_srgb: [[f64; 3]; 3],
}

impl From<&Development> for DevelopmentRecord {
    fn from(development: &Development) -> Self {
        Self {
            white_balance_gains: development.white_balance_gains(),
            camera_to_linear_srgb: development.camera_to_linear_srgb(),
        }
    }
}

/// Reads a camera's development of a picture from a JSON file: `{"white_balance_gains": [r, g, b],
/// "camera_to_linear_srgb": [[..], [..], [..]]}`.
///
/// # Errors
/// [`Error::File`] if it cannot be read, [`Error::Record`] with the line if it holds something else,
/// [`Error::Numeric`] if it cannot be undone.
///
/// # Example
/// ```
/// use vfold::stream::read_development;
/// let file = tempfile::NamedTempFile::new().unwrap();
/// let text =
///     r#"{"white_balance_gains": [2, 1, 1.5], "camera_to_linear_srgb": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}"#;
/// std::fs::write(file.path(), text).unwrap();
/// let development = read_development(file.path().to_str().unwrap())?;
/// assert_eq!(development.camera_rgb([0.5, 0.5, 0.75]), Some([0.25, 0.5, 0.5]));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn read_development(path: &str) -> Result<Development> {
    const EXAMPLE: &str =
        "{\"white_balance_gains\": [r, g, b], \"camera_to_linear_srgb\": [[..], [..], [..]]}";
    let record: DevelopmentRecord = json_file::read(path, EXAMPLE)?;
    Development::new(record.white_balance_gains, record.camera_to_linear_srgb)
        .map_err(|error| Error::Numeric(format!("{path}: {error}; give the camera's gains and matrix")))
}
