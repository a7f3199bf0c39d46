//! CIE daylight of any colour temperature.
//!
//! CIE 15:2018, section 4.1.2: chromaticity from the temperature, then a mean and two characteristic vectors
//! of measured daylight, S(λ) = S0(λ) + M1 S1(λ) + M2 S2(λ).

use std::sync::OnceLock;

use super::Spectrum;
use super::tables::builtin;
use crate::error::{Error, Result};

/// Daylight of the correlated colour temperature `cct_k`, in K, 100 at 560 nm, on 300..830 nm.
///
/// The temperature is the actual one: D65 is `daylight:6504`, D50 is `daylight:5003`, because the constant c2
/// of Planck's law changed by 1.4388/1.4380 after those illuminants were named.
///
/// # Errors
/// [`Error::Spectrum`] outside 4000..25000 K, where the formulae are not defined.
pub(super) fn daylight(cct_k: f64) -> Result<Spectrum> {
    let name = format!("daylight:{cct_k}");
    if !(4000.0..=25000.0).contains(&cct_k) {
        let remedy = "choose a temperature in that range, or A for light bulbs";
        return Err(Error::spectrum(name, "CIE daylight is defined for 4000..25000 K", remedy));
    }
    let (m1, m2) = weights(chromaticity(cct_k));
    let basis = basis()?;
    let [s0, s1, s2] = [0, 1, 2].map(|i| basis[i].values());
    let values = s0.iter().zip(s1).zip(s2).map(|((s0, s1), s2)| s0 + m1 * s1 + m2 * s2).collect();
    // CIE 15 interpolates the values linearly
    Ok(Spectrum::from_table(name, basis[0].wavelengths_nm.clone(), values).linear())
}

/// M1 and M2 of daylight as smooth functions of the correlated colour temperature `cct_k`, in K.
#[must_use]
pub fn daylight_weights(cct_k: f64) -> [f64; 2] {
    let (m1, m2) = exact_weights(chromaticity(cct_k));
    [m1, m2]
}

/// Extends a light that is one of the CIE's daylight illuminants, which are tabulated here from 380 nm, to
/// 300 nm by the formulae for its temperature; returns any other light unchanged.
///
/// # Errors
/// [`Error::Spectrum`] if a table is damaged.
///
/// # Example
/// ```
/// use vfold::spectrum::{illuminant, in_ultraviolet};
/// assert_eq!(in_ultraviolet(illuminant("D65")?)?.range_nm().0, 300.0);
/// assert_eq!(in_ultraviolet(illuminant("FL1")?)?.range_nm().0, 380.0);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn in_ultraviolet(light: Spectrum) -> Result<Spectrum> {
    let Some((_, cct_k)) = ILLUMINANTS.iter().find(|(name, _)| *name == light.name()) else {
        return Ok(light);
    };
    let whole = daylight(*cct_k)?;
    let (first_nm, _) = light.range_nm();
    let start = whole.wavelengths_nm().partition_point(|nm| *nm < first_nm);
    // a file may have the same name but other units
    let is_same = whole.values().get(start).is_some_and(|value| (value - light.values()[0]).abs() < ROUNDING);
    if !is_same {
        return Ok(light);
    }
    let joined = |below: &[f64], own: &[f64]| below.iter().chain(own).copied().collect::<Vec<_>>();
    Ok(Spectrum {
        wavelengths_nm: joined(&whole.wavelengths_nm()[..start], light.wavelengths_nm()).into(),
        values: joined(&whole.values()[..start], light.values()),
        ..light
    })
}

/// The CIE's daylight illuminants, with the temperatures at which the formulae reproduce them, K.
const ILLUMINANTS: [(&str, f64); 5] =
    [("D50", 5003.0), ("D55", 5503.0), ("D60", 6003.0), ("D65", 6504.0), ("D75", 7504.0)];
/// Largest difference between their tables and the formulae.
const ROUNDING: f64 = 0.06;

/// Mean daylight and its characteristic vectors, S0, S1 and S2.
///
/// # Errors
/// [`Error::Spectrum`] if the table is damaged.
pub fn daylight_vectors() -> Result<[Spectrum; 3]> {
    let basis = basis()?;
    Ok([0, 1, 2].map(|i| basis[i].clone().linear()))
}

/// Mean daylight and its characteristic vectors, parsed once.
fn basis() -> Result<&'static [Spectrum]> {
    static BASIS: OnceLock<Vec<Spectrum>> = OnceLock::new();
    if let Some(basis) = BASIS.get() {
        return Ok(basis);
    }
    let table = builtin("share/daylight.csv", include_str!("../../share/daylight.csv"))?;
    Ok(BASIS.get_or_init(|| table))
}

/// CIE 1931 (x, y) of daylight.
fn chromaticity(cct_k: f64) -> (f64, f64) {
    let [c3, c2, c1, c0] = if cct_k <= 7000.0 {
        [-4.6070e9, 2.9678e6, 0.09911e3, 0.244063]
    } else {
        [-2.0064e9, 1.9018e6, 0.24748e3, 0.237040]
    };
    let x = ((c3 / cct_k + c2) / cct_k + c1) / cct_k + c0;
    (x, (-3.0 * x + 2.870) * x - 0.275)
}

/// M1 and M2, rounded to three decimals as CIE 15 requires.
fn weights(chromaticity: (f64, f64)) -> (f64, f64) {
    let (m1, m2) = exact_weights(chromaticity);
    ((m1 * 1e3).round() / 1e3, (m2 * 1e3).round() / 1e3)
}

fn exact_weights((x, y): (f64, f64)) -> (f64, f64) {
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    let m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
    let m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
    (m1, m2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Outside, WavelengthGrid, illuminant};

    /// Frozen from colour-science 0.4.7: `sd_CIE_illuminant_D_series(CCT_to_xy_CIE_D(T))`.
    #[test]
    fn agrees_with_colour_science() {
        let grid = WavelengthGrid::new(vec![400.0, 455.0, 560.0, 700.0]).unwrap();
        for (cct_k, want) in [
            (4000.0, [26.3733, 65.9468, 100.0, 121.4557]),
            (5500.0, [60.9021, 99.18525, 100.0, 82.8818]),
            (7000.0, [92.5947, 125.30995, 100.0, 67.9638]),
            (7001.0, [92.6381, 125.3442, 100.0, 67.9505]),
            (25000.0, [219.1433, 220.398, 100.0, 51.5249]),
        ] {
            let got = daylight(cct_k).unwrap().on(&grid, Outside::Refuse).unwrap();
            for (got, want) in got.iter().zip(want) {
                assert!((got - want).abs() < 1e-9, "{cct_k} K: {got} for {want}");
            }
        }
    }

    /// The standard illuminants were tabulated by the same formulae.
    #[test]
    fn meets_the_standard_illuminants() {
        let grid = WavelengthGrid::uniform(380.0, 780.0, 5.0).unwrap();
        for (cct_k, name) in [(5003.0, "D50"), (5503.0, "D55"), (6504.0, "D65"), (7504.0, "D75")] {
            let ours = daylight(cct_k).unwrap().on(&grid, Outside::Refuse).unwrap();
            let theirs = illuminant(name).unwrap().on(&grid, Outside::Refuse).unwrap();
            for (a, b) in ours.iter().zip(&theirs) {
                assert!((a - b).abs() < 0.06, "{name}: {a} for {b}");
            }
        }
    }

    #[test]
    fn refuses_temperatures_without_daylight() {
        for cct_k in [3999.0, 25001.0, f64::NAN] {
            assert!(daylight(cct_k).is_err());
        }
    }
}
