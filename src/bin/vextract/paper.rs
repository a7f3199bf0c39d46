//! White paper in a photograph, which shows the exposure.

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
    let green = if patch.expected.len() == 3 { 1 } else { view.light.sun().reference_channel() };
    if patch.measured[green] <= 0.0 {
        let problem = "white paper: no light is left of it";
        return Err(Error::picture(view.path, problem, "check --white-region and --black-level"));
    }
    let exposure = patch.measured[green] / patch.expected[green];
    let sd = LUMINANCE_FACTOR_SD.hypot(patch.standard_error[green] / patch.measured[green]);
    Ok(WhitePaperRecord::new((target.cos(), corners), patch.measured, (exposure, exposure * sd)))
}
