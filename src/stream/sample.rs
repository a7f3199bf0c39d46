//! The sample record: one sheet's facet RGB, and what the tools make of it.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::fields::{Fields, finite};
use crate::colorimetry::Colour;
use crate::error::{Error, Result};
use crate::forward::bounces::Truncation;
use crate::plot::spectra::Curve;
use crate::score::{Group, Score, Statistics, Summary};
use crate::spectrum::formats::Measured;
use crate::spectrum::{Outside, Spectrum, WavelengthGrid};

/// Largest value of a exposure that is read: products and squares of such numbers stay finite.
const LARGEST: f64 = 1e30;

/// A sample record.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Its fields, those that the tools do not know included.
    pub fields: Fields,
}

/// A true or estimated reflectance, on its own wavelengths.
#[derive(Clone, Debug, Serialize, Deserialize, PartialEq)]
pub struct ReflectanceRecord {
    /// Wavelengths, nm.
    pub wavelengths_nm: Vec<f64>,
    /// Reflectance a wavelength.
    pub reflectance: Vec<f64>,
    /// How it was found between samples, where it was: `sprague` or `linear`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<String>,
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
        let mut fields = Fields::of_kind("sample");
        fields.set("scene", scene)?;
        fields.set("id", id)?;
        Ok(Self { fields })
    }

    /// The sample's name.
    ///
    /// # Errors
    /// [`Error::Field`] if it has none.
    pub fn id(&self) -> Result<String> {
        self.fields.require("id", "vforward and vextract name their samples")
    }

    /// Says how many bounces of light the facets' values are made of.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_bounces(&mut self, truncation: &Truncation) -> Result<()> {
        let Truncation { count, missing } = truncation;
        finite("bounces.missing", [missing])?;
        self.fields.set("bounces", json!({ "count": count, "missing": missing }))
    }

    /// Sets the true spectrum.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_truth(&mut self, truth: &ReflectanceRecord) -> Result<()> {
        finite("truth", truth.reflectance.iter().chain(&truth.wavelengths_nm))?;
        self.fields.set("truth", truth)
    }

    /// The estimate as a curve to draw; none if there is none.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a spectrum.
    pub fn curve(&self) -> Result<Option<Curve>> {
        let Some(estimate) = self.estimated()? else { return Ok(None) };
        Ok(Some(Curve {
            name: self.id()?,
            wavelengths_nm: estimate.wavelengths_nm,
            reflectance: estimate.reflectance,
            reflectance_sd: self.estimated_sd()?,
            truth: self.truth()?.map(|truth| (truth.wavelengths_nm, truth.reflectance)),
        }))
    }

    /// The estimate as a file of spectra has it; none if there is none.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a spectrum.
    pub fn measured(&self) -> Result<Option<Measured>> {
        let Some(estimate) = self.estimated()? else { return Ok(None) };
        let (wavelengths_nm, reflectance) = (estimate.wavelengths_nm, estimate.reflectance);
        let reflectance_sd = self.estimated_sd()?;
        let lengths = reflectance_sd.iter().map(Vec::len).chain([wavelengths_nm.len()]);
        if wavelengths_nm.len() < 2 || lengths.into_iter().any(|length| length != reflectance.len()) {
            return Err(Error::field(
                "estimate",
                "not as many values as wavelengths, two or more; estimate it again",
            ));
        }
        Ok(Some(Measured { name: self.id()?, wavelengths_nm, reflectance, reflectance_sd }))
    }

    /// The true spectrum, if the sample carries it.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a spectrum of numbers from 0 to 1.
    pub fn truth(&self) -> Result<Option<ReflectanceRecord>> {
        self.reflectance("truth")
    }

    /// The reflectance in a field, if it is there.
    pub(super) fn reflectance(&self, field: &str) -> Result<Option<ReflectanceRecord>> {
        let record: Option<ReflectanceRecord> = self.fields.get(field)?;
        let values = record.iter().flat_map(|record| &record.reflectance);
        match values.into_iter().find(|value| !(0.0..=1.0).contains(*value)) {
            Some(value) => Err(Error::field(field, format!("{value:e} is no reflectance; it needs 0 to 1"))),
            None => Ok(record),
        }
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
    ///
    /// # Errors
    /// [`Error::Field`] if `image` is not an object.
    pub fn is_photograph(&self) -> Result<bool> {
        Ok(self.fields.get::<serde::de::IgnoredAny>("image")?.is_some())
    }

    /// Adds scores.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_scores(&mut self, scores: &[Score]) -> Result<()> {
        finite("metrics", scores.iter().map(|score| &score.value))?;
        let record = scores.iter().map(|score| (score.name.clone(), json!(score.value)));
        self.fields.set("metrics", record.collect::<Map<String, Value>>())
    }

    /// The sample's scores, if it has any.
    ///
    /// # Errors
    /// [`Error::Field`] if they are not numbers.
    pub fn scores(&self) -> Result<Option<Vec<Score>>> {
        let record: Option<Map<String, Value>> = self.fields.get("metrics")?;
        let score = |(name, value): (String, Value)| {
            let number =
                value.as_f64().ok_or_else(|| Error::field(format!("metrics.{name}"), "not a number"));
            number.map(|value| Score { name, value })
        };
        record.map(|record| record.into_iter().map(score).collect()).transpose()
    }

    /// Adds the colour of the estimate, under the illuminant of this name, and its standard deviations; `exact` if they come from a
    /// covariance, else they are the largest possible.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_colour(
        &mut self,
        (illuminant, observer): (&str, &str),
        colour: &Colour,
        sd: Option<&Colour>,
        exact: bool,
    ) -> Result<()> {
        let mut record = json!({ "illuminant": illuminant, "observer": observer });
        for (ending, Colour { xyz, lab, srgb }) in
            std::iter::once(("", colour)).chain(sd.map(|sd| ("_sd", sd)))
        {
            finite("colour", xyz.iter().chain(lab).chain(srgb))?;
            for (name, value) in [("xyz", xyz), ("lab", lab), ("srgb", srgb)] {
                record[format!("{name}{ending}")] = json!(value);
            }
        }
        if sd.is_some() {
            record["sd_from"] = json!(if exact { "covariance" } else { "reflectance_sd, at most" });
        }
        self.fields.set("colour", record)
    }
}

/// The record that ends a scored stream: how many samples, and the mean, median and worst of each score; the same of each group of
/// samples that share the value of a field, if they are grouped `by` one.
///
/// # Errors
/// As [`Fields::set`].
pub fn summary(all: &Summary, by: Option<(&str, &[Group])>) -> Result<Fields> {
    let mut fields = Fields::of_kind("summary");
    fields.0.extend(summarised(all));
    if let Some((field, groups)) = by {
        fields.set("by", field)?;
        let group = |Group { value, summary }: &Group| {
            let mut record = Map::new();
            record.insert("value".to_owned(), json!(value));
            record.extend(summarised(summary));
            record
        };
        fields.set("groups", groups.iter().map(group).collect::<Vec<_>>())?;
    }
    Ok(fields)
}

fn summarised(summary: &Summary) -> Map<String, Value> {
    let counts = [("samples", summary.samples()), ("scored", summary.scored())];
    let counts = counts.into_iter().map(|(name, count)| (name.to_owned(), json!(count)));
    let statistics = summary.statistics().into_iter().map(|Statistics { name, mean, median, worst }| {
        (name, json!({ "mean": mean, "median": median, "worst": worst }))
    });
    counts.chain(statistics).collect()
}
