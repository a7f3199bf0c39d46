//! CGATS.17 tables with spectra: one row per sample, one column per wavelength.
//!
//! Argyll CMS's `.sp` and `.ti3` (`SPEC_400`, scaled by `SPECTRAL_NORM`), and exports of i1Profiler
//! (`SPECTRAL_NM400`), ColorPort and ProfileMaker (`nm400`). Other columns are ignored, as are tables without
//! spectra; a file may have several tables. (ANSI CGATS.17-2009, and "Argyll CMS file formats".)

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::place::Place;
use super::quantity::Quantity;
use super::table::{Stated, Table};
use super::units::Scale;
use crate::error::{Result, counted};
use crate::spectrum::Spectrum;
use crate::spectrum::grid::check_rising;

pub(super) const BEGIN_FORMAT: &str = "BEGIN_DATA_FORMAT";
/// Prefixes of the wavelength in a column's name, in capitals; the longest first.
const PREFIXES: [&str; 6] = ["SPECTRAL_NM_", "SPECTRAL_NM", "SPECTRAL_", "SPEC_", "NM_", "NM"];
/// Columns that name samples, in order of preference.
const NAMES: [&str; 4] = ["SAMPLE_ID", "SAMPLEID", "SAMPLE_NAME", "SAMPLE_LOC"];
/// Argyll rounds the wavelengths in column names.
const ROUNDED_NM: f64 = 0.51;

/// The spectra of a CGATS text, named by their `SAMPLE_ID`.
///
/// # Errors
/// [`crate::Error::Table`] with the offending line.
pub(super) fn parse(path: &str, text: &str) -> Result<Table> {
    let mut lines = text.lines().zip(1..).map(|(text, line)| (text, Place { path, line }));
    let (mut spectra, mut stated, mut without_spectra) = (Vec::new(), Vec::new(), None);
    let mut names = HashSet::new();
    while let Some(header) = Header::read(&mut lines, path) {
        let (rows, end) = rows(&mut lines, &header)?;
        let Some(columns) = Columns::new(&header)? else {
            without_spectra.get_or_insert(header.at);
            continue;
        };
        header.agrees("NUMBER_OF_SETS", rows.len(), "row")?;
        for (row, at) in rows {
            let spectrum = columns.spectrum(&header, &words(row), spectra.len() + 1, at)?;
            if !names.insert(spectrum.name().to_owned()) {
                let problem = format!("two samples are called '{}'", spectrum.name());
                return Err(at.fails(problem, "name every sample once"));
            }
            spectra.push(spectrum);
        }
        stated.resize(spectra.len(), header.stated());
        if spectra.is_empty() {
            return Err(
                end.fails("no samples between BEGIN_DATA and END_DATA", "export them with their spectra")
            );
        }
    }
    match (spectra.is_empty(), without_spectra) {
        (false, _) => Ok(Table { stated, ..Table::new(spectra)? }),
        (true, Some(at)) => {
            Err(at.fails("no columns of spectra, such as SPEC_400", "export them with the samples"))
        }
        (true, None) => {
            let at = Place { path, line: 1 };
            Err(at.fails("no BEGIN_DATA: not a CGATS table", "export the spectra as CGATS or CSV"))
        }
    }
}

/// A line and its place.
type Line<'a> = (&'a str, Place<'a>);

/// The rows up to `END_DATA`, and its place. Rows remain lines, as their words would take many times the
/// memory.
fn rows<'a>(
    lines: &mut impl Iterator<Item = Line<'a>>,
    header: &Header<'a>,
) -> Result<(Vec<Line<'a>>, Place<'a>)> {
    let (mut rows, mut end) = (Vec::new(), header.at);
    for (row, at) in lines {
        end = at;
        let before_comment = row.split('#').next().unwrap_or_default();
        match before_comment.split_whitespace().next() {
            None => {}
            Some("END_DATA") => return Ok((rows, at)),
            Some(_) => rows.push((row, at)),
        }
    }
    Err(end.fails("END_DATA is missing: the file was cut", "export it again"))
}

