//! Tables of spectra in CSV: a header row, the wavelength in nm first, then one column per spectrum.
//!
//! Any grid is accepted, in nm, micrometres or ångström. Cells are separated by commas, semicolons or tabs,
//! or as declared by a first line `sep=;`. A column `red_sd` next to `red` is its standard deviation and
//! omitted, as are row numbers before the wavelengths. The first column needs no name, and a row of units may
//! follow the names. Quoted cells and blank lines at the end are accepted.

use std::collections::HashSet;

use csv::{ReaderBuilder, StringRecord, Trim};

use super::place::{Place, finite};
use super::table::{MAX_SPECTRA, Stated, Table};
use super::units::{self, Scale};
use crate::error::{Result, counted};
use crate::message::is_formula;
use crate::spectrum::Spectrum;

/// Ending of the column with the standard deviation of `red`: `red_sd`.
pub(super) const SD_ENDING: &str = "_sd";
/// Last words of such column names, in lower case.
const DEVIATIONS: [&str; 7] = ["sd", "std", "stdev", "stddev", "stderr", "sigma", "uncertainty"];
/// Last but one and last words of others.
const DEVIATIONS_OF_TWO: [[&str; 2]; 7] = [
    ["standard", "deviation"],
    ["standard", "error"],
    ["standard", "uncertainty"],
    ["std", "deviation"],
    ["std", "dev"],
    ["std", "error"],
    ["st", "dev"],
];

/// Possible cell separators. The comma is last: in tables with other separators it is a decimal comma.
const SEPARATORS: [u8; 3] = [b'\t', b';', b','];

/// Prefix by which a spreadsheet marks a cell as text.
const LITERAL: char = '\'';

/// The spectra of a CSV text whose lines end in `\n`, named after their columns; `path` is for error
/// messages.
///
/// # Errors
/// [`crate::Error::Table`] with the offending line and column.
pub(in crate::spectrum) fn parse(path: &str, text: &str) -> Result<Table> {
    parse_from(Place { path, line: 1 }, text)
}

/// The same for a text that begins at a given line of its file.
pub(super) fn parse_from(Place { path, line }: Place, text: &str) -> Result<Table> {
    let text = text.trim_end();
    let (first_line, separator, text) = match declared_separator(text) {
        Some((separator, below)) => (line + 1, separator, below),
        None => (line, separator(text), text),
    };
    let mut rows = rows(Place { path, line: first_line }, text, separator).peekable();
    let (header, at) =
        rows.next().transpose()?.unwrap_or((StringRecord::from(vec![""]), Place { path, line: first_line }));
    let names = column_names(&header, &at)?;
    let units = rows.next_if(|row| row.as_ref().is_ok_and(|(row, _)| is_of_units(row)));
    let unit = |column: usize| match &units {
        Some(Ok((row, _))) => cells(row).nth(column).unwrap_or(""),
        _ => "",
    };
    let mut columns = vec![Vec::new(); names.len()];
    let mut marks = DecimalMarks { comma_allowed: separator != b',', found: None };
    for row in rows {
        let (row, at) = row?;
        read_row(&row, &names, &mut marks, &mut columns, &at)?;
    }
    if columns[0].len() < 2 {
        let problem = format!("{} of numbers below the header", counted(columns[0].len(), "row"));
        return Err(at.fails(problem, "a spectrum needs at least two wavelengths"));
    }
    let first = wavelength_column(&names, &columns);
    let header = format!("{} {}", names[first], unit(first));
    let first_row = at.line + 1 + usize::from(units.is_some());
    let (wavelengths_nm, note) = units::to_nm(at, header.trim(), &columns[first], first_row)?;
    let wavelengths_nm: std::sync::Arc<[f64]> = wavelengths_nm.into();
    let mut named: Vec<_> = names.iter().zip(columns).enumerate().skip(first + 1).collect();
    if named.is_empty() {
        return Err(at.fails("no column beside that of the wavelengths", "write one column per spectrum"));
    }
    let (count, known) = (named.len(), names[first + 1..].iter().map(|cell| name(cell)).collect());
    named.retain(|(_, (cell, _))| !is_deviation(name(cell), &known));
    let numbered = (first > 0).then_some("row numbers left out");
    let left_out = (named.len() < count).then_some("standard deviations left out");
    let commas = (marks.found == Some(',')).then_some("commas read as decimal points");
    let stated = named.iter().map(|(column, (cell, _))| Stated {
        scale: match units::scale(unit(*column)) {
            Scale::Unstated if name(cell) == **cell => units::scale(cell),
            unit => unit,
        },
        ..Stated::default()
    });
    let stated = stated.collect();
    let spectrum = |(_, (cell, values)): (usize, (&&str, _))| {
        Spectrum::from_table(name(cell).to_owned(), wavelengths_nm.clone(), values)
    };
    let table = Table::new(named.into_iter().map(spectrum).collect())?;
    let notes = [note, commas, numbered, left_out];
    Ok(Table { stated, notes: notes.into_iter().flatten().map(str::to_owned).collect(), ..table })
}

