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

/// A sheet in the scene above it: the colours of its facets, and what the tools make of them.
#[derive(Default, Serialize, JsonSchema)]
#[serde(tag = "kind", rename = "sample")]
#[schemars(extend("x-writer" = "vforward, vextract"))]
pub(super) struct SampleRecord {
    /// Name of the scene.
    scene: String,
    /// Name of the sample: that of its spectrum or photograph.
    id: String,
    /// Value of a perfect white diffuser that faces the sun, in its strongest channel, if it is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    exposure: Option<f64>,
    /// How a chart or a white card made the photograph's values those of the camera.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    calibration: Option<CalibrationRecord>,
    /// White paper beside the sheet, from which vestimate knows the exposure to a few per cent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    white_paper: Option<WhitePaperRecord>,
    /// The photograph.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    image: Option<ImageRecord>,
    /// Mean value of every facet, linear, white that faces the sun being the exposure. Absent beside an
    /// error.
    #[serde(skip_serializing_if = "Option::is_none")]
    facet_rgb: Option<ColoursRecord>,
    /// Standard deviation of the same, from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    facet_sd: Option<ColoursRecord>,
    /// Pixels that were averaged, a count per facet; one that facets share counts by its part.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    facet_pixels: Option<Vec<f64>>,
    /// Pixels left out because a channel is clipped, a count per facet.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    facet_clipped: Option<Vec<usize>>,
    /// Pixels left out because they are not finite or transparent, a count per facet.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    facet_not_finite: Option<Vec<usize>>,
    /// Pixels left out because they do not look like the rest of the facet, a count per facet.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    facet_outliers: Option<Vec<usize>>,
    /// Bounces of light that the facets' values are made of; all if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vforward"))]
    bounces: Option<BouncesRecord>,
    /// The true spectrum.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vforward, vscore"))]
    truth: Option<ReflectanceRecord>,
    /// Where the panels are in the picture that was taken: what `vextract --regions` reads.
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

/// The first bounces of light, where not all are counted.
#[derive(Serialize, JsonSchema)]
struct BouncesRecord {
    /// Number of bounces.
    count: u32,
    /// Largest share of a facet's value that the others would add.
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
