//! Files of spectra: one module per format, selected here by ending and content.
//!
//! Readers return a [`Table`]: spectra in nm, with notes on conversions. JSON belongs to the stream, which
//! passes in its reader.

mod bfc;
mod cgats;
mod csv;
mod place;
mod quantity;
mod table;
mod tm27;
mod units;
mod write;

pub(super) use csv::parse as parse_csv;
pub use table::Table;
pub use write::{Measured, check_ending, write};

use std::path::Path;

use super::Spectrum;
use crate::error::{Error, Result};
use crate::files::forms::{Form, TOO_LARGE, Text, bytes};
use crate::message::printable;
use place::Place;
use table::MAX_SPECTRA;

/// Endings of files that can be read.
pub(super) const ENDINGS: [&str; 6] = ["csv", "sp", "ti3", "txt", "spdx", "json"];
/// Reads the spectra of a JSON text; the path is for error messages.
pub type JsonReader = fn(path: &str, text: &str) -> Result<Table>;

/// Reads the spectra of a file: CSV, CGATS, IES TM-27 or, by means of `json`, JSON.
///
/// # Errors
/// [`Error::File`] if it cannot be read, [`Error::Table`] with the offending line, or as `json`.
pub(super) fn read(path: &str, json: JsonReader) -> Result<Table> {
    let at = Place { path, line: 1 };
    let bytes = bytes(Path::new(path))?.ok_or_else(|| at.fails(TOO_LARGE, "split it into smaller tables"))?;
    let Text { text, is_unicode } = Text::decode(&bytes).map_err(|form| no_table(at, &form))?;
    let not_unicode = || at.fails("not UTF-8 text", "save it as CSV in UTF-8");
    let mut table = if has_ending(path, &["json"]) {
        json(path, &text)
    } else if has_ending(path, &["spdx"]) || text.starts_with('<') {
        tm27::parse(path, &text)
    } else if has_ending(path, &["sp", "ti3"]) || text.lines().any(|line| line.trim() == cgats::BEGIN_FORMAT)
    {
        // names may be in any encoding; digits are the same in all of them
        cgats::parse(path, &text)
    } else if bfc::is_matrix(&text) {
        bfc::parse(path, &text)
    } else if is_unicode {
        csv::parse(path, &text)
    } else {
        Err(not_unicode())
    }?;
    if table.spectra.len() > MAX_SPECTRA {
        let problem = format!("{} spectra, more than {MAX_SPECTRA}", table.spectra.len());
        return Err(at.fails(problem, "split it into smaller tables"));
    }
    let shown = |spectrum: Spectrum| spectrum.renamed(|name| printable(name).into_owned());
    table.spectra = table.spectra.into_iter().map(shown).collect();
    Ok(table)
}

/// The error for a file that is not text.
fn no_table(at: Place, form: &Form) -> Error {
    const EXPORT: &str = "save the table as CSV in UTF-8";
    let remedy = form.way_out().map_or(EXPORT.to_owned(), |way_out| format!("{way_out}, or {EXPORT}"));
    at.fails(format!("the file is {}", form.name), remedy)
}

/// True if a file name ends in one of these, in any case.
pub(super) fn has_ending(path: &str, endings: &[&str]) -> bool {
    let found = Path::new(path).extension();
    found.is_some_and(|found| endings.iter().any(|ending| found.eq_ignore_ascii_case(ending)))
}

/// Reports that JSON is not read here.
///
/// # Errors
/// Always.
pub(super) fn no_json(path: &str, _text: &str) -> Result<Table> {
    Err(Place { path, line: 1 }.fails("JSON is not read here", "write the spectra as CSV"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_bounded_and_must_be_text() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("big.csv");
        let message = || read(path.to_str().unwrap(), no_json).unwrap_err().to_string();
        std::fs::File::create(&path).unwrap().set_len((64 << 20) + 1).unwrap();
        assert!(message().contains("larger than 64 MiB"), "{}", message());
        std::fs::write(&path, b"wavelength,\xff\n").unwrap();
        assert!(message().contains("save it as CSV in UTF-8"), "{}", message());
        assert!(matches!(read("no/such.csv", no_json), Err(Error::File { .. })));
    }

    #[test]
    fn content_says_what_the_ending_does_not() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("paint.txt");
        for text in [
            "nm,r\n400,0.1\n700,0.2\n",
            "CGATS.17\nBEGIN_DATA_FORMAT\nSPECTRAL_NM400 SPECTRAL_NM700\nEND_DATA_FORMAT\n\
             BEGIN_DATA\n0.1 0.2\nEND_DATA\n",
            "<IESTM2714><SpectralDistribution><SpectralData wavelength='400'>0.1</SpectralData>\
             <SpectralData wavelength='700'>0.2</SpectralData></SpectralDistribution></IESTM2714>",
        ] {
            std::fs::write(&path, text).unwrap();
            let table = read(path.to_str().unwrap(), no_json).unwrap();
            assert_eq!(table.spectra[0].values(), [0.1, 0.2], "{text}");
            assert_eq!(table.spectra[0].wavelengths_nm(), [400.0, 700.0]);
        }
    }
}
