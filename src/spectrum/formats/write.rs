//! Writing estimated spectra: CSV with standard deviations, CGATS and IES TM-27 without.

use std::collections::HashSet;
use std::iter;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use super::csv::{SD_ENDING, deviation_of, literal};
use super::{cgats, has_ending, tm27};
use crate::error::{Error, Result};
use crate::files::Saved;
use crate::message::printable;

/// A measured reflectance.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Its name.
    pub name: String,
    /// Wavelengths, nm.
    pub wavelengths_nm: Vec<f64>,
    /// Reflectance per wavelength, 0..1.
    pub reflectance: Vec<f64>,
    /// Standard deviation of each, if known.
    pub reflectance_sd: Option<Vec<f64>>,
}

/// Writes reflectances, complete or not at all, in the format of the file's ending: `.csv` with one column
/// per sample followed by that of its standard deviation (`red`, `red_sd`), and a `'` before names that a
/// spreadsheet would take for a formula; CGATS `.sp` as read by Argyll CMS, in percent; IES TM-27-14 `.spdx`
/// for one sample.
///
/// # Errors
/// [`Error::Usage`] for other endings; [`Error::Spectrum`] if there is no sample, several for `.spdx`, or if
/// wavelengths differ, or are uneven in a format with one step for all; [`Error::File`] if the file cannot be
/// written.
///
/// # Example
/// ```
/// use vfold::spectrum::formats::{Measured, write};
/// let grey = Measured {
///     name: "grey".to_owned(),
///     wavelengths_nm: vec![400.0, 700.0],
///     reflectance: vec![0.5, 0.25],
///     reflectance_sd: Some(vec![0.125, 0.0625]),
/// };
/// let file = tempfile::Builder::new().suffix(".csv").tempfile().unwrap();
/// write(file.path(), &[grey])?;
/// assert_eq!(
///     std::fs::read_to_string(file.path()).unwrap(),
///     "wavelength_nm,grey,grey_sd\n400,0.5,0.125\n700,0.25,0.0625\n"
/// );
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn write(path: &Path, samples: &[Measured]) -> Result<()> {
    let bytes = match (format(path)?, samples) {
        (_, []) => return Err(unfit(path, "there is no estimate to write", "check the samples' errors")),
        (Format::Csv, _) => csv(path, samples)?,
        (Format::Cgats, _) => cgats(path, samples)?.into_bytes(),
        (Format::Tm27, [one]) => {
            tm27::text(&one.name, &now(), &one.wavelengths_nm, &one.reflectance).into_bytes()
        }
        (Format::Tm27, _) => {
            let problem = format!("{} samples, but a TM-27 file holds one", samples.len());
            return Err(unfit(path, problem, "write .csv or .sp"));
        }
    };
    Saved::write(path, &bytes)
}

/// The name of the column of wavelengths.
const WAVELENGTHS: &str = "wavelength_nm";
/// The name of a sample without one.
const NAMELESS: &str = "sample";

enum Format {
    Csv,
    Cgats,
    Tm27,
}

/// The format selected by a file's ending.
fn format(path: &Path) -> Result<Format> {
    let path = path.to_string_lossy();
    let known = [("csv", Format::Csv), ("sp", Format::Cgats), ("spdx", Format::Tm27)];
    known.into_iter().find(|(ending, _)| has_ending(&path, &[ending])).map(|(_, format)| format).ok_or_else(
        || Error::usage("--spectra", format!("'{path}' has no known ending"), "end it in .csv, .sp or .spdx"),
    )
}

/// Checks a file's ending before there is anything to write.
///
/// # Errors
/// [`Error::Usage`] as [`write()`].
pub fn check_ending(path: &Path) -> Result<()> {
    format(path).map(drop)
}

fn unfit(path: &Path, problem: impl Into<String>, remedy: &str) -> Error {
    Error::spectrum(path.display().to_string(), problem, remedy)
}

