//! Light of a black body, such as the filament of a lamp: Planck's law.

use super::Spectrum;
use super::grid::WavelengthGrid;
use crate::error::{Error, Result};

/// Second radiation constant, nm K, as used in colorimetry (CIE 15:2018, section 4.1.1; hc/k is 0.002 %
/// less).
const C2_NM_K: f64 = 1.438_8e7;
/// Temperatures of glowing bodies, K.
const TEMPERATURES_K: std::ops::RangeInclusive<f64> = 1000.0..=25000.0;

/// The temperature in a name such as `2856K`, K.
pub(super) fn temperature_k(name: &str) -> Option<f64> {
    name.strip_suffix(['K', 'k'])?.trim().parse().ok().filter(|kelvin: &f64| kelvin.is_finite())
}

/// Relative power of a black body of `temperature_k`, 100 at 560 nm, on 300..830 nm by 5.
///
/// # Errors
/// [`crate::Error::Spectrum`] outside 1000..25000 K.
pub(super) fn black_body(temperature_k: f64) -> Result<Spectrum> {
    let name = format!("{temperature_k}K");
    if !TEMPERATURES_K.contains(&temperature_k) {
        let problem = "black bodies are computed for 1000..25000 K";
        return Err(Error::spectrum(&name, problem, "choose a temperature in that range"));
    }
    let power = |nm: f64| nm.powi(-5) / (C2_NM_K / (nm * temperature_k)).exp_m1();
    let grid = WavelengthGrid::uniform(300.0, 830.0, 5.0)?;
    let values = grid.wavelengths_nm().iter().map(|nm| 100.0 * power(*nm) / power(560.0)).collect();
    Ok(Spectrum::from_table(name, grid.wavelengths_nm().into(), values))
}
