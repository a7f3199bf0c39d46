//! The sample record with all of its fields.

use schemars::JsonSchema;
use serde::Serialize;

use super::calibration::CalibrationRecord;
use super::colours::ColoursRecord;
use super::estimate::EstimateRecord;
use super::fields::{Fields, finite};
use super::named::Named;
use super::photograph::ImageRecord;
use super::regions::RegionsRecord;
use super::sample::{ReflectanceRecord, Sample};
use super::scores::ColourRecord;
use super::white_paper::WhitePaperRecord;
use crate::error::Result;
use crate::paper::bounces::Truncation;

/// A sheet in the scene above it: the colours of its facets, and what the tools compute from them.
#[derive(Default, Serialize, JsonSchema)]
#[serde(tag = "kind", rename = "sample")]
#[schemars(extend("x-writer" = "vforward, vextract"))]
pub(super) struct SampleRecord {
    /// Name of the scene.
    scene: String,
    /// Name of the sample: that of its spectrum or photograph.
    id: String,
    /// Exposure, if it is known: value of a perfect white diffuser that faces the sun, in its strongest
    /// channel.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    exposure: Option<f64>,
    /// How a chart or a white card calibrated the photograph's values.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    calibration: Option<CalibrationRecord>,
    /// White paper beside the sheet, which tells vestimate the exposure to within a few per cent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    white_paper: Option<WhitePaperRecord>,
    /// The photograph.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    image: Option<ImageRecord>,
    /// Mean value of each facet, proportional to its light; white that faces the sun has the value of the
    /// exposure. Absent if there is an `error`.
    #[serde(skip_serializing_if = "Option::is_none")]
    facet_rgb: Option<ColoursRecord>,
    /// Standard deviation of each value of `facet_rgb`, from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    facet_sd: Option<ColoursRecord>,
    /// Number of pixels averaged in each facet; a pixel shared by several facets counts in each by the part
    /// that lies in it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    facet_pixels: Option<Vec<f64>>,
    /// Number of pixels of each facet that were left out because a channel is clipped.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    facet_clipped: Option<Vec<usize>>,
    /// Number of pixels of each facet that were left out because they are transparent or not finite.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    facet_not_finite: Option<Vec<usize>>,
    /// Number of pixels of each facet that were left out because they do not look like the rest of the facet.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    facet_outliers: Option<Vec<usize>>,
    /// The bounces of light that the facets' values include; all if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vforward"))]
    bounces: Option<BouncesRecord>,
    /// The true reflectance, if it is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vforward, vscore"))]
    truth: Option<ReflectanceRecord>,
    /// Where the panels are in the rendered picture, in the form that `vextract --regions` reads.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vforward"))]
    regions: Option<RegionsRecord>,
    /// The estimated spectrum.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vestimate"))]
    estimate: Option<EstimateRecord>,
    /// Scores of the estimate by name: rmse, ciede2000, pd, gfc, `angle_deg`, metamerism; `ciede2000_A` and
    /// the like under further illuminants.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vscore"))]
    metrics: Option<Named<f64>>,
    /// Colour of the estimate.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vscore"))]
    colour: Option<ColourRecord>,
    /// What went wrong with this sample; the tools pass it on as it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract, vestimate, vscore"))]
    error: Option<String>,
}

/// The first bounces of light, if not all are included.
#[derive(Serialize, JsonSchema)]
struct BouncesRecord {
    /// Number of bounces.
    count: u32,
    /// Largest share of a facet's value that all further bounces would add.
    #[schemars(range(min = 0, max = 1))]
    missing: f64,
}

impl Sample {
    /// An empty sample of a scene.
    ///
    /// # Errors
    /// As [`Fields::set`].
    pub fn new(scene: &str, id: &str) -> Result<Self> {
        let (scene, id) = (scene.to_owned(), id.to_owned());
        Ok(Self { fields: Fields::of(&SampleRecord { scene, id, ..SampleRecord::default() })? })
    }

    /// Records the number of bounces in the facets' values.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn set_bounces(&mut self, truncation: &Truncation) -> Result<()> {
        let Truncation { count, missing } = *truncation;
        finite("bounces.missing", [&missing])?;
        self.fields.set("bounces", BouncesRecord { count, missing })
    }
}
