//! The camera's notes in the picture file.

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
    /// Focal length, mm.
    pub focal_mm: Option<f64>,
    /// Focal length of equal angle of view on film of 36 x 24 mm, mm.
    pub focal_35mm: Option<f64>,
    /// ISO sensitivity.
    pub iso: Option<u32>,
    /// Rows of the matrix from XYZ to its R, G and B in daylight, as DNG has it.
    pub xyz_to_camera: Option<[[f64; 3]; 3]>,
    /// Place, time and light.
    pub taken: Taken,
    /// Orientation of the stored picture.
    pub orientation: Orientation,
    /// Harmless faults that were found.
    pub notes: Vec<String>,
}

/// Fraction of the light from a surface that reaches the middle of the sensor behind a typical lens; ISO
/// 12232, annex on exposure.
const LENS: f64 = 0.65;
/// Exposure that saturates a sensor of sensitivity 1, lx s; ISO 12232, saturation-based speed.
const SATURATION_LX_S: f64 = 78.0;

impl CameraNotes {
    /// Value of a perfect white diffuser under 1000 lx, relative to a saturated sensor, from exposure time,
    /// aperture and sensitivity; none unless all three are known. The standard lets makers state
    /// sensitivities by other definitions, so a sensor may saturate sooner or later.
    ///
    /// # Source
    /// ISO 12232:2019, saturation-based speed; a diffuser under E lx has a luminance of E / π.
    #[must_use]
    pub fn white_per_klx(&self) -> Option<f64> {
        let (exposure_s, f_number, iso) = (self.exposure_s?, self.f_number?, f64::from(self.iso?));
        let exposure_lx_s = LENS * 1000.0 / std::f64::consts::PI * exposure_s / (f_number * f_number);
        Some(exposure_lx_s * iso / SATURATION_LX_S).filter(|white| *white > 0.0)
    }

    /// Maker and model, empty if not recorded.
    #[must_use]
    pub fn called(&self) -> (String, String) {
        (self.make.clone().unwrap_or_default(), self.model.clone().unwrap_or_default())
    }
}

/// What a camera is called: its model, after its maker unless the model begins with the maker's name.
///
/// # Example
/// ```
/// use vfold::image::camera_name;
/// assert_eq!(camera_name("Canon", "Canon EOS R5"), "Canon EOS R5");
/// assert_eq!(camera_name("NIKON CORPORATION", "NIKON D850"), "NIKON D850");
/// assert_eq!(camera_name("SONY", "ILCE-7M3"), "SONY ILCE-7M3");
/// assert_eq!(camera_name("", "X-T3"), "X-T3");
/// ```
#[must_use]
pub fn camera_name(make: &str, model: &str) -> String {
    let first = |text: &str| text.split_whitespace().next().map(str::to_lowercase);
    if first(make) == first(model) { model.to_owned() } else { format!("{make} {model}").trim().to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In bright sun, around 100 klx, f/16 and the reciprocal of the sensitivity barely avoid clipping white.
    #[test]
    fn the_rule_of_sunny_sixteen_exposes_white_to_about_one() {
        let notes = |iso| CameraNotes {
            exposure_s: Some(1.0 / 400.0),
            f_number: Some(16.0),
            iso,
            ..CameraNotes::default()
        };
        let white = notes(Some(400)).white_per_klx().map(|white| 100.0 * white);
        assert!(white.is_some_and(|white| (0.9..1.2).contains(&white)), "{white:?}");
        assert_eq!(notes(None).white_per_klx(), None);
        assert_eq!(notes(Some(0)).white_per_klx(), None);
    }
}