/// The part of a table before its data.
struct Header<'a> {
    /// Value and line of each keyword.
    keywords: HashMap<String, (String, Place<'a>)>,
    /// Names of the columns, in capitals.
    fields: Vec<String>,
    /// Where the data begins.
    at: Place<'a>,
}

impl<'a> Header<'a> {
    /// The header of the next table, if another one follows.
    fn read(lines: &mut impl Iterator<Item = Line<'a>>, path: &'a str) -> Option<Self> {
        let mut header = Self { keywords: HashMap::new(), fields: Vec::new(), at: Place { path, line: 1 } };
        let mut in_format = false;
        for (line, at) in lines {
            let words = words(line);
            header.at = at;
            match words.first().map(String::as_str) {
                None => {}
                Some("BEGIN_DATA") => return Some(header),
                Some(BEGIN_FORMAT) => in_format = true,
                Some("END_DATA_FORMAT") => in_format = false,
                Some(_) if in_format => header.fields.extend(words.iter().map(|word| word.to_uppercase())),
                Some(key) => {
                    let value = words.get(1).cloned().unwrap_or_default();
                    header.keywords.insert(key.to_uppercase(), (value, at));
                }
            }
        }
        None
    }

    /// What the header states about all spectra: values divided by a norm are fractions.
    fn stated(&self) -> Stated {
        let scale =
            if self.keywords.contains_key("SPECTRAL_NORM") { Scale::Fraction } else { Scale::Unstated };
        let quantity = self.keywords.get("MEAS_TYPE").and_then(|(name, _)| Quantity::called(name));
        Stated { scale, quantity }
    }

    /// The number of a keyword, if it is present.
    fn number(&self, key: &str) -> Result<Option<(f64, Place<'a>)>> {
        let Some((value, at)) = self.keywords.get(key) else { return Ok(None) };
        at.number(key, value).map(|number| Some((number, *at)))
    }

    /// Checks a count if the file gives it.
    fn agrees(&self, key: &str, count: usize, one: &str) -> Result<()> {
        match self.keywords.get(key) {
            Some((stated, at)) if stated.parse() != Ok(count) => Err(at.fails(
                format!("{key} is '{stated}', but the file has {}", counted(count, one)),
                "export the file again",
            )),
            _ => Ok(()),
        }
    }
}

/// Assignment of the columns.
struct Columns {
    name: Option<usize>,
    values: Vec<usize>,
    wavelengths_nm: Arc<[f64]>,
    norm: f64,
}

impl Columns {
    /// `None` if no column has spectral values.
    fn new(header: &Header) -> Result<Option<Self>> {
        let named =
            header.fields.iter().enumerate().filter_map(|(at, field)| Some((at, wavelength_nm(field)?)));
        let (values, named_nm): (Vec<_>, Vec<_>) = named.unzip();
        if values.is_empty() {
            return Ok(None);
        }
        header.agrees("NUMBER_OF_FIELDS", header.fields.len(), "column")?;
        let nm = spectral_nm(header, &named_nm)?.unwrap_or(named_nm);
        check_rising(&nm)
            .map_err(|e| header.at.fails(e.to_string(), "give the columns in the order of wavelengths"))?;
        let (norm, at) = header.number("SPECTRAL_NORM")?.unwrap_or((1.0, header.at));
        if norm <= 0.0 {
            return Err(at.fails(
                format!("SPECTRAL_NORM {norm} is not a scale"),
                "give the number that stands for 1, such as 100",
            ));
        }
        let name = NAMES.iter().find_map(|name| header.fields.iter().position(|field| field == name));
        Ok(Some(Self { name, values, wavelengths_nm: nm.into(), norm }))
    }

