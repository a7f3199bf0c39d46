//! An estimate's statement on light emitted by the sheet.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fields::finite;
use crate::error::Result;
use crate::estimate::fluorescence::Fluorescence;

/// Fluorescence: light that the sheet emits because it absorbs light of shorter wavelengths, in the light of
/// the scene.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct FluorescenceRecord {
    /// Probability that the sheet fluoresces.
    #[schemars(range(min = 0, max = 1))]
    pub probability: f64,
    /// Wavelength at which the sheet emits most, nm.
    pub peak_nm: f64,
    /// What it emits at that wavelength, relative to the light that a perfect white diffuser reflects there.
    #[schemars(range(min = 0))]
    pub size: f64,
    /// Standard deviation of the size.
    #[schemars(range(min = 0))]
    pub size_sd: f64,
}

impl FluorescenceRecord {
    /// The record of a sheet's fluorescence.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn of(found: &Fluorescence) -> Result<Self> {
        let &Fluorescence { probability, peak_nm, size, size_sd, .. } = found;
        finite("estimate.fluorescence", [&probability, &size, &size_sd])?;
        Ok(Self { probability, peak_nm, size, size_sd })
    }
}

/// Light from behind that comes through a thin sheet, added to what it reflects.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub(super) struct LightThroughRecord {
    /// Probability that any light comes through.
    #[schemars(range(min = 0, max = 1))]
    probability: f64,
    /// The light through the sheet in the waveband with most of it, relative to the light that a perfect
    /// white diffuser reflects.
    #[schemars(range(min = 0))]
    size: f64,
    /// Standard deviation of the size.
    #[schemars(range(min = 0))]
    size_sd: f64,
}

impl LightThroughRecord {
    /// The record of light through a sheet.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a number is not finite.
    pub fn of(found: &Fluorescence) -> Result<Self> {
        let &Fluorescence { probability, size, size_sd, .. } = found;
        finite("estimate.light_through", [&probability, &size, &size_sd])?;
        Ok(Self { probability, size, size_sd })
    }
}
