//! The 1269 matte chips of the Munsell book, measured at the University of Eastern Finland.
//!
//! The set behind the Parkkinen basis of the paper's section 5C, 380..780 nm by 5. `share/make-munsell.rs`
//! exported the arrays from the crate `colorimetry`.

use super::{Spectrum, WavelengthGrid};
use crate::error::{Error, Result};
use std::sync::Arc;

const NAMES: &str = include_str!("../../share/munsell1269.txt");
const REFLECTANCES: &[u8] = include_bytes!("../../share/munsell1269.npy");
/// Unit of the reflectances in the array, as a fraction of 1.
const UNIT: f64 = 1.0 / 50_000.0;

/// All chips, named like `munsell:5R6/12`, in the order of the book.
///
/// # Errors
/// Only if the embedded array is damaged.
pub(super) fn chips() -> Result<Vec<Spectrum>> {
    let units: Vec<u16> = npyz::NpyFile::new(REFLECTANCES)
        .and_then(npyz::NpyFile::into_vec)
        .map_err(|e| Error::file("share/munsell1269.npy", e))?;
    let wavelengths_nm: Arc<[f64]> = WavelengthGrid::uniform(380.0, 780.0, 5.0)?.wavelengths_nm().into();
    let chip = |(name, units): (&str, &[u16])| {
        let reflectance = units.iter().map(|&unit| f64::from(unit) * UNIT).collect();
        Spectrum::from_table(format!("munsell:{name}"), wavelengths_nm.clone(), reflectance).linear()
    };
    Ok(NAMES.lines().zip(units.chunks_exact(wavelengths_nm.len())).map(chip).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use colorimetry::colorant::MunsellCollection;

    /// The crate stores single precision.
    #[test]
    fn equal_the_crates_chips() {
        let chips = chips().unwrap();
        assert_eq!(chips.len(), MunsellCollection::len());
        for (ours, theirs) in chips.iter().zip(MunsellCollection) {
            assert_eq!(ours.name(), format!("munsell:{}", theirs.key()));
            for (i, &value) in ours.values().iter().enumerate() {
                let want = theirs.spectrum().as_array()[5 * i];
                assert!((value - want).abs() < 1e-7, "{} at {} nm: {value}", theirs.key(), 380 + 5 * i);
            }
        }
    }
}