    /// The spectrum of a row; `number` is the row number, from 1.
    fn spectrum(&self, header: &Header, row: &[String], number: usize, at: Place) -> Result<Spectrum> {
        let count = header.fields.len();
        if row.len() != count {
            let (values, columns) = (counted(row.len(), "value"), counted(count, "column"));
            let problem = format!("{values}, but the format has {columns}");
            return Err(at.fails(problem, "give every column a value in every row"));
        }
        let value = |&k: &usize| Ok(at.number(&header.fields[k], &row[k])? / self.norm);
        let values = self.values.iter().map(value).collect::<Result<_>>()?;
        let name = self.name.map_or_else(|| number.to_string(), |k| row[k].clone());
        Ok(Spectrum::from_table(name, self.wavelengths_nm.clone(), values))
    }
}

/// The wavelength in a column name.
fn wavelength_nm(field: &str) -> Option<f64> {
    let digits = PREFIXES.iter().find_map(|prefix| field.strip_prefix(prefix))?;
    digits.parse().ok().filter(|nm| (100.0..=3000.0).contains(nm))
}

/// Wavelengths from `SPECTRAL_BANDS`, `SPECTRAL_START_NM` and `SPECTRAL_END_NM`, which have the digits
/// missing from names.
fn spectral_nm(header: &Header, named_nm: &[f64]) -> Result<Option<Vec<f64>>> {
    header.agrees("SPECTRAL_BANDS", named_nm.len(), "spectral column")?;
    let ends = (header.number("SPECTRAL_START_NM")?, header.number("SPECTRAL_END_NM")?);
    let (Some((start_nm, at)), Some((end_nm, _))) = ends else { return Ok(None) };
    let step_nm = (end_nm - start_nm) / (named_nm.len() - 1).max(1) as f64;
    let nm: Vec<f64> = (0..named_nm.len()).map(|k| start_nm + k as f64 * step_nm).collect();
    match nm.iter().zip(named_nm).find(|(nm, named_nm)| (*nm - *named_nm).abs() > ROUNDED_NM) {
        Some((nm, named_nm)) => {
            let problem =
                format!("the column of {named_nm} nm is {nm} nm by SPECTRAL_START_NM and SPECTRAL_END_NM");
            Err(at.fails(problem, "export the file again"))
        }
        None => Ok(Some(nm)),
    }
}

/// The words of a line, separated by blanks unless quoted; `#` begins a comment.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut word, mut quoted) = (Vec::new(), None::<String>, false);
    for letter in line.chars() {
        match letter {
            '"' => {
                quoted = !quoted;
                word.get_or_insert_default();
            }
            '#' if !quoted => break,
            _ if letter.is_whitespace() && !quoted => words.extend(word.take()),
            _ => word.get_or_insert_default().push(letter),
        }
    }
    words.extend(word);
    words
}

