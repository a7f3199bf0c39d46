//! What a camera wrote beside the picture.

use super::orientation::Orientation;
use super::taken::Taken;

/// The few EXIF fields that matter to a measurement.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CameraNotes {
    /// The camera's maker.
    pub make: Option<String>,
    /// The camera.
    pub model: Option<String>,
    /// Exposure time, s.
    pub exposure_s: Option<f64>,
    /// Focal length over aperture.
    pub f_number: Option<f64>,
    /// Focal length that shows as much on film of 36 x 24 mm, mm.
    pub focal_35mm: Option<f64>,
    /// ISO sensitivity.
    pub iso: Option<u32>,
    /// Rows of the matrix from XYZ to its R, G and B in daylight, as DNG has it.
    pub xyz_to_camera: Option<[[f64; 3]; 3]>,
    /// Where, when and in which light it was taken.
    pub taken: Taken,
    /// How the picture was stored.
    pub orientation: Orientation,
    /// What was wrong but did no harm.
    pub notes: Vec<String>,
}

impl CameraNotes {
    /// Maker and model, empty where they are not said.
    #[must_use]
    pub fn called(&self) -> (String, String) {
        (self.make.clone().unwrap_or_default(), self.model.clone().unwrap_or_default())
    }
}
