//! Tables of spectra in CSV: a header row, the wavelength in nm first, then one column a spectrum.
//!
//! Any grid will do. A byte order mark, CRLF, quoted cells and blank lines at the end are accepted.

use super::Spectrum;
use crate::error::{Error, Result};
use std::collections::HashSet;
use std::fs::File;
use std::io::Read;

/// No measured set is near it: a larger file is not a table of spectra.
const MAX_BYTES: u64 = 64 << 20;
/// The largest set known here has 1269 columns.
const MAX_COLUMNS: usize = 10_000;

/// Reads the spectra of the CSV file at `path`, named after their columns.
///
/// # Errors
/// [`Error::File`] if it cannot be read, [`Error::Table`] with the line and column that is wrong.
pub(super) fn read_csv(path: &str) -> Result<Vec<Spectrum>> {
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|e| Error::file(path, e))?;
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(|e| Error::file(path, e))?;
    let at = Place { path, line: 1 };
    if bytes.len() as u64 > MAX_BYTES {
        return Err(at.fails("the file is larger than 64 MiB", "split it into smaller tables"));
    }
    let text = String::from_utf8(bytes).map_err(|_| at.fails("not UTF-8 text", "save it as CSV in UTF-8"))?;
    parse_csv(path, &text)
}

/// The spectra of a CSV text; `path` is for the errors.
///
/// # Errors
/// [`Error::Table`] with the line and column that is wrong.
pub(super) fn parse_csv(path: &str, text: &str) -> Result<Vec<Spectrum>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text).trim_end();
    let mut rows = text.lines().zip(1..).map(|(row, line)| (row, Place { path, line }));
    let (header, at) = rows.next().unwrap_or(("", Place { path, line: 1 }));
    let names = column_names(header, &at)?;
    let mut columns = vec![Vec::new(); names.len()];
    for (row, at) in rows {
        read_row(row, &names, &mut columns, &at)?;
    }
    if columns[0].len() < 2 {
        let problem = format!("{} rows of numbers below the header", columns[0].len());
        return Err(at.fails(problem, "a spectrum needs at least two wavelengths"));
    }
    let mut columns = columns.into_iter();
    let wavelengths_nm: std::sync::Arc<[f64]> = columns.next().unwrap_or_default().into();
    let named = names.into_iter().skip(1).zip(columns);
    Ok(named
        .map(|(name, values)| Spectrum::from_table(name.into(), wavelengths_nm.clone(), values))
        .collect())
}

/// A line of a table.
struct Place<'a> {
    path: &'a str,
    line: usize,
}

impl Place<'_> {
    fn fails(&self, problem: impl Into<String>, remedy: &str) -> Error {
        let (path, line) = (self.path.to_owned(), self.line);
        Error::Table { path, line, problem: problem.into(), remedy: remedy.into() }
    }
}

fn cells(row: &str) -> impl Iterator<Item = &str> {
    row.split(',').map(|cell| cell.trim_ascii().trim_matches('"'))
}

fn column_names<'a>(header: &'a str, at: &Place) -> Result<Vec<&'a str>> {
    const EXAMPLE: &str = "write a header such as wavelength,reflectance and separate columns by ','";
    let count = cells(header).count();
    if !(2..=MAX_COLUMNS).contains(&count) {
        return Err(at.fails(format!("the header has {count} column(s), not 2 to {MAX_COLUMNS}"), EXAMPLE));
    }
    if cells(header).all(|cell| cell.parse::<f64>().is_ok()) {
        return Err(at.fails("numbers where the header should be", EXAMPLE));
    }
    let mut seen = HashSet::new();
    for (cell, column) in cells(header).zip(1..) {
        if cell.is_empty() || !seen.insert(cell) {
            let problem = format!("column {column} has no name of its own ('{cell}')");
            return Err(at.fails(problem, "name every column once"));
        }
    }
    Ok(cells(header).collect())
}

