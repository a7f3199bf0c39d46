//! The sample record: one sheet's facet RGB, and what the tools make of it.

use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::calibration::CalibrationRecord;
use super::colours::ColoursRecord;
use super::estimate::EstimateRecord;
use super::fields::{Fields, LARGEST, finite};
use super::named::Named;
use super::photograph::ImageRecord;
use super::regions::RegionsRecord;
use super::scores::ColourRecord;
use crate::error::{Error, Result};
use crate::forward::bounces::Truncation;
use crate::spectrum::{Outside, Spectrum, WavelengthGrid};

/// What a sample without a name is called.
const UNNAMED: &str = "unnamed";

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
    /// The photograph.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    image: Option<ImageRecord>,
    /// Mean value of every facet, linear, white that faces the sun being the exposure. Absent beside an error.
    #[serde(skip_serializing_if = "Option::is_none")]
    facet_rgb: Option<ColoursRecord>,
    /// Standard deviation of the same, from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    facet_sd: Option<ColoursRecord>,
    /// Pixels that were averaged, a number a facet; one that facets share counts by its part.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    facet_pixels: Option<Vec<f64>>,
    /// Pixels left out because a channel is clipped, a number a facet.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    facet_clipped: Option<Vec<usize>>,
    /// Pixels left out because they are not finite or transparent, a number a facet.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-writer" = "vextract"))]
    facet_not_finite: Option<Vec<usize>>,
    /// Pixels left out because they do not look like the rest of the facet, a number a facet.
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
    /// Scores of the estimate by name: rmse, ciede2000, pd, gfc, `angle_deg`, metamerism; `ciede2000_A` and the like under further
    /// illuminants.
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

/// A sample record.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Its fields, those that the tools do not know included.
    pub fields: Fields,
}

/// A reflectance on its own wavelengths.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema, PartialEq)]
pub struct ReflectanceRecord {
    /// Wavelengths, nm, increasing.
    pub wavelengths_nm: Vec<f64>,
    /// Reflectance, a number a wavelength.
    #[schemars(inner(range(min = 0, max = 1)))]
    pub reflectance: Vec<f64>,
    /// How it was found between samples, where it was: `sprague` or `linear`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<String>,
}

/// Refuses what cannot be the reflectance in a field.
pub(super) fn checked(field: &str, reflectance: &[f64]) -> Result<()> {
    match reflectance.iter().find(|value| !(0.0..=1.0).contains(*value)) {
        Some(value) => Err(Error::field(field, format!("{value:e} is no reflectance; it needs 0 to 1"))),
        None => Ok(()),
    }
}

impl ReflectanceRecord {
    /// A spectrum on the wavelengths of `grid`.
    ///
    /// # Errors
    /// As [`Spectrum::on`].
    pub fn on(spectrum: &Spectrum, grid: &WavelengthGrid) -> Result<Self> {
        Ok(Self {
            wavelengths_nm: grid.wavelengths_nm().to_vec(),
            reflectance: spectrum.on(grid, Outside::Refuse)?,
            interpolation: spectrum.interpolation(grid).map(|found| found.name().to_owned()),
        })
    }
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

    /// The sample's name; a number is one, too. One sample without a name is no reason to stop with all others.
    #[must_use]
    pub fn id(&self) -> String {
        self.fields.text_at("id").ok().flatten().unwrap_or_else(|| UNNAMED.to_owned())
    }

    /// Says how many bounces of light the facets' values are made of.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_bounces(&mut self, truncation: &Truncation) -> Result<()> {
        let Truncation { count, missing } = *truncation;
        finite("bounces.missing", [&missing])?;
        self.fields.set("bounces", BouncesRecord { count, missing })
    }

    /// Sets the true spectrum.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_truth(&mut self, truth: &ReflectanceRecord) -> Result<()> {
        finite("truth", truth.reflectance.iter().chain(&truth.wavelengths_nm))?;
        self.fields.set("truth", truth)
    }

    /// The true spectrum, if the sample carries it.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a spectrum of numbers from 0 to 1.
    pub fn truth(&self) -> Result<Option<ReflectanceRecord>> {
        let truth: Option<ReflectanceRecord> = self.fields.get("truth")?;
        truth.iter().try_for_each(|truth| checked("truth", &truth.reflectance))?;
        Ok(truth)
    }

    /// Marks the sample as failed.
    ///
    /// # Errors
    /// As [`Fields::set`].
    pub fn set_error(&mut self, error: &Error) -> Result<()> {
        self.fields.set("error", error.to_string())
    }

    /// What went wrong with this sample in an earlier tool, if anything did.
    ///
    /// # Errors
    /// [`Error::Field`] if `error` is not text.
    pub fn error(&self) -> Result<Option<String>> {
        self.fields.get("error")
    }

    /// A field that is made of the facets; a sample that carries an error has none, whatever an earlier run left there.
    pub(super) fn made<T: DeserializeOwned>(&self, name: &str) -> Result<Option<T>> {
        match self.error()? {
            Some(_) => Ok(None),
            None => self.fields.get(name),
        }
    }

    /// The exposure at which the facets were computed or calibrated, if it is known.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a number above 0.
    pub fn exposure(&self) -> Result<Option<f64>> {
        match self.fields.get("exposure")? {
            Some(exposure) if !(exposure > 0.0 && exposure <= LARGEST) => Err(Error::field(
                "exposure",
                format!("{exposure} gives no picture; it needs a number above 0"),
            )),
            exposure => Ok(exposure),
        }
    }

    /// Whether the facets come from a photograph.
    #[must_use]
    pub fn is_photograph(&self) -> bool {
        self.fields.has("image")
    }
}