/// The separator declared by a first line such as `sep=;`, as in spreadsheets, and the lines below it.
fn declared_separator(text: &str) -> Option<(u8, &str)> {
    let (first, below) = text.split_once('\n')?;
    let first = first.trim_matches('"').to_ascii_lowercase();
    match first.strip_prefix("sep=")?.as_bytes() {
        [separator] => Some((*separator, below)),
        _ => None,
    }
}

/// The first separator that divides the header and the next row into equally many cells, two or more; if
/// there is none, the first that divides the header.
fn separator(text: &str) -> u8 {
    let divides = |separator: &u8| {
        let mut counts = records(text, *separator).map(|record| record.map_or(0, |record| record.len()));
        let (header, row) = (counts.next().unwrap_or(0), counts.next());
        (header > 1, row == Some(header))
    };
    let both = SEPARATORS.iter().find(|separator| divides(separator) == (true, true));
    *both.or_else(|| SEPARATORS.iter().find(|separator| divides(separator).0)).unwrap_or(&b',')
}

fn records(text: &str, separator: u8) -> impl Iterator<Item = csv::Result<StringRecord>> {
    let mut builder = ReaderBuilder::new();
    builder.delimiter(separator).has_headers(false).flexible(true).trim(Trim::All);
    builder.from_reader(text.as_bytes()).into_records()
}

/// The rows of a text, each with its line, counted from `start`.
fn rows<'a>(
    start: Place<'a>,
    text: &'a str,
    separator: u8,
) -> impl Iterator<Item = Result<(StringRecord, Place<'a>)>> {
    let mut at = start;
    records(text, separator).map(move |record| {
        let record = record.map_err(|error| at.fails(error.to_string(), "save it as CSV in UTF-8"))?;
        let position = record.position();
        at.line = position.map_or(at.line, |position| start.line - 1 + position.line() as usize);
        // the reader skips blank lines, the first of which seems to be the start of the record
        if position.is_some_and(|position| text[position.byte() as usize..].starts_with('\n')) {
            return Err(at.fails("a blank line", "delete it"));
        }
        if record.iter().any(|cell| cell.contains('\n')) {
            return Err(
                at.fails("a quoted cell does not end on its line", "close the quotes, or remove them")
            );
        }
        Ok((record, at))
    })
}

/// True if a column holds the standard deviation of another one, or is called nothing else beside a spectrum.
fn is_deviation(name: &str, known: &HashSet<&str>) -> bool {
    deviation_of(name).is_some_and(|of| known.contains(of) || of.is_empty() && has_spectrum(known))
}

/// True if one of the columns is not called a standard deviation.
fn has_spectrum(known: &HashSet<&str>) -> bool {
    known.iter().any(|name| deviation_of(name).is_none())
}

/// The name of the column whose standard deviation a column of this name may hold: `red` for `red_sd`,
/// `Red std`, `red (uncertainty)`.
pub(super) fn deviation_of(name: &str) -> Option<&str> {
    let name = name.trim_end_matches([')', ']', '.']);
    let (of, word) = last_word(name);
    let (of_two, word_before) = last_word(of.trim_end_matches(['.', ' ', '_', '-']));
    let words = [word_before.to_lowercase(), word.to_lowercase()];
    let of = match [words[0].as_str(), words[1].as_str()] {
        two if DEVIATIONS_OF_TWO.contains(&two) => of_two,
        [_, word] if DEVIATIONS.contains(&word) => of,
        _ => return None,
    };
    Some(of.trim_end_matches(['(', '[', '_', '-', ' ']))
}

/// What precedes the last word of a name and the mark before it, and that word.
fn last_word(name: &str) -> (&str, &str) {
    name.rsplit_once(|letter: char| !letter.is_alphanumeric()).unwrap_or(("", name))
}

/// A name as a cell that neither a spreadsheet takes for a formula nor [`parse`] for a unit.
pub(super) fn literal(name: &str) -> String {
    if is_misread(name) { format!("{LITERAL}{name}") } else { name.to_owned() }
}

/// The name in a cell that may have been made by [`literal`].
fn name(cell: &str) -> &str {
    cell.strip_prefix(LITERAL).filter(|name| is_misread(name)).unwrap_or(cell)
}

/// True if a name begins like a formula or states a unit, ignoring marks before it.
fn is_misread(name: &str) -> bool {
    let name = name.trim_start_matches(LITERAL);
    is_formula(name) || units::scale(name) != Scale::Unstated
}

