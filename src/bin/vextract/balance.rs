//! Colour balance of pictures for the eye.

use vfold::Result;
use vfold::camera::CameraResponse;
use vfold::image::{Balance, Photograph, White};
use vfold::spectrum::WavelengthGrid;
use vfold::stream::{CameraRecord, Scene, SpectrumRecord};

use super::{Args, camera};

/// From the camera and the first light of a scene, which may have neither.
pub fn of_scene(scene: &Scene, photograph: &Photograph) -> Balance {
    let white = || white(&scene.grid()?, &scene.camera()?, &scene.illuminants()?);
    Balance::of(photograph, white().ok().flatten().as_ref())
}

/// From the stated camera, or the one named in the photograph, in the stated light. A preview needs neither.
pub fn of_photograph(args: &Args, photograph: &Photograph) -> Balance {
    let white = || {
        let Some(camera) = camera::camera(args.camera.as_deref(), Some(photograph))? else { return Ok(None) };
        let optics =
            args.optics.resolve(&camera.sensitivities(|spec| args.common.camera(spec))?, &args.common)?;
        white(&optics.grid, &optics.camera, &optics.illuminants)
    };
    Balance::of(photograph, white().ok().flatten().as_ref())
}

fn white(grid: &WavelengthGrid, camera: &CameraRecord, lights: &[SpectrumRecord]) -> Result<Option<White>> {
    let Some(light) = lights.first() else { return Ok(None) };
    let response = CameraResponse::new(grid, &camera.sensitivities, &light.power)?;
    Ok(Some(White { values: response.white(), by: format!("{} in {}", camera.name, light.name) }))
}
