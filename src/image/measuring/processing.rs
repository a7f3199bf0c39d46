//! Detects, from its noise, that a picture presented as a sensor's own numbers was processed.

use super::measurement::FacetMeasurement;
use super::mixed_channels::are_channels_mixed;
use super::noise_growth::noise_falls;
use crate::image::numbers::Transfer;
use crate::image::photograph::Photograph;
use crate::image::placing::Homography;

/// Processing of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Processing {
    /// A curve such as sRGB's was applied.
    Curve,
    /// A matrix mixed its channels.
    Matrix,
}

/// Processing of a photograph that was read as linear with nothing undone; none if there is no sign of it, or
/// no noise.
///
/// # Arguments
/// - `panels`: positions on the sheet.
/// - `facets`: from [`measure`](super::measure).
pub(super) fn processing(
    photograph: &Photograph,
    panels: &[Homography],
    facets: &[FacetMeasurement],
) -> Option<Processing> {
    let info = photograph.info();
    let passes_for_a_sensors =
        info.transfer_used == Transfer::Linear && info.undone.is_none() && info.sensor.is_none();
    match () {
        () if !passes_for_a_sensors || photograph.is_divided() => None,
        () if noise_falls(facets) => Some(Processing::Curve),
        () if are_channels_mixed(photograph, panels) => Some(Processing::Matrix),
        () => None,
    }
}
