//! What a program did to a picture that passes for a sensor's own numbers, as its noise tells.

use super::measurement::FacetMeasurement;
use super::mixed_channels::are_channels_mixed;
use super::noise_growth::noise_falls;
use crate::image::numbers::Transfer;
use crate::image::photograph::Photograph;
use crate::image::placing::Homography;

/// What was done to a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Processing {
    /// Its numbers follow the light by a curve such as sRGB's.
    Curve,
    /// A matrix mixed its channels.
    Matrix,
}

/// What was done to a photograph that was read as linear, and nothing of it undone; none if nothing shows, or
/// noise does not.
///
/// # Arguments
/// - `panels`: where the sheet is.
/// - `facets`: as [`measure`](super::measure) gives them.
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
