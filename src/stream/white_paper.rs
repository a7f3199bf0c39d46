//! The record of white paper beside the sheet, which shows the exposure.

use std::fmt;
use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fields::finite;
use super::{Corners, Sample};
use crate::error::Result;

/// White printing or writing paper in the same light as the sheet. It contains a brightener, so that its
/// colour reveals nothing about camera or light; its luminance factor is known to within a few per cent.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct WhitePaperRecord {
    /// Its four corners, [x, y] each, in pixels of the upright picture, if it is in the photograph itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    corners: Option<[[f64; 2]; 4]>,
    /// File of the picture that shows nothing else.
    #[serde(skip_serializing_if = "Option::is_none")]
    image: Option<String>,
    /// Cosine of the angle between the direction to the sun and the normal of the paper.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    cos: f64,
    /// Value in the photograph, one per channel.
    measured: Vec<f64>,
    /// The exposure that it shows.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub exposure: f64,
    /// Standard deviation of the exposure.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub exposure_sd: f64,
}

impl WhitePaperRecord {
    /// The record of paper between `corners`, px, whose normal is at an angle of cosine `cos` to the sun:
    /// its values in the photograph, and the exposure with its standard deviation.
    #[must_use]
    pub fn in_photograph(corners: Corners, cos: f64, measured: Vec<f64>, exposure: [f64; 2]) -> Self {
        let corners = Some(corners.map(|corner| [corner.x, corner.y]));
        let [exposure, exposure_sd] = exposure;
        Self { corners, image: None, cos, measured, exposure, exposure_sd }
    }

    /// The same of paper in the picture `path`, which shows nothing else.
    #[must_use]
    pub fn in_picture(path: &Path, cos: f64, measured: Vec<f64>, exposure: [f64; 2]) -> Self {
        let image = Some(path.file_name().unwrap_or_default().to_string_lossy().into_owned());
        let [exposure, exposure_sd] = exposure;
        Self { corners: None, image, cos, measured, exposure, exposure_sd }
    }
}

/// One line for users.
impl fmt::Display for WhitePaperRecord {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("white paper")?;
        self.image.iter().try_for_each(|image| write!(f, " in {image}"))?;
        write!(f, ": exposure {:.3} ± {:.3}", self.exposure, self.exposure_sd)
    }
}

impl Sample {
    /// Records white paper in the photograph.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn set_white_paper(&mut self, record: &WhitePaperRecord) -> Result<()> {
        finite("white_paper", record.measured.iter().chain([&record.exposure, &record.exposure_sd]))?;
        self.fields.set("white_paper", record)
    }

    /// White paper in the photograph, if there is any.
    ///
    /// # Errors
    /// [`crate::Error::Field`] for an invalid record.
    pub fn white_paper(&self) -> Result<Option<WhitePaperRecord>> {
        let record: Option<WhitePaperRecord> = self.fields.get("white_paper")?;
        match record {
            Some(paper) if !(paper.exposure > 0.0 && paper.exposure_sd > 0.0) => {
                Err(crate::Error::field("white_paper", "exposure and exposure_sd must be numbers above 0"))
            }
            record => Ok(record),
        }
    }
}