/// True if a row holds the units of the columns above it: one unit of wavelength, and no number.
fn is_of_units(row: &StringRecord) -> bool {
    cells(row).any(units::is_of_wavelengths) && cells(row).all(|cell| finite(cell).is_none())
}

/// The column of wavelengths: the first, or the one after row numbers or after a column without a name.
fn wavelength_column(names: &[&str], columns: &[Vec<f64>]) -> usize {
    if units::is_of_wavelengths(names[0]) {
        return 0;
    }
    let counts_from = |start: f64| {
        let rises = |(row, number): (usize, &f64)| (number - start - row as f64).abs() < f64::EPSILON;
        columns[0].iter().enumerate().all(rises)
    };
    let is_numbered = counts_from(0.0) || counts_from(1.0);
    let called = names.iter().skip(1).position(|name| units::is_of_wavelengths(name)).map(|at| at + 1);
    match called {
        Some(at) if is_numbered || names[0].is_empty() => at,
        // not for arbitrary numbers: spectral values are smaller
        None if is_numbered && names.len() > 2 && columns[1].iter().all(|nm| *nm >= 100.0) => 1,
        _ => 0,
    }
}

/// The cells of a row without quotes, which the reader leaves after a space.
fn cells(row: &StringRecord) -> impl Iterator<Item = &str> {
    row.iter().map(|cell| cell.strip_prefix('"').and_then(|cell| cell.strip_suffix('"')).unwrap_or(cell))
}

fn column_names<'a>(header: &'a StringRecord, at: &Place) -> Result<Vec<&'a str>> {
    const EXAMPLE: &str =
        "write a header such as wavelength,reflectance and separate columns by ',', ';' or tabs";
    let count = header.len();
    if !(2..=2 * MAX_SPECTRA).contains(&count) {
        let problem = format!("the header has {count} column(s), not 2 to {}", 2 * MAX_SPECTRA);
        return Err(at.fails(problem, EXAMPLE));
    }
    if cells(header).all(|cell| cell.replace(',', ".").parse::<f64>().is_ok()) {
        return Err(at.fails("numbers where the header should be", EXAMPLE));
    }
    let mut seen = HashSet::new();
    for (cell, column) in cells(header).zip(1..) {
        // the first column holds the wavelengths and may be unnamed
        let is_nameless = cell.is_empty() && column > 1;
        if is_nameless || !seen.insert(cell) {
            let problem = format!("column {column} has no name of its own ('{cell}')");
            return Err(at.fails(problem, "name every column once"));
        }
    }
    Ok(cells(header).collect())
}

fn read_row(
    row: &StringRecord,
    names: &[&str],
    marks: &mut DecimalMarks,
    columns: &mut [Vec<f64>],
    at: &Place,
) -> Result<()> {
    if row.len() != names.len() {
        let (values, columns) = (counted(row.len(), "value"), counted(names.len(), "column"));
        let problem = format!("{values}, but the header has {columns}");
        return Err(at.fails(problem, "give every column a value in every row"));
    }
    for ((cell, name), column) in cells(row).zip(names).zip(columns.iter_mut()) {
        column.push(marks.number(at, name, cell)?);
    }
    Ok(())
}

/// The decimal mark of a table, a point or a comma, but not both, since one of them may separate thousands.
struct DecimalMarks {
    /// False if commas separate cells: within quotes they then separate thousands.
    comma_allowed: bool,
    found: Option<char>,
}

