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
    /// File of the picture in which it is: the photograph, or another that shows nothing else.
    #[serde(default)]
    image: String,
    /// Its four corners, [x, y] each, in pixels of the upright picture, if it is in the photograph.
    #[serde(skip_serializing_if = "Option::is_none")]
    corners: Option<[[f64; 2]; 4]>,
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
    /// The record of paper in the picture `path`, if that is the photograph between `corners`, px, whose
    /// normal is at an angle of cosine `cos` to the sun: its values, and the exposure with its standard
    /// deviation.
    #[must_use]
    pub fn new(
        (path, corners): (&Path, Option<Corners>),
        cos: f64,
        measured: Vec<f64>,
        [exposure, exposure_sd]: [f64; 2],
    ) -> Self {
        let image = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let corners = corners.map(|corners| corners.map(|corner| [corner.x, corner.y]));
        Self { image, corners, cos, measured, exposure, exposure_sd }
    }
}

/// One line for users.
impl fmt::Display for WhitePaperRecord {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("white paper")?;
        if self.corners.is_none() {
            write!(f, " in {}", self.image)?;
        }
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
