//! Cameras as the rawtoaces project of the Academy Software Foundation keeps them.
//!
//! Its schema 1.0.0, and 0.1.0 before it: `index.main` names the channels, `data.main` has their sensitivities at each
//! wavelength in nm.

use std::collections::HashMap;

use serde::Deserialize;

use super::json_file;
use crate::error::{Error, Result};
use crate::spectrum::{self, Sensitivities, Spectrum};

#[derive(Deserialize)]
struct CameraFile {
    spectral_data: SpectralData,
}

#[derive(Deserialize)]
struct SpectralData {
    index: Main<Vec<String>>,
    data: Main<HashMap<String, Vec<f64>>>,
}

#[derive(Deserialize)]
struct Main<T> {
    main: T,
}

const EXAMPLE: &str = "{\"spectral_data\": {\"index\": {\"main\": [\"R\", \"G\", \"B\"]}, \"data\": {\"main\": {\"380\": [r, g, b], ..}}}}";

/// The camera that `spec` names: as [`spectrum::camera`], or a rawtoaces file if the name ends in `.json`.
///
/// # Errors
/// As [`spectrum::camera`]; [`Error::Record`] with the line if a file is not of rawtoaces' form, [`Error::Spectrum`] if
/// its numbers are not sensitivities.
///
/// # Example
/// ```
/// let file = tempfile::Builder::new().suffix(".json").tempfile().unwrap();
/// let text = r#"{"spectral_data": {"index": {"main": ["R", "G"]}, "data": {"main": {"500": [0.1, 1], "600": [1, 0.2]}}}}"#;
/// std::fs::write(file.path(), text).unwrap();
/// let camera = vfold::stream::camera(file.path().to_str().unwrap())?;
/// assert_eq!((camera.channels[1].name(), camera.channels[1].values()), ("G", &[1.0, 0.2][..]));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn camera(spec: &str) -> Result<Sensitivities> {
    if !spec.to_ascii_lowercase().ends_with(".json") {
        return spectrum::camera(spec);
    }
    let CameraFile { spectral_data: SpectralData { index, data } } = json_file::read(spec, EXAMPLE)?;
    let refused = |problem: String| {
        let remedy = "give every wavelength, in nm, a number a channel".to_owned();
        Error::Spectrum { name: spec.to_owned(), problem, remedy }
    };
    let mut rows = Vec::new();
    for (key, row) in data.main {
        let nm: f64 = key.parse().map_err(|_| refused(format!("'{key}' is not a wavelength")))?;
        if row.len() != index.main.len() {
            return Err(refused(format!(
                "{} numbers at {nm} nm for {} channels",
                row.len(),
                index.main.len()
            )));
        }
        rows.push((nm, row));
    }
    if rows.is_empty() || index.main.is_empty() {
        return Err(refused("it has no wavelengths or no channels".to_owned()));
    }
    rows.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let wavelengths_nm: Vec<f64> = rows.iter().map(|(nm, _)| *nm).collect();
    let channel = |(k, name): (usize, &String)| {
        Spectrum::new(name, wavelengths_nm.clone(), rows.iter().map(|(_, row)| row[k]).collect())
    };
    Sensitivities::new(spec, index.main.iter().enumerate().map(channel).collect::<Result<_>>()?)
}
