//! How a camera's colours are shown to the eye.

use crate::image::numbers::Transfer;
use crate::image::photograph::Photograph;

/// Gains that make white of what most cameras have of daylight, green's being 1: the means of the measured
/// cameras in D65.
const OF_MOST_CAMERAS: [f64; 3] = [2.4, 1.0, 1.33];

/// What a camera makes of white.
#[derive(Clone, Debug, PartialEq)]
pub struct White {
    /// A number a channel.
    pub values: Vec<f64>,
    /// Which camera in which light, in words.
    pub by: String,
}

/// Gains of the channels for display, and what is said of them beside the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Balance {
    pub(super) gains: [f64; 3],
    pub(super) caption: String,
}

impl Balance {
    /// By what the camera makes of `white`, or as most cameras have daylight; none of a picture that is grey,
    /// or was made for the eye.
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
            caption: "white balanced for display as most cameras have daylight".to_owned(),
        })
    }
}