/// The wavelengths shared by all samples.
fn common_nm<'a>(path: &Path, samples: &'a [Measured]) -> Result<&'a [f64]> {
    let nm = &samples[0].wavelengths_nm;
    match samples.iter().find(|sample| sample.wavelengths_nm != *nm) {
        Some(other) => {
            let problem = format!("'{}' and '{}' are on different wavelengths", samples[0].name, other.name);
            Err(unfit(path, problem, "write each scene's samples to its own file"))
        }
        None => Ok(nm),
    }
}

/// Names that no other sample or its standard deviation has, with control characters escaped, letters `unfit`
/// for the format replaced and spaces around them removed, as readers do. Columns without a name, or with
/// that of the wavelengths, could not be read.
fn names(samples: &[Measured], unfit: &str) -> Vec<String> {
    let mut taken = HashSet::from([WAVELENGTHS.to_owned()]);
    let mut unique = |sample: &Measured| {
        let plain = printable(&sample.name).replace(|letter: char| unfit.contains(letter), "_");
        let plain = if plain.trim().is_empty() { NAMELESS } else { plain.trim() }.to_owned();
        let numbered = (2..).map(|n| format!("{plain} ({n})"));
        let both = |name: &String| [name.clone(), format!("{name}{SD_ENDING}")];
        let is_free = |name: &String| {
            deviation_of(name).is_none() && both(name).iter().all(|name| !taken.contains(name))
        };
        let name = iter::once(plain.clone()).chain(numbered).find(is_free).unwrap_or(plain);
        taken.extend(both(&name));
        name
    };
    samples.iter().map(&mut unique).collect()
}

fn csv(path: &Path, samples: &[Measured]) -> Result<Vec<u8>> {
    let (nm, names) = (common_nm(path, samples)?, names(samples, "\""));
    let sd_name = |name: &String| format!("{name}{SD_ENDING}");
    let heads = names.iter().zip(samples).flat_map(|(name, sample)| {
        let sd_name = sample.reflectance_sd.as_ref().map(|_| sd_name(name));
        iter::once(literal(name)).chain(sd_name.map(|name| literal(&name)))
    });
    let columns =
        samples.iter().flat_map(|sample| iter::once(&sample.reflectance).chain(&sample.reflectance_sd));
    let columns: Vec<_> = columns.collect();
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut write =
        |row: Vec<String>| writer.write_record(row).map_err(|e| Error::file(path.display(), e.into()));
    write(iter::once(WAVELENGTHS.to_owned()).chain(heads).collect())?;
    for (band, nm) in nm.iter().enumerate() {
        let values = columns.iter().map(|column| column[band].to_string());
        write(iter::once(nm.to_string()).chain(values).collect())?;
    }
    writer.into_inner().map_err(|e| Error::file(path.display(), e.into_error()))
}

fn cgats(path: &Path, samples: &[Measured]) -> Result<String> {
    let nm = common_nm(path, samples)?;
    if super::super::interpolation::even_step_nm(nm).is_none() {
        return Err(unfit(path, "CGATS spectra must be evenly spaced", "write .csv"));
    }
    let rows: Vec<_> = names(samples, ",\"")
        .into_iter()
        .zip(samples.iter().map(|sample| sample.reflectance.as_slice()))
        .collect();
    Ok(cgats::text(nm, &rows))
}

/// The current date and time, as `2026-01-31T12:00:00Z`.
fn now() -> String {
    iso_8601(SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs()))
}

/// Seconds since 1970 as a date and time, UTC. (H. Hinnant, "chrono-compatible low-level date algorithms".)
fn iso_8601(seconds: u64) -> String {
    let (days, second) = (seconds / 86_400 + 719_468, seconds % 86_400);
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    // months counted from March, so that the leap day is the last of the year
    let month = (5 * day_of_year + 2) / 153;
    let (day, month, next) = (day_of_year - (153 * month + 2) / 5 + 1, (month + 2) % 12 + 1, month >= 10);
    let year = 400 * era + year_of_era + u64::from(next);
    format!("{year:04}-{month:02}-{day:02}T{:02}:{:02}:{:02}Z", second / 3600, second / 60 % 60, second % 60)
}

#[cfg(test)]
mod tests {
    use std::slice::from_ref;

