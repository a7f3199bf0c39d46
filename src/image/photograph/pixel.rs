//! The light of one pixel of a photograph.

use crate::image::numbers::Development;

/// The light of a pixel, or why there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pixel {
    /// Linear light, 1 at the white level; a grey picture has three equal numbers.
    Light([f64; 3]),
    /// A channel is at or above the white level, or was clipped by the camera: its light is unknown.
    Clipped,
    /// A channel is NaN or infinite, or the pixel is fully transparent.
    NotFinite,
}

impl Pixel {
    /// A pixel of this light, infinite where a channel is clipped.
    #[inline]
    pub(super) fn new(light: [f64; 3], transparent: bool) -> Self {
        let [r, g, b] = light;
        // one test for the majority of good pixels
        if (r + g + b).is_finite() && !transparent {
            Self::Light(light)
        } else if transparent || light.iter().any(|y| y.is_nan()) {
            Self::NotFinite
        } else {
            Self::Clipped
        }
    }

    /// The camera's own colours of a developed pixel.
    #[inline]
    pub(super) fn undeveloped(self, development: &Development) -> Self {
        match self {
            Self::Light(light) => development.camera_rgb(light).map_or(Self::Clipped, Self::Light),
            other => other,
        }
    }
}
