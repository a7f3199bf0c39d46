//! An estimate's statement on light emitted by the sheet.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fields::finite;
use crate::error::Result;
use crate::estimate::fluorescence::Fluorescence;

/// Light that the sheet sends out where it takes in light of shorter wavelengths, under the light of the
/// scene.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct FluorescenceRecord {
    /// Probability that there is any.
    #[schemars(range(min = 0, max = 1))]
    pub probability: f64,
    /// Wavelength at which most is sent out, nm.
    pub peak_nm: f64,
    /// What is sent out there, as a fraction of a white that reflects all light.
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
    /// Probability that there is any.
    #[schemars(range(min = 0, max = 1))]
    probability: f64,
    /// What is sent out in the waveband with most of it, as a fraction of white.
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
