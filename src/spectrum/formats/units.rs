//! Units of files that may not state them: nm, micrometres or ångström, fractions or percent.

use super::place::Place;
use crate::error::{Error, Result};
use crate::spectrum::Spectrum;
use crate::spectrum::names::words;

/// Units of wavelength in files.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Unit {
    Nanometres,
    Micrometres,
    Angstroms,
}

/// Converts the wavelengths of a file, the first of which is in line `first_line`, to nm; adds a note if they
/// were in another unit.
///
/// `header` may name the unit; otherwise it is inferred from the size of the numbers.
///
/// # Errors
/// [`crate::Error::Table`] if numbers are not wavelengths, contradict the header or do not increase.
pub(super) fn to_nm(
    at: Place,
    header: &str,
    wavelengths: &[f64],
    first_line: usize,
) -> Result<(Vec<f64>, Option<&'static str>)> {
    if is_other_axis(header) {
        let problem = format!("column '{header}' does not hold wavelengths");
        return Err(at.fails(problem, "give wavelengths in nm"));
    }
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
    Ok((wavelengths_nm, found.note()))
}

impl Unit {
    /// Note on the conversion of wavelengths in this unit.
    fn note(self) -> Option<&'static str> {
        match self {
            Self::Nanometres => None,
            Self::Micrometres => Some("micrometres read as nm"),
            Self::Angstroms => Some("\u{e5}ngstr\u{f6}m read as nm"),
        }
    }

    /// A wavelength in nm.
    fn nm(self, value: f64, at: Place) -> Result<f64> {
        let (nm, name, remedy) = match self {
            Self::Nanometres if looks_small(value) => {
                let problem = format!("wavelength {value} looks like micrometres, not nm");
                return Err(at.fails(problem, "give all in nm, or put um in the header"));
            }
            Self::Nanometres => (value, "nm", "give nm, such as 400 to 700"),
            // 0.57 um is exactly 570 nm, without a rounding error
            Self::Micrometres => (
                (value * 1e9).round() / 1e6,
                "micrometres",
                "give micrometres, such as 0.4 to 0.7, or put nm in the header",
            ),
            Self::Angstroms => (
                value / 10.0,
                "\u{e5}ngstr\u{f6}m",
                "give \u{e5}ngstr\u{f6}m, such as 4000 to 7000, or put nm in the header",
            ),
        };
        if (100.0..=3000.0).contains(&nm) {
            Ok(nm)
        } else {
            Err(at.fails(format!("wavelength {value} does not look like {name}"), remedy))
        }
    }
}

/// True if a wavelength is of the size of light's in micrometres.
fn looks_small(value: f64) -> bool {
    (0.1..10.0).contains(&value)
}

fn unit(header: &str) -> Option<Unit> {
    words(header).find_map(|word| match word.as_str() {
        "nm" | "nanometre" | "nanometres" | "nanometer" | "nanometers" => Some(Unit::Nanometres),
        // U+00B5, micro sign, and U+03BC, Greek mu
        "um" | "\u{b5}m" | "\u{3bc}m" | "micron" | "microns" => Some(Unit::Micrometres),
        "micrometre" | "micrometres" | "micrometer" | "micrometers" => Some(Unit::Micrometres),
        // U+00E5; U+212B, the sign, is the same in lower case
        "\u{e5}" | "\u{e5}ngstr\u{f6}m" | "angstrom" | "angstroms" | "angstroem" => Some(Unit::Angstroms),
        _ => None,
    })
}

/// True if the name of a column says that it holds wavelengths.
pub(super) fn is_of_wavelengths(column: &str) -> bool {
    const NAMES: [&str; 6] = ["wavelength", "wavelengths", "wl", "lambda", "\u{3bb}", "wavelen"];
    unit(column).is_some() || words(column).any(|word| NAMES.contains(&word.as_str()))
}

/// True if the name of a column denotes another spectral axis: frequency, photon energy, wavenumber.
fn is_other_axis(column: &str) -> bool {
    const NAMES: [&str; 8] = ["thz", "ghz", "hz", "ev", "frequency", "energy", "wavenumber", "wavenumbers"];
    let per_cm = column.to_lowercase().replace([' ', '^'], "");
    let is_wavenumber = ["cm-1", "1/cm", "cm\u{207b}\u{b9}"].iter().any(|unit| per_cm.contains(unit));
    is_wavenumber || words(column).any(|word| NAMES.contains(&word.as_str()))
}

