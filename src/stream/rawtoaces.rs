//! Spectra in the format of the Academy Software Foundation's rawtoaces project: cameras, illuminants,
//! training data.
//!
//! Schemas 1.0.0 and 0.1.0: `index.main` names the spectra, `data.main` has their values at each wavelength
//! in nm.

use std::collections::HashMap;
use std::ops::RangeInclusive;

use serde::Deserialize;

use super::json_file;
use crate::error::{Error, Result, counted};
use crate::spectrum::Spectrum;
use crate::spectrum::formats::Table;
use crate::spectrum::spec::Specs;

#[derive(Deserialize)]
struct SpectraFile {
    spectral_data: SpectralData,
}

#[derive(Deserialize)]
struct SpectralData {
    /// Quantity of the spectra, in the terms of IES TM-27.
    units: Option<String>,
    index: Main<Vec<String>>,
    data: Main<HashMap<String, Vec<f64>>>,
}

#[derive(Deserialize)]
struct Main<T> {
    main: T,
}

/// Accepted wavelengths, as in other files.
const NM: RangeInclusive<f64> = 100.0..=3000.0;

const EXAMPLE: &str = "{\"spectral_data\": {\"index\": {\"main\": [\"R\", \"G\", \"B\"]}, \
                       \"data\": {\"main\": {\"380\": [r, g, b], ..}}}}";

/// Resolves a SPEC of a camera, an illuminant or reflectances as [`crate::spectrum`] does, and rawtoaces
/// files, whose names end in `.json`.
///
/// # Example
/// ```
/// let file = tempfile::Builder::new().suffix(".json").tempfile().unwrap();
/// let text = r#"{"spectral_data": {"index": {"main": ["R", "G"]},
///     "data": {"main": {"500": [0.1, 1], "600": [1, 0.2]}}}}"#;
/// std::fs::write(file.path(), text).unwrap();
/// let camera = vfold::stream::specs().camera(file.path().to_str().unwrap())?;
/// assert_eq!((camera.channels[1].name(), camera.channels[1].values()), ("G", &[1.0, 0.2][..]));
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn specs() -> Specs {
    Specs::with_json(read)
}

/// The spectra of a rawtoaces file.
fn read(path: &str, text: &str) -> Result<Table> {
    let SpectraFile { spectral_data: SpectralData { units, index, data } } =
        json_file::parse(path, text, EXAMPLE)?;
    let refused = |problem: String| {
        Error::spectrum(path, problem, "give each wavelength, in nm, one number per spectrum")
    };
    let count = index.main.len();
    let mut rows = Vec::new();
    for (key, row) in data.main {
        let nm = key.parse().ok().filter(|nm| NM.contains(nm));
        let nm: f64 = nm.ok_or_else(|| refused(format!("'{key}' is not a wavelength in nm")))?;
        if row.len() != count {
            let (numbers, spectra) = (counted(row.len(), "number"), counted(count, "spectrum"));
            return Err(refused(format!("{numbers} at {nm} nm for {spectra}")));
        }
        rows.push((nm, row));
    }
    if rows.is_empty() || count == 0 {
        return Err(refused("it has no wavelengths or no spectra".to_owned()));
    }
    rows.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let wavelengths_nm: Vec<f64> = rows.iter().map(|(nm, _)| *nm).collect();
    let spectrum = |(k, name): (usize, &String)| {
        Spectrum::new(name, wavelengths_nm.clone(), rows.iter().map(|(_, row)| row[k]).collect())
    };
    Ok(Table::new(index.main.iter().enumerate().map(spectrum).collect::<Result<_>>()?)?
        .called(&units.unwrap_or_default()))
}
