//! Texts of the command line.

use vfold::cli;
use vfold::image::{Mosaic, PANEL_CORNERS, Transfer, parse_corners};
use vfold::spectrum::{Spectrum, WavelengthGrid};
use vfold::stream::specs;

use super::{assert_finite, taken};

/// Names of spectra that are not files.
pub fn spec(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let is_sky = text.starts_with("sun:") || text.starts_with("sky:");
    if text.contains('/') || text.contains('.') && text.parse::<f64>().is_err() && !is_sky {
        return;
    }
    if let Some(spectra) = taken(specs().reflectances(text)) {
        let values = spectra.iter().flat_map(Spectrum::values);
        assert!(!spectra.is_empty() && values.into_iter().all(|r| (0.0..=1.0).contains(r)));
    }
    taken(specs().illuminant(text)).iter().for_each(|light| assert_finite("illuminant", light.values()));
    taken(specs().camera(text)).iter().for_each(|camera| assert!(!camera.channels.is_empty()));
}

/// What flags take besides.
pub fn values(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let _ = (cli::pair::<usize>(text), cli::pair::<f64>(text), cli::drawing(text), Mosaic::new(text));
    if let Ok(vector) = cli::vector(text) {
        assert_finite("vector", &vector);
    }
    taken(text.parse::<Transfer>());
    if let Some(corners) = taken(parse_corners("--panel0", text, &PANEL_CORNERS)) {
        assert_finite("corners", corners.iter().flat_map(|corner| [&corner.x, &corner.y]));
    }
    let numbers: Vec<f64> = text.split(':').filter_map(|part| part.parse().ok()).collect();
    if let [first, last, step] = numbers[..]
        && let Some(grid) = taken(WavelengthGrid::uniform(first, last, step))
    {
        assert!(grid.len() >= 2 && grid.wavelengths_nm().is_sorted_by(|a, b| a < b));
        assert_finite("weights", &grid.trapezoid_weights_nm());
    }
}
