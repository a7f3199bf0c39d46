//! What the records of scene and sample contribute to the choice of an estimate.

use super::{FoldSetting, PhotographedFold, Picture};
use crate::error::Result;
use crate::estimate::light::Others;
use crate::estimate::measured::Measured;
use crate::estimate::measurement::Photographed;
use crate::estimate::other_camera::OtherCameras;
use crate::estimate::shadow::Shadow;
use crate::estimate::taking::Stated;
use crate::estimate::{Exposure, TELLING_CHANNELS};
use crate::forward::FacetValues;
use crate::image::Making;
use crate::spectrum::have_one_peak;
use crate::stream::{Optics, Sample};

/// The stated light and camera; `is_daylight_assumed` marks daylight that nobody stated.
#[must_use]
pub fn stated(Optics { camera, illuminants, .. }: &Optics, is_daylight_assumed: bool) -> Stated {
    Stated {
        lights: illuminants.iter().map(|light| light.name.clone()).collect(),
        is_daylight_assumed,
        camera: camera.name.clone(),
        stands_in_for: camera.stands_in.as_ref().map(|one| one.camera.clone()),
        is_predicted: camera.stands_in.as_ref().is_some_and(|one| one.is_predicted),
        has_one_peak: have_one_peak(camera.sensitivities.iter().map(Vec::as_slice)),
    }
}

/// Alternatives to the light of a scene, if it has a single, stated light and the camera sees colours.
#[must_use]
pub fn other_lights(
    Optics { grid, camera, illuminants, sky }: &Optics,
    is_daylight_assumed: bool,
) -> Option<Others> {
    let is_stated = illuminants.len() == 1 && sky.is_none() && !is_daylight_assumed;
    (is_stated && camera.sensitivities.len() >= TELLING_CHANNELS)
        .then(|| Others::before(grid, &camera.sensitivities))
}

/// Alternatives to the camera of a scene, if it has three channels.
#[must_use]
pub fn other_cameras(Optics { grid, camera, .. }: &Optics) -> Option<OtherCameras> {
    OtherCameras::than(grid, &camera.sensitivities)
}

/// The photograph in which the facets of a sample were measured, without those in shadows. Only for a `fold`
/// does it have parts.
///
/// # Errors
/// [`crate::Error::Field`] if facets or corners do not fit the scene, or the photograph's record is invalid.
pub fn photographed(
    fold: Option<&FoldSetting>,
    sample: &Sample,
    (measured, shadows): (&Measured, Vec<Shadow>),
    exposure: Exposure,
) -> Result<Photographed> {
    let chart_residual = sample.chart_residual()?;
    let Some(fold) = fold else {
        return Ok(Photographed { making: Making::default(), chart_residual, shadows, parts: None });
    };
    let making = sample.making()?;
    // estimates normalised by sums assume ideal folds
    let parts = if exposure == Exposure::Sum {
        None
    } else {
        Some(PhotographedFold::of(fold).parts(&Picture::of(sample, measured, exposure.known())?)?)
    };
    Ok(Photographed { making, chart_residual, shadows, parts })
}

impl FoldSetting {
    /// The facets that are in no shadow, and the shadows on its panels.
    #[must_use]
    pub fn out_of_shadows(&self, rgb: &FacetValues, sd: &FacetValues) -> (FacetValues, Vec<Shadow>) {
        let shadows = Shadow::all(self.fold.facets(), &Measured { rgb, sd });
        (rgb.without(shadows.iter().flat_map(|shadow| shadow.facets.iter().copied())), shadows)
    }
}
