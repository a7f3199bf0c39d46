//! Tables of spectra in CSV: a header row, the wavelength in nm first, then one column a spectrum.
//!
//! Any grid will do, in nm or micrometres. A column `red_sd` beside `red` is its standard deviation and left out. A byte order
//! mark, CRLF, quoted cells and blank lines at the end are accepted.

use std::collections::HashSet;

use super::{MAX_SPECTRA, Place, Spectrum, Table, units};
use crate::error::Result;

/// Ending of the column beside `red` that has the standard deviation of `red`.
pub(super) const SD_ENDING: &str = "_sd";

/// The spectra of a CSV text, named after their columns; `path` is for the errors.
///
/// # Errors
/// [`crate::Error::Table`] with the line and column that is wrong.
pub(in crate::spectrum) fn parse(path: &str, text: &str) -> Result<Table> {
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
    let (wavelengths_nm, note) = units::to_nm(at, names[0], &columns[0], 2)?;
    let wavelengths_nm: std::sync::Arc<[f64]> = wavelengths_nm.into();
    let mut named: Vec<_> = names.iter().zip(columns).skip(1).collect();
    let (count, known) = (named.len(), names[1..].iter().copied().collect());
    named.retain(|(name, _)| !is_deviation(name, &known));
    let left_out = (named.len() < count).then_some("standard deviations left out");
    let percent: Vec<bool> = named.iter().map(|(name, _)| units::says_percent(name)).collect();
    let spectrum =
        |(name, values): (&&str, _)| Spectrum::from_table((*name).to_owned(), wavelengths_nm.clone(), values);
    let table = Table::new(named.into_iter().map(spectrum).collect())?;
    Ok(Table {
        percent: percent.contains(&true).then_some(percent),
        notes: note.into_iter().chain(left_out).collect(),
        ..table
    })
}

/// Whether a column has the standard deviation of another one.
fn is_deviation(name: &str, known: &HashSet<&str>) -> bool {
    name.strip_suffix(SD_ENDING).is_some_and(|of| known.contains(of))
}

fn cells(row: &str) -> impl Iterator<Item = &str> {
    row.split(',').map(|cell| cell.trim_ascii().trim_matches('"'))
}

fn column_names<'a>(header: &'a str, at: &Place) -> Result<Vec<&'a str>> {
    const EXAMPLE: &str = "write a header such as wavelength,reflectance and separate columns by ','";
    let count = cells(header).count();
    if !(2..=2 * MAX_SPECTRA).contains(&count) {
        let problem = format!("the header has {count} column(s), not 2 to {}", 2 * MAX_SPECTRA);
        return Err(at.fails(problem, EXAMPLE));
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
        column.push(at.number(name, cell)?);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_spreadsheets_write() {
        let text = "\u{feff}\"wavelength\", \"R\",G\r\n400.5,1,2e-1\r\n 500 , .5,3\r\n\r\n\n";
        let spectra = parse("x.csv", text).unwrap().spectra;
        let names: Vec<_> = spectra.iter().map(Spectrum::name).collect();
        assert_eq!(names, ["R", "G"]);
        assert_eq!(spectra[1].wavelengths_nm(), [400.5, 500.0]);
        assert_eq!(spectra[1].values(), [0.2, 3.0]);
    }

    #[test]
    fn headers_say_units_and_deviations() {
        let table = parse("x.csv", "wavelength [um],R [%],R [%]_sd,G\n0.4,10,1,2\n0.57,20,1,4\n").unwrap();
        assert_eq!(table.notes, ["micrometres read as nm", "standard deviations left out"]);
        assert_eq!(table.percent, Some(vec![true, false]));
        let fractions = table.in_fractions("x.csv").unwrap();
        let spectra = fractions.spectra("x.csv");
        assert_eq!((spectra[0].values(), spectra[1].values()), (&[0.1, 0.2][..], &[2.0, 4.0][..]));
        let note = "x.csv: micrometres read as nm, standard deviations left out, percent read as fractions";
        assert_eq!((spectra[0].wavelengths_nm()[1], spectra[0].note()), (570.0, Some(note)));
    }

    #[test]
    fn errors_name_line_column_and_remedy() {
        let cases = [
            ("", "x.csv:1: the header has 1 column(s)"),
            ("wavelength;R\n400;1", "x.csv:1: the header has 1 column(s), not 2 to 20000; write a header"),
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
            ("nm,R\n0.4,1\n0.5,1", "x.csv:2: wavelength 0.4 looks like micrometres, not nm; give all"),
            ("nm,R\n4000,1\n5000,1", "x.csv:2: wavelength 4000 does not look like nm"),
        ];
        for (text, want) in cases {
            let message = parse("x.csv", text).unwrap_err().to_string();
            assert!(message.starts_with(want), "{text:?}: {message}");
        }
    }
}