impl DecimalMarks {
    /// The number in a cell.
    fn number(&mut self, at: &Place, column: &str, cell: &str) -> Result<f64> {
        let Some(mark) = cell.chars().find(|letter| ".,".contains(*letter)) else {
            return at.number(column, cell);
        };
        if mark == ',' && !self.comma_allowed {
            return at.number(column, cell);
        }
        if *self.found.get_or_insert(mark) != mark {
            let problem =
                format!("column '{column}': '{cell}' has another decimal mark than the numbers before it");
            return Err(
                at.fails(problem, "write all decimals with '.' or all with ',', and no thousands separators")
            );
        }
        match mark {
            // text that is not a number either way is quoted as it stands
            ',' => at.number(column, &cell.replacen(',', ".", 1)).or_else(|_| at.number(column, cell)),
            _ => at.number(column, cell),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_spreadsheets_write() {
        let text = "\"wavelength\", \"R\",G\n400.5,1,2e-1\n 500 , .5,3\n\n\n";
        let spectra = parse("x.csv", text).unwrap().spectra;
        let names: Vec<_> = spectra.iter().map(Spectrum::name).collect();
        assert_eq!(names, ["R", "G"]);
        assert_eq!(spectra[1].wavelengths_nm(), [400.5, 500.0]);
        assert_eq!(spectra[1].values(), [0.2, 3.0]);
    }

    /// What spreadsheets write where the comma is the decimal mark, and what is copied from them.
    #[test]
    fn any_of_three_separators_will_do() {
        for text in [
            "nm,R,G\n400,0.5,1\n500.5,2,3",
            "nm;R;G\n400;0,5;1\n500,5;2;3",
            "nm\tR\tG\n400\t0.5\t1\n500.5\t2\t3\n",
            "sep=|\nnm|R|G\n400|0.5|1\n500.5|2|3\n",
            "\"SEP=;\"\nnm;R;G\n400;0.5;1\n500.5;2;3\n",
        ] {
            let table = parse("x.csv", text).unwrap();
            assert_eq!(table.spectra[0].wavelengths_nm(), [400.0, 500.5], "{text}");
            assert_eq!(table.spectra[0].values(), [0.5, 2.0], "{text}");
            assert_eq!(table.spectra[1].values(), [1.0, 3.0], "{text}");
            assert_eq!(table.notes.iter().any(|note| note.contains("commas")), text.contains("0,5"));
        }
    }

    #[test]
    fn quoted_names_may_hold_separators_and_quotes() {
        let text = "nm,\"red, matte\",\"5\"\" tile\",dark;dull\n400,\"0.1\",0.2,0.3\n500,0.1,0.2,0.3\n";
        let table = parse("x.csv", text).unwrap();
        let names: Vec<_> = table.spectra.iter().map(Spectrum::name).collect();
        assert_eq!(names, ["red, matte", "5\" tile", "dark;dull"]);
    }

    #[test]
    fn headers_say_units_and_deviations() {
        let table = parse("x.csv", "wavelength [um],R [%],R [%]_sd,G\n0.4,10,1,2\n0.57,20,1,4\n").unwrap();
        assert_eq!(table.notes, ["micrometres read as nm", "standard deviations left out"]);
        let fractions = table.in_fractions("x.csv", None).unwrap();
        let spectra = fractions.spectra("x.csv");
        assert_eq!((spectra[0].values(), spectra[1].values()), (&[0.1, 0.2][..], &[2.0, 4.0][..]));
        let note = "x.csv: micrometres read as nm, standard deviations left out, percent read as fractions";
        assert_eq!((spectra[0].wavelengths_nm()[1], spectra[0].note()), (570.0, Some(note)));
    }

    #[test]
    fn errors_name_line_column_and_remedy() {
        let cases = [
            ("", "x.csv:1: the header has 1 column(s)"),
            ("wavelength|R\n400|1", "x.csv:1: the header has 1 column(s), not 2 to 20000; write a header"),
            ("400,1\n500,1", "x.csv:1: numbers where the header should be; write a header"),
            ("nm,R,R\n400,1,1", "x.csv:1: column 3 has no name of its own ('R'); name every column once"),
            ("nm,R\n", "x.csv:1: 0 rows of numbers below the header; a spectrum needs"),
            ("nm,R\n400,1", "x.csv:1: 1 row of numbers"),
            ("nm,R\n400,1\n500,a", "x.csv:3: column 'R': 'a' is not a number; write a finite"),
            ("nm,R\n400,NaN\n500,1", "x.csv:2: column 'R': 'NaN' is not a number"),
            ("nm,R\n400,1\n500,1e999", "x.csv:3: column 'R': '1e999' is not a number"),
            ("nm,R\n400,1\n400,1", "x.csv:3: wavelength 400 nm follows 400 nm; sort"),
            ("nm,R\n400,1\n500", "x.csv:3: 1 value, but the header has 2 columns"),
            ("nm,R\n400,1\n\n500,1", "x.csv:3: a blank line; delete it"),
            ("nm,R\n400,1\n500,\"1\n600,2", "x.csv:3: a quoted cell does not end on its line; close"),
            ("nm,R\n400,1\n500,\"1,5\"", "x.csv:3: column 'R': '1,5' is not a number; write a finite"),
            ("nm;R\n400;1,5\n500;1.5", "x.csv:3: column 'R': '1.5' has another decimal mark than"),
            ("nm;R\n400;1.5\n500;1,500", "x.csv:3: column 'R': '1,500' has another decimal mark than"),
            ("nm;R\n400;1,5\n500;1,500,0", "x.csv:3: column 'R': '1,500,0' is not a number"),
            ("nm;R\n400;1", "x.csv:1: 1 row of numbers"),
            ("nm,R\n0.4,1\n0.5,1", "x.csv:2: wavelength 0.4 looks like micrometres, not nm; give all"),
            ("nm,R\n4000,1\n5000,1", "x.csv:2: wavelength 4000 does not look like nm"),
        ];
        for (text, want) in cases {
            let message = parse("x.csv", text).unwrap_err().to_string();
            assert!(message.starts_with(want), "{text:?}: {message}");
        }
    }
}