/// A CGATS text with these columns, in percent like Argyll's reflectances: rows of `SAMPLE_ID` and values.
pub(super) fn text(wavelengths_nm: &[f64], rows: &[(String, &[f64])]) -> String {
    let columns: Vec<String> = wavelengths_nm.iter().map(|nm| format!("SPEC_{nm:03.0}")).collect();
    let (count, first_nm) = (columns.len(), wavelengths_nm[0]);
    let mut text = format!(
        "SPECT\n\nORIGINATOR \"vfold\"\nMEAS_TYPE \"REFLECTIVE\"\nSPECTRAL_BANDS \"{count}\"\n\
         SPECTRAL_START_NM \"{first_nm}\"\nSPECTRAL_END_NM \"{}\"\nSPECTRAL_NORM \"100\"\n\n\
         KEYWORD \"SAMPLE_ID\"\nNUMBER_OF_FIELDS {}\nBEGIN_DATA_FORMAT\nSAMPLE_ID {}\nEND_DATA_FORMAT\n\n\
         NUMBER_OF_SETS {}\nBEGIN_DATA\n",
        wavelengths_nm[count - 1],
        count + 1,
        columns.join(" "),
        rows.len()
    );
    for (name, values) in rows {
        let percent: Vec<String> = values.iter().map(|value| (100.0 * value).to_string()).collect();
        text += &format!("\"{name}\" {}\n", percent.join(" "));
    }
    text + "END_DATA\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(header: &str, format: &str, data: &str) -> String {
        format!(
            "CGATS.17\n{header}\nBEGIN_DATA_FORMAT\n{format}\nEND_DATA_FORMAT\nBEGIN_DATA\n{data}\nEND_DATA\n"
        )
    }

    #[test]
    fn every_exporters_columns_are_known() {
        for (prefix, scale) in
            [("SPEC_", "SPECTRAL_NORM \"100\""), ("SPECTRAL_NM", ""), ("nm", ""), ("SPECTRAL_NM_", "")]
        {
            let format = format!("SAMPLE_ID\tSAMPLE_NAME RGB_R {prefix}400 {prefix}700");
            let text = with(scale, &format, "# a comment\n1\t\"dark red\" 255 20 40\nA2 x 0 50 60");
            let spectra =
                parse("x.ti3", &text).unwrap().in_fractions("x.ti3", None).unwrap().spectra("x.ti3");
            assert_eq!([spectra[0].name(), spectra[1].name()], ["1", "A2"]);
            assert_eq!(spectra[1].values(), [0.5, 0.6], "{prefix}");
            assert_eq!(spectra[0].note().is_some(), scale.is_empty(), "what the norm says needs no note");
        }
    }

    #[test]
    fn wavelengths_have_the_digits_of_the_keywords() {
        let keys = "SPECTRAL_BANDS 3\nSPECTRAL_START_NM \"400\"\nSPECTRAL_END_NM \"405\"";
        let table = parse("x.sp", &with(keys, "SPEC_400 SPEC_403 SPEC_405", "1 2 3")).unwrap();
        assert_eq!(table.spectra[0].wavelengths_nm(), [400.0, 402.5, 405.0]);
        assert_eq!(table.spectra[0].name(), "1");
    }

    #[test]
    fn files_that_lie_are_refused() {
        for (header, format, data, want) in [
            ("SPECTRAL_BANDS -5", "SPEC_400 SPEC_500", "1 2", "SPECTRAL_BANDS is '-5', but the file has 2"),
            ("NUMBER_OF_SETS 1000000000000", "SPEC_400 SPEC_500", "1 2", "but the file has 1 row"),
            ("NUMBER_OF_FIELDS 3", "SPEC_400 SPEC_500", "1 2", "but the file has 2 columns"),
            ("SPECTRAL_NORM 0", "SPEC_400 SPEC_500", "1 2", "SPECTRAL_NORM 0 is not a scale"),
            ("SPECTRAL_NORM nan", "SPEC_400 SPEC_500", "1 2", "'nan' is not a number"),
            ("SPECTRAL_START_NM 380\nSPECTRAL_END_NM 500", "SPEC_400 SPEC_500", "1 2", "400 nm is 380 nm"),
            ("", "SPEC_500 SPEC_400", "1 2", "order of wavelengths"),
            ("", "SPEC_500", "1", "fewer than two wavelengths"),
            ("", "RGB_R RGB_G", "1 2", "no columns of spectra"),
            ("", "SPEC_400 SPEC_500", "1 nan", "column 'SPEC_500': 'nan' is not a number"),
            ("", "SPEC_400 SPEC_500", "1 2\n3", "x.sp:8: 1 value, but the format has 2 columns"),
            ("", "SPEC_400 SPEC_500", "1 1e308", "is too large"),
            ("", "SPEC_400 SPEC_500", "", "no samples"),
            ("", "SAMPLE_ID SPEC_400 SPEC_500", "a 1 2\na 3 4", "two samples are called 'a'"),
        ] {
            let message = parse("x.sp", &with(header, format, data)).unwrap_err().to_string();
            assert!(message.contains(want), "{want}: {message}");
        }
        let cut = with("", "SPEC_400 SPEC_500", "1 2").replace("END_DATA\n", "");
        assert!(parse("x.sp", &cut).unwrap_err().to_string().contains("END_DATA is missing"));
        assert!(parse("x.sp", "").unwrap_err().to_string().contains("not a CGATS table"));
    }
}