/// Unit of reflectances.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Scale {
    /// Not stated: inferred from the numbers, if possible.
    #[default]
    Unstated,
    Fraction,
    Percent,
    /// The name has a percent sign that may be a part of it.
    Unclear,
}

/// The unit stated by the name of a column: `R [%]`, `Sample1 %` and `reflectance_percent` are in percent,
/// `50% grey` is just a name, and `grey 50%` may be either.
pub(super) fn scale(column: &str) -> Scale {
    if words(column).any(|word| word == "percent" || word == "pct") {
        return Scale::Percent;
    }
    let Some((before, after)) = column.split_once('%') else { return Scale::Unstated };
    let number = before.trim_end();
    let is_number = number.rsplit(char::is_whitespace).next().is_some_and(|word| word.parse::<f64>().is_ok());
    match after.chars().any(char::is_alphanumeric) {
        _ if !is_number => Scale::Percent,
        true => Scale::Unstated,
        // `Sample 1 %` is a numbered sample
        false if number != before => Scale::Percent,
        false => Scale::Unclear,
    }
}

/// Largest number that may be a badly scaled fraction rather than percent.
const FRACTION_MAX: f64 = 2.0;
/// Largest possible reflectance in percent, including fluorescence.
const PERCENT_MAX: f64 = 200.0;

/// Which reflectances of a file are in percent: as the file states for each, else as `stated` for all, else
/// all of them if one has a value above 2.
///
/// # Errors
/// [`crate::Error::Spectrum`] if the unit remains ambiguous.
pub(super) fn percent(
    path: &str,
    spectra: &[Spectrum],
    scales: &[Scale],
    stated: Option<bool>,
) -> Result<Vec<bool>> {
    let is_open = |scale: &Scale| matches!(scale, Scale::Unstated | Scale::Unclear);
    let open = || spectra.iter().zip(scales).filter(|(_, scale)| is_open(scale));
    let peak = open().flat_map(|(spectrum, _)| spectrum.values()).copied().fold(f64::NEG_INFINITY, f64::max);
    let is_percent = match stated {
        Some(stated) => stated,
        // if some are stated to be percent, the others are fractions
        None if scales.contains(&Scale::Percent) => false,
        None => peak > FRACTION_MAX && peak <= PERCENT_MAX,
    };
    if stated.is_none() && !is_percent {
        if let Some((spectrum, _)) = open().find(|(_, scale)| **scale == Scale::Unclear) {
            let problem = format!("the name '{}' may mean percent, or be only a name", spectrum.name());
            return Err(Error::spectrum(
                path,
                problem,
                "give --percent, or --percent=no if the values are fractions",
            ));
        }
        if peak > 1.0 && peak <= FRACTION_MAX {
            let problem = format!("reflectance {peak} is outside 0..1, unless it is percent of a dark sheet");
            let remedy =
                "give --percent if it is, else leave out fluorescent samples or rescale wrongly scaled ones";
            return Err(Error::spectrum(path, problem, remedy));
        }
    }
    Ok(scales.iter().map(|scale| *scale == Scale::Percent || is_open(scale) && is_percent).collect())
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
    fn other_axes_are_no_wavelengths() {
        let (nm, note) = to_nm(AT, "Wavelength (\u{212b})", &[3800.0, 5700.0], 2).unwrap();
        assert_eq!((nm, note), (vec![380.0, 570.0], Some("\u{e5}ngstr\u{f6}m read as nm")));
        for header in
            ["Frequency (THz)", "Photon energy [eV]", "wavenumber", "cm-1", "1/\u{3bb} (cm\u{207b}\u{b9})"]
        {
            let message = to_nm(AT, header, &[430.0, 790.0], 2).unwrap_err().to_string();
            assert!(message.contains("does not hold wavelengths"), "{message}");
        }
    }

    #[test]
    fn percent_is_a_word_but_no_part_of_a_name() {
        for (column, want) in [
            ("R [%]", Scale::Percent),
            ("%R", Scale::Percent),
            ("%", Scale::Percent),
            ("reflectance_percent", Scale::Percent),
            ("Reflectance (Percent)", Scale::Percent),
            ("r pct", Scale::Percent),
            ("Sample1 %", Scale::Percent),
            ("Sample 1 %", Scale::Percent),
            ("Sample1%", Scale::Percent),
            ("1 [%]", Scale::Percent),
            ("50% grey", Scale::Unstated),
            ("50 % grey", Scale::Unstated),
            ("percentile", Scale::Unstated),
            ("red", Scale::Unstated),
            ("grey 50%", Scale::Unclear),
        ] {
            assert_eq!(scale(column), want, "{column}");
        }
    }
}
