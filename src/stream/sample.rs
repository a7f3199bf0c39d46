//! A sample: one sheet's facet RGB, and the tools' results. Its fields are in files of their own.

use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::fields::{Fields, LARGEST, finite};
use crate::error::{Error, Result, counted};
use crate::spectrum::{Outside, Spectrum, WavelengthGrid};

/// Name of a sample without a name.
const UNNAMED: &str = "unnamed";

/// A sample record.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Its fields, including unknown ones.
    pub fields: Fields,
}

/// A reflectance at its own wavelengths.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema, PartialEq)]
pub struct ReflectanceRecord {
    /// Wavelengths, nm, increasing.
    pub wavelengths_nm: Vec<f64>,
    /// Reflectance, one per wavelength.
    #[schemars(inner(range(min = 0, max = 1)))]
    pub reflectance: Vec<f64>,
    /// How values were computed from those of its source, if they are not the same: `sprague` or `linear`
    /// interpolation, or the `average` of a light over wavebands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<String>,
    /// Total radiance factor of a sheet that fluoresces, in the light of the scene and without bounces: what
    /// it reflects and what it emits, relative to a perfect white diffuser, one number from 0 per wavelength.
    /// Absent for a sheet that does not fluoresce.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0)))]
    pub total_radiance_factor: Option<Vec<f64>>,
}

/// Rejects impossible reflectances in a field.
pub(super) fn checked(field: &str, reflectance: &[f64]) -> Result<()> {
    match reflectance.iter().find(|value| !(0.0..=1.0).contains(*value)) {
        Some(value) => Err(Error::field(field, format!("{value:e} is not a reflectance; give 0 to 1"))),
        None => Ok(()),
    }
}

/// Rejects impossible radiance factors in a field.
pub(super) fn checked_radiance<'a>(field: &str, factors: impl IntoIterator<Item = &'a f64>) -> Result<()> {
    match factors.into_iter().find(|value| !(0.0..=LARGEST).contains(*value)) {
        Some(value) => Err(Error::field(
            field,
            format!("{value:e} is not a fraction of white's light; give numbers from 0"),
        )),
        None => Ok(()),
    }
}

/// Rejects impossible standard deviations in a field.
pub(super) fn checked_deviations<'a>(field: &str, sd: impl IntoIterator<Item = &'a f64>) -> Result<()> {
    match sd.into_iter().find(|value| !(0.0..=LARGEST).contains(*value)) {
        Some(value) => {
            Err(Error::field(field, format!("{value:e} is not a standard deviation; give numbers from 0")))
        }
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
            total_radiance_factor: None,
        })
    }

    /// The total radiance factor: the reflectance, unless the sheet fluoresces.
    #[must_use]
    pub fn total_radiance_factor(&self) -> &[f64] {
        self.total_radiance_factor.as_ref().unwrap_or(&self.reflectance)
    }
}

impl Sample {
    /// The sample's name, which may also be a number. A missing name must not stop the other samples.
    #[must_use]
    pub fn id(&self) -> String {
        self.fields.text_at("id").ok().flatten().unwrap_or_else(|| UNNAMED.to_owned())
    }

    /// Sets the true spectrum.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_truth(&mut self, truth: &ReflectanceRecord) -> Result<()> {
        let total = truth.total_radiance_factor.iter().flatten();
        finite("truth", truth.reflectance.iter().chain(&truth.wavelengths_nm).chain(total))?;
        self.fields.set("truth", truth)
    }

    /// The true spectrum, if the sample carries it.
    ///
    /// # Errors
    /// [`Error::Field`] unless it is a spectrum of numbers from 0 to 1, and its total radiance factor one of
    /// numbers from 0.
    pub fn truth(&self) -> Result<Option<ReflectanceRecord>> {
        let truth: Option<ReflectanceRecord> = self.fields.get("truth")?;
        if let Some(ReflectanceRecord { wavelengths_nm, reflectance, total_radiance_factor, .. }) = &truth {
            checked("truth", reflectance)?;
            checked_radiance("truth.total_radiance_factor", total_radiance_factor.iter().flatten())?;
            if total_radiance_factor.as_ref().is_some_and(|total| total.len() != wavelengths_nm.len()) {
                let numbers = counted(wavelengths_nm.len(), "number");
                let problem = format!("needs {numbers}, one per wavelength");
                return Err(Error::field("truth.total_radiance_factor", problem));
            }
        }
        Ok(truth)
    }

    /// Marks the sample as failed.
    ///
    /// # Errors
    /// As [`Fields::set`].
    pub fn set_error(&mut self, error: &Error) -> Result<()> {
        self.fields.set("error", error.to_string())
    }

    /// The error of an earlier tool on this sample, if any.
    ///
    /// # Errors
    /// [`Error::Field`] if `error` is not text.
    pub fn error(&self) -> Result<Option<String>> {
        self.fields.get("error")
    }

    /// A result computed from the facets; none for a sample that carries an error, whatever an earlier run
    /// left there.
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
            Some(exposure) if !(exposure > 0.0 && exposure <= LARGEST) => {
                Err(Error::field("exposure", format!("{exposure} is out of range; give a number above 0")))
            }
            exposure => Ok(exposure),
        }
    }

    /// Whether the facets come from a photograph.
    #[must_use]
    pub fn is_photograph(&self) -> bool {
        self.fields.has("image")
    }
}
