//! `--sky`: a number, a clear sky, or the sky alone.

use vfold::colorimetry::{Colorimeter, Observer};
use vfold::spectrum::{ClearSky, Outside, Sun, WavelengthGrid};
use vfold::{Error, Result};

/// Parses the light of the sky relative to the sun: a number, `sun:WHERE`, the position of the sun, or
/// `only`, which is infinite.
///
/// # Errors
/// A message for the command line.
pub fn share(text: &str) -> std::result::Result<f64, String> {
    if text == "only" {
        return Ok(f64::INFINITY);
    }
    match text.strip_prefix("sun:") {
        Some(place) => of_clear_sky(place).map_err(|e| e.to_string()),
        None => text
            .parse()
            .ok()
            .filter(|share: &f64| share.is_finite())
            .ok_or_else(|| "write a number, sun:40deg, sun:LAT,LON,TIME, or only".to_owned()),
    }
}

/// Illuminance of level ground by the sky, relative to that of a plane facing the sun.
fn of_clear_sky(place: &str) -> Result<f64> {
    let (sky, grid) = (ClearSky::usual(Sun::parse(place)?), WavelengthGrid::uniform(380.0, 780.0, 5.0)?);
    let (direct, diffuse) = (sky.direct()?, sky.diffuse()?);
    let on_grid = |spectrum: &vfold::spectrum::Spectrum| spectrum.on(&grid, Outside::Refuse);
    let ratio: Vec<f64> =
        on_grid(&diffuse)?.iter().zip(on_grid(&direct)?).map(|(sky, sun)| sky / sun).collect();
    let [_, luminance, _] = Colorimeter::new(&grid, &direct, Observer::Cie1931_2deg)?.xyz(&ratio);
    let share = luminance / 100.0;
    if share.is_finite() {
        return Ok(share);
    }
    Err(Error::Numeric("so near the horizon no sunlight is left; give --sky a number".to_owned()))
}
