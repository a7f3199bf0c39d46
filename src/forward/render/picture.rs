//! Pictures: the light along lines of sight, averaged over pixels.

use std::path::Path;

use nalgebra::Vector3;
use rayon::prelude::*;

use super::pinhole::{Frame, Pinhole};
use crate::colorimetry::encode_srgb;
use crate::error::Result;
use crate::image::{Point, write_linear, write_srgb_png};

/// Samples per pixel in each direction; a pixel's value is their mean.
const SUBPIXELS: usize = 4;

/// Linear camera RGB, row by row from the top.
#[derive(Clone, Debug)]
pub struct Picture {
    frame: Frame,
    rgb: Vec<f64>,
}

impl Picture {
    /// Renders a picture. `light` gives the light reaching a point along a line of sight, 0 where nothing is
    /// seen.
    ///
    /// The result does not depend on the number of threads.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use vfold::forward::render::Picture;
    /// use vfold::forward::render::{Frame, Pinhole, Stand};
    /// let stand = Stand { eye: Vector3::zeros(), look_at: Vector3::new(0.0, 0.0, 1.0), up: Vector3::y() };
    /// let frame = Frame::new(2, 1)?;
    /// let camera = Pinhole::with_field_of_view(&stand, 60.0, frame)?;
    /// // x is to the left
    /// let left_half = |_, sight: Vector3<f64>| if sight.x > 0.0 { [1.0; 3] } else { [0.0; 3] };
    /// let mut picture = Picture::take(frame, &camera, left_half);
    /// assert_eq!(picture.pixels_mut(), [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn take(
        frame: Frame,
        camera: &Pinhole,
        light: impl Fn(Vector3<f64>, Vector3<f64>) -> [f64; 3] + Sync,
    ) -> Self {
        let (width, mut rgb) = (frame.width(), vec![0.0; frame.width() * frame.height() * 3]);
        rgb.par_chunks_exact_mut(3).enumerate().for_each(|(n, pixel)| {
            let (x, y) = ((n % width) as f64, (n / width) as f64);
            for sub in 0..SUBPIXELS * SUBPIXELS {
                let offset = |k: usize| (k as f64 + 0.5) / SUBPIXELS as f64;
                let at = Point { x: x + offset(sub % SUBPIXELS), y: y + offset(sub / SUBPIXELS) };
                let seen = light(camera.position(), camera.line_of_sight(at));
                pixel.iter_mut().zip(seen).for_each(|(value, seen)| *value += seen);
            }
            pixel.iter_mut().for_each(|value| *value /= (SUBPIXELS * SUBPIXELS) as f64);
        });
        Self { frame, rgb }
    }

    /// The pixels' values, three per pixel.
    pub fn pixels_mut(&mut self) -> &mut [f64] {
        &mut self.rgb
    }

    /// Writes the linear values unchanged: OpenEXR or 16-bit TIFF.
    ///
    /// # Errors
    /// As [`write_linear`].
    pub fn save(&self, path: &Path) -> Result<()> {
        write_linear(path, self.frame.width(), self.frame.height(), &self.rgb)
    }

    /// Writes an 8-bit sRGB PNG for a screen, with the brightest value white.
    ///
    /// # Errors
    /// As [`write_srgb_png`].
    pub fn save_for_screen(&self, path: &Path) -> Result<()> {
        let brightest = self.rgb.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let encoded: Vec<f64> = self.rgb.iter().map(|value| encode_srgb(value / brightest)).collect();
        write_srgb_png(path, self.frame.width(), self.frame.height(), &encoded)
    }
}