    use super::*;
    use crate::spectrum::formats::parse_csv;

    fn sample(name: &str, nm: [f64; 3]) -> Measured {
        let (wavelengths_nm, reflectance) = (nm.to_vec(), vec![0.1, 1.0 / 3.0, 0.9]);
        Measured { name: name.to_owned(), wavelengths_nm, reflectance, reflectance_sd: None }
    }

    fn refusal(ending: &str, samples: &[Measured]) -> String {
        let folder = tempfile::tempdir().unwrap();
        let message = write(&folder.path().join(ending), samples).unwrap_err().to_string();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        message
    }

    #[test]
    fn what_a_format_cannot_hold_is_refused() {
        let even = sample("a", [400.0, 500.0, 600.0]);
        let uneven = sample("b", [400.0, 500.0, 601.0]);
        assert!(refusal("x.txt", from_ref(&even)).contains("end it in .csv, .sp or .spdx"));
        assert!(refusal("x.csv", &[]).contains("no estimate"));
        assert!(refusal("x.spdx", &[even.clone(), even.clone()]).contains("2 samples"));
        assert!(refusal("x.sp", from_ref(&uneven)).contains("evenly spaced"));
        assert!(refusal("x.csv", &[even, uneven]).contains("'a' and 'b' are on different wavelengths"));
    }

    #[test]
    fn names_are_unique_and_break_no_line() {
        let nm = [400.0, 500.0, 600.0];
        let samples = ["a,\"b\"", "c", "c", "c (2)", "c_sd", "d [%]", "50% e"].map(|name| sample(name, nm));
        assert_eq!(
            names(&samples, ",\""),
            ["a__b_", "c", "c (2)", "c (2) (2)", "c_sd (2)", "d [%]", "50% e"]
        );
        assert_eq!(names(&[sample("\u{1b}]0;f\u{202e}", nm)], ""), ["\\u{1b}]0;f\\u{202e}"]);
    }

    #[test]
    fn a_name_with_a_comma_comes_back() {
        let file = tempfile::Builder::new().suffix(".csv").tempfile().unwrap();
        write(file.path(), &[sample("red, matte", [400.0, 500.0, 600.0])]).unwrap();
        let text = std::fs::read_to_string(file.path()).unwrap();
        assert!(text.starts_with("wavelength_nm,\"red, matte\"\n400,0.1\n500,0.333"), "{text}");
        assert_eq!(parse_csv("x.csv", &text).unwrap().spectra[0].name(), "red, matte");
    }

    /// OWASP, "CSV Injection": cells that begin with these are formulas.
    #[test]
    fn no_name_is_a_formula_or_a_unit() {
        let file = tempfile::Builder::new().suffix(".csv").tempfile().unwrap();
        let named = ["=1+2", "+3", "-4", "@sum", "'=5", "''6", "R [%]", "percent", "'50%", "'quoted"];
        let samples = named.map(|name| {
            let reflectance_sd = Some(vec![0.01; 3]);
            Measured { reflectance_sd, ..sample(name, [400.0, 500.0, 600.0]) }
        });
        write(file.path(), &samples).unwrap();
        let text = std::fs::read_to_string(file.path()).unwrap();
        let header = text.lines().next().unwrap();
        assert!(header.split(',').all(|cell| !cell.starts_with(['=', '+', '-', '@'])), "{header}");
        let table = parse_csv("x.csv", &text).unwrap().in_fractions("x.csv", None).unwrap();
        for (spectrum, sample) in table.spectra.iter().zip(&samples) {
            assert_eq!((spectrum.name(), spectrum.values()), (&*sample.name, &sample.reflectance[..]));
        }
        assert_eq!(table.spectra.len(), samples.len());
    }

    /// `date -u -d @SECONDS +%FT%TZ`, GNU coreutils.
    #[test]
    fn dates_are_those_of_coreutils() {
        for (seconds, want) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_399, "2000-02-28T23:59:59Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_709_251_200, "2024-03-01T00:00:00Z"),
            (4_107_542_399, "2100-02-28T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
        ] {
            assert_eq!(iso_8601(seconds), want);
        }
    }
}
