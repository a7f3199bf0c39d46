//! Checks whether a detected chart faces the sun as stated.

use std::collections::BTreeMap;

use vfold::Result;
use vfold::image::{DetectedChart, Homography, Lens, camera_pose};
use vfold::scene::Setting;
use vfold::stream::{Corners, Regions};

/// A chart turned further than this, degrees, receives 3.4 % less light: the assumed error of an exposure by
/// a chart is 4 %.
const MOST_DEG: f64 = 15.0;

/// Least angle of a detected chart from the sun, degrees, if it exceeds what the stated cosine allows: the
/// chart is turned from the camera by its viewing angle, and the fold shows the angle between camera and sun.
///
/// # Errors
/// As [`Homography::through`].
pub fn turned_deg(setting: &Setting, regions: &Regions, lens: Lens, cos: f64) -> Result<Option<f64>> {
    let (Setting::Fold(setting), Some(chart)) = (setting, regions.chart) else { return Ok(None) };
    let Some(panels) = fold(&regions.panels, lens) else { return Ok(None) };
    let Some(eye) = camera_pose(&setting.fold, &panels) else { return Ok(None) };
    let corners = setting.fold.panels().map(|panel| panel.corners);
    let middle = corners.iter().flatten().sum::<nalgebra::Vector3<f64>>() / 8.0;
    let from_sun = (eye.position.coords - middle).angle(&setting.light.towards()).to_degrees();
    let [rows, cols] = DetectedChart::GRID.map(|count| count as f64);
    let from_camera = Homography::through(lens, chart)?.view_angle_deg([cols, rows]);
    let least = from_camera - from_sun;
    let is_lit_by_sun = setting.light.sun() > 0.0;
    Ok((is_lit_by_sun && least > MOST_DEG + cos.acos().to_degrees()).then_some(least))
}

/// Both panels of a fold, undistorted.
fn fold(panels: &BTreeMap<usize, Corners>, lens: Lens) -> Option<[Corners; 2]> {
    let panel = |number: usize| panels.get(&number).map(|panel| panel.map(|corner| lens.undistort(corner)));
    Some([panel(0)?, panel(1)?])
}
