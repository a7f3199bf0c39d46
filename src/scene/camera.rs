//! How the scene's camera responds to its illuminants.

use crate::camera::CameraResponse;
use crate::error::Result;
use crate::stream::{Scene, SpectrumRecord};

/// The camera's response to each illuminant.
pub(super) fn illuminant_responses(scene: &Scene) -> Result<Vec<CameraResponse>> {
    let (grid, camera) = (scene.grid()?, scene.camera()?);
    let response =
        |illuminant: &SpectrumRecord| CameraResponse::new(&grid, &camera.sensitivities, &illuminant.power);
    scene.illuminants()?.iter().map(response).collect()
}

/// The camera's response to the sky, that to the `sun` if the sky has no spectrum of its own.
pub(super) fn sky_response(scene: &Scene, sun: &CameraResponse) -> Result<CameraResponse> {
    match scene.sky_illuminant()? {
        Some(sky) => sun.to_other_light(&scene.grid()?, &scene.camera()?.sensitivities, &sky.power),
        None => Ok(sun.clone()),
    }
}
