//! What one pixel of a photograph says.

use crate::image::numbers::Development;

/// What a pixel says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pixel {
    /// Linear light, 1 at the white level; a grey picture gives three equal numbers.
    Light([f64; 3]),
    /// A channel is at or above the white level, or was cut by the camera: the light may have been anything
    /// beyond.
    Clipped,
    /// A channel is NaN or infinite, or the pixel is fully transparent.
    NotFinite,
}

impl Pixel {
    /// A pixel of this light, infinite where a channel is clipped.
    #[inline]
    pub(super) fn new(light: [f64; 3], transparent: bool) -> Self {
        let [r, g, b] = light;
        // one test for the many good pixels
        if (r + g + b).is_finite() && !transparent {
            Self::Light(light)
        } else if transparent || light.iter().any(|y| y.is_nan()) {
            Self::NotFinite
        } else {
            Self::Clipped
        }
    }

    /// The camera's own colours of a pixel that was developed.
    #[inline]
    pub(super) fn undeveloped(self, development: &Development) -> Self {
        match self {
            Self::Light(light) => development.camera_rgb(light).map_or(Self::Clipped, Self::Light),
            other => other,
        }
    }
}
