//! Response of the scene's camera to its illuminants.

use crate::camera::CameraResponse;
use crate::error::Result;
use crate::stream::{Optics, SpectrumRecord};

/// The camera's response to each illuminant.
pub(super) fn illuminant_responses(optics: &Optics) -> Result<Vec<CameraResponse>> {
    let response = |illuminant: &SpectrumRecord| {
        CameraResponse::new(&optics.grid, &optics.camera.sensitivities, &illuminant.power)
    };
    optics.illuminants.iter().map(response).collect()
}

/// The camera's response to the sky; its response to the `sun` if the sky has no spectrum of its own.
pub(super) fn sky_response(optics: &Optics, sun: &CameraResponse) -> Result<CameraResponse> {
    match &optics.sky {
        Some(sky) => sun.to_other_light(&optics.grid, &optics.camera.sensitivities, &sky.power),
        None => Ok(sun.clone()),
    }
}