fn read_row(row: &str, names: &[&str], columns: &mut [Vec<f64>], at: &Place) -> Result<()> {
    let count = row.split(',').count();
    if count != names.len() {
        let problem = format!("{count} values, but the header has {} columns", names.len());
        return Err(at.fails(problem, "give every column a value in every row"));
    }
    for ((cell, name), column) in cells(row).zip(names).zip(columns.iter_mut()) {
        match cell.parse::<f64>() {
            Ok(value) if value.is_finite() => column.push(value),
            _ => {
                let problem = format!("column '{name}': '{cell}' is not a number");
                return Err(at.fails(problem, "write a finite number with '.' for decimals"));
            }
        }
    }
    check_wavelength(&columns[0], at)
}

/// Checks the last of the wavelengths read so far.
fn check_wavelength(wavelengths_nm: &[f64], at: &Place) -> Result<()> {
    let &[.., nm] = wavelengths_nm else { return Ok(()) };
    if (0.1..10.0).contains(&nm) {
        return Err(at.fails(format!("wavelength {nm} looks like micrometres"), "multiply by 1000 to get nm"));
    }
    if !(100.0..=3000.0).contains(&nm) {
        return Err(at.fails(format!("wavelength {nm} does not look like nm"), "give nm, such as 400 to 700"));
    }
    if let &[.., before_nm, nm] = wavelengths_nm
        && before_nm >= nm
    {
        let problem = format!("wavelength {nm} nm follows {before_nm} nm");
        return Err(at.fails(problem, "sort the rows by wavelength and drop repeated ones"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_spreadsheets_write() {
        let text = "\u{feff}\"wavelength\", \"R\",G\r\n400.5,1,2e-1\r\n 500 , .5,3\r\n\r\n\n";
        let spectra = parse_csv("x.csv", text).unwrap();
        let names: Vec<_> = spectra.iter().map(Spectrum::name).collect();
        assert_eq!(names, ["R", "G"]);
        assert_eq!(spectra[1].wavelengths_nm(), [400.5, 500.0]);
        assert_eq!(spectra[1].values(), [0.2, 3.0]);
    }

    #[test]
    fn errors_name_line_column_and_remedy() {
        let cases = [
            ("", "x.csv:1: the header has 1 column(s)"),
            ("wavelength;R\n400;1", "x.csv:1: the header has 1 column(s), not 2 to 10000; write a header"),
            ("400,1\n500,1", "x.csv:1: numbers where the header should be; write a header"),
            ("nm,R,R\n400,1,1", "x.csv:1: column 3 has no name of its own ('R'); name every column once"),
            ("nm,R\n", "x.csv:1: 0 rows of numbers below the header; a spectrum needs"),
            ("nm,R\n400,1", "x.csv:1: 1 rows of numbers"),
            ("nm,R\n400,1\n500,a", "x.csv:3: column 'R': 'a' is not a number; write a finite"),
            ("nm,R\n400,NaN\n500,1", "x.csv:2: column 'R': 'NaN' is not a number"),
            ("nm,R\n400,1\n500,1e999", "x.csv:3: column 'R': '1e999' is not a number"),
            ("nm,R\n400,1\n400,1", "x.csv:3: wavelength 400 nm follows 400 nm; sort"),
            ("nm,R\n400,1\n500", "x.csv:3: 1 values, but the header has 2 columns"),
            ("nm,R\n400,1\n\n500,1", "x.csv:3: 1 values, but the header has 2 columns"),
            ("nm,R\n0.4,1\n0.5,1", "x.csv:2: wavelength 0.4 looks like micrometres; multiply by 1000"),
            ("nm,R\n4000,1\n5000,1", "x.csv:2: wavelength 4000 does not look like nm"),
        ];
        for (text, want) in cases {
            let message = parse_csv("x.csv", text).unwrap_err().to_string();
            assert!(message.starts_with(want), "{text:?}: {message}");
        }
    }

    #[test]
    fn files_are_bounded_and_must_be_text() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("big.csv");
        File::create(&path).unwrap().set_len(MAX_BYTES + 1).unwrap();
        let message = read_csv(path.to_str().unwrap()).unwrap_err().to_string();
        assert!(message.contains("larger than 64 MiB"), "{message}");
        std::fs::write(&path, b"wavelength,\xff\n").unwrap();
        assert!(
            read_csv(path.to_str().unwrap()).unwrap_err().to_string().contains("save it as CSV in UTF-8")
        );
        assert!(matches!(read_csv("no/such.csv"), Err(Error::File { .. })));
    }
}
