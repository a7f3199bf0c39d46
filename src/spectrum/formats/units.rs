//! Units of files that may not say theirs: nm or micrometres, fractions or percent.

use super::{Place, Spectrum};
use crate::error::Result;

/// The units in which wavelengths are written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Unit {
    Nanometres,
    Micrometres,
}

/// Wavelengths as a file has them, the first in line `first_line`, in nm; and a note if they were micrometres.
///
/// `header` may name the unit; if not, it is known by the size of the numbers.
///
/// # Errors
/// [`crate::Error::Table`] if numbers are not wavelengths, contradict the header or do not rise.
pub(super) fn to_nm(
    at: Place,
    header: &str,
    wavelengths: &[f64],
    first_line: usize,
) -> Result<(Vec<f64>, Option<&'static str>)> {
    let found = unit(header).unwrap_or(match wavelengths.first() {
        Some(first) if looks_small(*first) => Unit::Micrometres,
        _ => Unit::Nanometres,
    });
    let mut wavelengths_nm: Vec<f64> = Vec::with_capacity(wavelengths.len());
    for (value, line) in wavelengths.iter().zip(first_line..) {
        let at = Place { line, ..at };
        let nm = found.nm(*value, at)?;
        if let Some(before_nm) = wavelengths_nm.last().filter(|before_nm| **before_nm >= nm) {
            let problem = format!("wavelength {nm} nm follows {before_nm} nm");
            return Err(at.fails(problem, "sort the rows by wavelength and drop repeated ones"));
        }
        wavelengths_nm.push(nm);
    }
    Ok((wavelengths_nm, (found == Unit::Micrometres).then_some("micrometres read as nm")))
}

impl Unit {
    /// A wavelength in nm.
    fn nm(self, value: f64, at: Place) -> Result<f64> {
        let (nm, name, remedy) = match self {
            Self::Nanometres if looks_small(value) => {
                let problem = format!("wavelength {value} looks like micrometres, not nm");
                return Err(at.fails(problem, "give all in nm, or head them um"));
            }
            Self::Nanometres => (value, "nm", "give nm, such as 400 to 700"),
            // 0.57 um are 570 nm, and not a rounding error less
            Self::Micrometres => (
                (value * 1e9).round() / 1e6,
                "micrometres",
                "give micrometres, such as 0.4 to 0.7, or head them nm",
            ),
        };
        if (100.0..=3000.0).contains(&nm) {
            Ok(nm)
        } else {
            Err(at.fails(format!("wavelength {value} does not look like {name}"), remedy))
        }
    }
}

/// Whether a wavelength is about that of light in micrometres.
fn looks_small(value: f64) -> bool {
    (0.1..10.0).contains(&value)
}

fn unit(header: &str) -> Option<Unit> {
    let header = header.to_lowercase();
    header.split(|letter: char| !letter.is_alphanumeric()).find_map(|word| match word {
        "nm" | "nanometre" | "nanometres" | "nanometer" | "nanometers" => Some(Unit::Nanometres),
        // U+00B5, micro sign, and U+03BC, Greek mu
        "um" | "\u{b5}m" | "\u{3bc}m" | "micron" | "microns" => Some(Unit::Micrometres),
        "micrometre" | "micrometres" | "micrometer" | "micrometers" => Some(Unit::Micrometres),
        _ => None,
    })
}

/// Whether the name of a column says percent: `R [%]`, `reflectance_percent`; `50% grey` is a name.
pub(super) fn says_percent(column: &str) -> bool {
    let sign = column
        .split_once('%')
        .is_some_and(|(before, _)| !before.trim_end().ends_with(|c: char| c.is_ascii_digit()));
    let lower = column.to_lowercase();
    sign || lower
        .split(|letter: char| !letter.is_alphanumeric())
        .any(|word| word == "percent" || word == "pct")
}

/// Largest number that is a fraction badly scaled rather than percent.
const FRACTION_MAX: f64 = 2.0;
/// Largest number that can be a reflectance in percent, fluorescence included.
const PERCENT_MAX: f64 = 200.0;

/// Which of the reflectances of a file are in percent: what it `said`, else all of them if one has a value above 2.
///
/// # Errors
/// [`crate::Error::Table`] if percent were said and no value is above 1: fractions are more likely then.
pub(super) fn percent(path: &str, spectra: &[Spectrum], said: Option<&[bool]>) -> Result<Vec<bool>> {
    let peak = |spectra: &[&Spectrum]| {
        spectra.iter().flat_map(|spectrum| spectrum.values()).copied().fold(f64::NEG_INFINITY, f64::max)
    };
    let Some(said) = said else {
        let peak = peak(&spectra.iter().collect::<Vec<_>>());
        return Ok(vec![peak > FRACTION_MAX && peak <= PERCENT_MAX; spectra.len()]);
    };
    let percent: Vec<_> = spectra.iter().zip(said).filter(|(_, said)| **said).map(|(one, _)| one).collect();
    if !percent.is_empty() && peak(&percent) <= 1.0 {
        let problem = format!("column '{}' says percent, but no value is above 1", percent[0].name());
        let remedy = "take the word out of the header, or write fractions without it";
        return Err(Place { path, line: 1 }.fails(problem, remedy));
    }
    Ok(said.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: Place = Place { path: "x.csv", line: 1 };

    #[test]
    fn micrometres_are_known_by_word_or_size() {
        let um = [0.4, 0.405, 0.57, 0.7];
        for header in ["wavelength", "lambda [um]", "wavelength_\u{b5}m", "\u{3bc}m", "Microns"] {
            let (nm, note) = to_nm(AT, header, &um, 2).unwrap();
            assert_eq!(
                (nm.as_slice(), note.is_some()),
                (&[400.0, 405.0, 570.0, 700.0][..], true),
                "{header}"
            );
        }
        assert_eq!(to_nm(AT, "sum", &[400.0, 405.5], 2).unwrap(), (vec![400.0, 405.5], None));
        for (header, value) in [("nm", 0.4), ("um", 400.0), ("wavelength", 4000.0), ("wavelength", -400.0)] {
            assert!(to_nm(AT, header, &[value, 2.0 * value], 2).is_err(), "{header} {value}");
        }
    }

    #[test]
    fn percent_is_a_word_but_no_part_of_a_name() {
        for column in ["R [%]", "%R", "reflectance_percent", "Reflectance (Percent)", "r pct"] {
            assert!(says_percent(column), "{column}");
        }
        for column in ["50% grey", "50 % grey", "percentile", "red"] {
            assert!(!says_percent(column), "{column}");
        }
    }
}
