//! White paper in a photograph, or in another of nothing else, which shows the exposure.

use std::path::Path;

use vfold::error::counted;
use vfold::forward::OpenLight;
use vfold::image::{FlatField, Photograph};
use vfold::spectrum::WavelengthGrid;
use vfold::stream::{Corners, WhitePaperRecord};
use vfold::{Error, Result};

use super::target::{Target, View};

/// Luminance factor of white printing and office paper, L* 93.5 to 97, and its relative standard deviation.
/// For print: ISO 12647-2:2013, table 2.
const LUMINANCE_FACTOR: f64 = 0.88;
const LUMINANCE_FACTOR_SD: f64 = 0.05;

/// Paper whose normal is at an angle of cosine `cos` to the sun.
pub fn target(cos: f64, grid: &WavelengthGrid) -> Target {
    Target::even(("white paper", "--white-region"), cos, LUMINANCE_FACTOR, grid)
}

/// The exposure that paper between `corners` shows: that of its green channel, because brighteners add blue
/// light.
///
/// # Errors
/// As [`Target::measure`], and [`Error::Picture`] for paper without light.
pub fn exposure(target: &Target, view: &View, corners: Corners) -> Result<WhitePaperRecord> {
    let patch = target.measure(view, corners)?.swap_remove(0);
    let green = green(view.light, patch.expected.len());
    if patch.measured[green] <= 0.0 {
        let problem = "the white region has no light above black";
        return Err(Error::picture(view.path, problem, "check --white-region and --black-level"));
    }
    let exposure = patch.measured[green] / patch.expected[green];
    let sd = LUMINANCE_FACTOR_SD.hypot(patch.standard_error[green] / patch.measured[green]);
    Ok(WhitePaperRecord::new(
        (view.path, Some(corners)),
        target.cos(),
        patch.measured,
        [exposure, exposure * sd],
    ))
}

/// The exposure that another picture of nothing but white paper shows, in the same light and divided by it,
/// if both record the camera's settings.
///
/// # Errors
/// [`Error::Picture`] if it has other channels than the camera.
pub fn exposure_of_sheet(
    target: &Target,
    light: &OpenLight,
    (path, sheet): (&Path, &FlatField),
    photograph: &Photograph,
) -> Result<Option<WhitePaperRecord>> {
    let (Some(own), Some(of_sheet)) =
        (photograph.info().white_per_klx(), sheet.photograph().info().white_per_klx())
    else {
        return Ok(None);
    };
    let expected = target.expected(light);
    let measured: Vec<f64> = sheet.mean()[..photograph.channels()].to_vec();
    if measured.len() != expected.len() {
        let problem = format!("the photograph has {}", counted(measured.len(), "channel"));
        return Err(Error::picture(path, problem, "give the photograph's --camera"));
    }
    let green = green(light, expected.len());
    let exposure = measured[green] / expected[green] * own / of_sheet;
    let exposures = [exposure, exposure * LUMINANCE_FACTOR_SD];
    Ok(Some(WhitePaperRecord::new((path, None), target.cos(), measured, exposures)))
}

/// The channel whose light brighteners do not add to.
fn green(light: &OpenLight, channels: usize) -> usize {
    if channels == 3 { 1 } else { light.sun().reference_channel() }
}
