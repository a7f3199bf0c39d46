//! Checks of what is marked as white: a card or paper next to the sheet, not the sheet itself or a shadow.

use std::collections::BTreeMap;
use std::path::Path;

use nalgebra::DMatrix;
use vfold::calibrate::Patch;
use vfold::image::{FacetMeasurement, Homography};
use vfold::stream::Corners;
use vfold::{Error, Result};

/// Points along each side of the grid that samples a card, and the share of them that may lie on a panel:
/// corners are marked to a few pixels.
const POINTS: usize = 20;
const OVERLAP: f64 = 0.1;
/// Largest light of the sheet relative to one that reflects all light. Dyes that fluoresce reach 1.5 in a
/// channel, and a sun elsewhere than stated changes the mean of both panels by a fifth.
const BRIGHTEST: f64 = 2.0;

/// # Errors
/// [`Error::Picture`] if what is marked as white is on a panel.
pub fn check_off_panels(path: &Path, white: Corners, panels: &BTreeMap<usize, Corners>) -> Result<()> {
    let card = Homography::from_unit_square(white)?;
    let middle = |n: usize| (n as f64 + 0.5) / POINTS as f64;
    let points: Vec<_> =
        (0..POINTS * POINTS).map(|n| card.to_image(middle(n / POINTS), middle(n % POINTS))).collect();
    for (number, corners) in panels {
        let panel = Homography::from_unit_square(*corners)?;
        let is_on_panel = |point| {
            let (u, v) = panel.to_panel(point);
            (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v)
        };
        let on_panel = points.iter().filter(|point| is_on_panel(**point)).count();
        if on_panel as f64 > OVERLAP * points.len() as f64 {
            let problem = format!("the white region overlaps panel {number}");
            return Err(Error::picture(
                path,
                problem,
                "mark a card or paper beside the sheet (--white-region)",
            ));
        }
    }
    Ok(())
}

/// Compares the sheet with a `perfect` one, which reflects all light: RGB at exposure 1, facet by channel.
///
/// # Errors
/// [`Error::Picture`] if `white` is so dark that the sheet would have to be far brighter than that.
pub fn is_white(
    path: &Path,
    white: &Patch,
    perfect: &DMatrix<f64>,
    facets: &[FacetMeasurement],
) -> Result<()> {
    let relative = |channel: usize| {
        let seen = facets.iter().enumerate().filter_map(|(n, facet)| Some((n, facet.mean.as_ref()?)));
        let (sheet, of_perfect) = seen.fold((0.0, 0.0), |(sheet, of_perfect), (n, mean)| {
            (sheet + mean[channel], of_perfect + perfect[(n, channel)])
        });
        sheet / of_perfect * white.expected[channel] / white.measured[channel]
    };
    let channels = (0..white.measured.len()).filter(|channel| white.measured[*channel] > 0.0);
    let brightest = channels.map(relative).fold(0.0, f64::max);
    if brightest > BRIGHTEST {
        let problem = format!(
            "the white region is too dark: beside it the sheet is {brightest:.1} times as bright as one that \
             reflects all light"
        );
        let remedy = "mark a white card or paper (--white-region), or state its --white-reflectance and \
                      --white-cos";
        return Err(Error::picture(path, problem, remedy));
    }
    Ok(())
}
