//! Detects, from its noise, that a picture presented as a sensor's own numbers was processed.

use super::facets::measure;
use super::measurement::FacetMeasurement;
use super::mixed_channels::are_channels_mixed;
use super::noise_growth::noise_falls;
use crate::error::Result;
use crate::image::numbers::Transfer;
use crate::image::photograph::Photograph;
use crate::image::placing::{Grid, Homography};

/// Processing of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Processing {
    /// A curve such as sRGB's was applied.
    Curve,
    /// A matrix mixed its channels.
    Matrix,
    /// A curve was applied to the photograph of the white sheet by which it is divided.
    CurveOfFlatField,
}

/// Processing of a photograph that was read as linear with nothing undone; none if there is no sign of it, or
/// no noise. Noise is that of the numbers before they are divided by a flat field.
///
/// # Arguments
/// - `panels`, `margin_px`: as for [`measure`].
/// - `facets`: from [`measure`].
///
/// # Errors
/// As [`measure`].
pub(super) fn processing(
    photograph: &Photograph,
    panels: &[Grid],
    margin_px: f64,
    facets: &[FacetMeasurement],
) -> Result<Option<Processing>> {
    let division = photograph.before_division();
    let own = match &division {
        _ if !passes_for_a_sensors(photograph) => None,
        None => of_numbers(photograph, panels, facets),
        Some((undivided, _)) => of_numbers(undivided, panels, &measure(undivided, panels, margin_px)?),
    };
    match division {
        // a matrix would leave the distribution of the light as it is
        Some((_, sheet))
            if own.is_none()
                && passes_for_a_sensors(sheet)
                && noise_falls(&measure(sheet, panels, margin_px)?) =>
        {
            Ok(Some(Processing::CurveOfFlatField))
        }
        _ => Ok(own),
    }
}

/// Processing that the noise of undivided numbers shows.
fn of_numbers(photograph: &Photograph, panels: &[Grid], facets: &[FacetMeasurement]) -> Option<Processing> {
    let outlines: Vec<Homography> = panels.iter().map(|panel| panel.outline.clone()).collect();
    match () {
        () if noise_falls(facets) => Some(Processing::Curve),
        () if are_channels_mixed(photograph, &outlines) => Some(Processing::Matrix),
        () => None,
    }
}

fn passes_for_a_sensors(photograph: &Photograph) -> bool {
    let info = photograph.info();
    info.transfer_used == Transfer::Linear && info.undone.is_none() && info.sensor.is_none()
}
