//! How a camera's colours are shown to the eye.

use crate::image::numbers::Transfer;
use crate::image::photograph::Photograph;

/// Gains that turn a typical camera's response to daylight into white, relative to green: means over the
/// measured cameras in D65.
const OF_MOST_CAMERAS: [f64; 3] = [2.4, 1.0, 1.33];

/// A camera's response to white.
#[derive(Clone, Debug, PartialEq)]
pub struct White {
    /// One number per channel.
    pub values: Vec<f64>,
    /// Names the camera and the light.
    pub by: String,
}

/// Display gains of the channels, and the caption that describes them.
#[derive(Clone, Debug, PartialEq)]
pub struct Balance {
    pub(super) gains: [f64; 3],
    pub(super) caption: String,
}

impl Balance {
    /// From the camera's response to `white`, else the gains of most cameras in daylight; none for a picture
    /// that is grey or was developed for the eye.
    #[must_use]
    pub fn of(photograph: &Photograph, white: Option<&White>) -> Self {
        let info = photograph.info();
        let is_developed = info.transfer_used == Transfer::Srgb && info.undone.is_none();
        if is_developed || photograph.channels() != 3 {
            return Self { gains: [1.0; 3], caption: "colours as they are stored".to_owned() };
        }
        let known = white.and_then(|White { values, by }| {
            let [r, g, b] = <[f64; 3]>::try_from(values.as_slice()).ok()?;
            let is_white = r.min(g).min(b) > 0.0;
            is_white.then(|| Self {
                gains: [g / r, 1.0, g / b],
                caption: format!("white balanced for display: {by}"),
            })
        });
        known.unwrap_or_else(|| Self {
            gains: OF_MOST_CAMERAS,
            caption: "white balanced for display with typical gains for daylight".to_owned(),
        })
    }
}
