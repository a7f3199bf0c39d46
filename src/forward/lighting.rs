//! The lights of a fold, each with the camera's response to it.

use crate::camera::CameraResponse;
use crate::geometry::Light;
use crate::response::ModeLight;

/// The lights of a scene as the camera responds to them.
#[derive(Clone, Debug)]
pub struct Lighting {
    /// Direction of the sun, and irradiances of sun and sky.
    pub light: Light,
    /// Response of the camera to the sun.
    pub sun: CameraResponse,
    /// Response to the sky, scaled like the sun's response, whose reference channel is 1; used only with a
    /// sky.
    pub sky: CameraResponse,
}

impl Lighting {
    /// The sun and the sky, where present, each with the camera's response to it.
    pub fn sources(&self) -> impl Iterator<Item = (ModeLight, &CameraResponse)> + Clone {
        let sun = (ModeLight::Sun(self.light.panel_irradiance()), &self.sun);
        let sky = (ModeLight::Sky(self.light.sky()), &self.sky);
        let sun = (self.light.sun() > 0.0).then_some(sun);
        sun.into_iter().chain((self.light.sky() > 0.0).then_some(sky))
    }

    /// The wavebands in which at least one channel sees one of the lights.
    #[must_use]
    pub fn seen_bands(&self) -> Vec<usize> {
        seen_bands(self.sources().map(|(_, camera)| camera))
    }
}

/// The wavebands in which at least one channel of `cameras` sees anything.
pub fn seen_bands<'a>(cameras: impl Iterator<Item = &'a CameraResponse> + Clone) -> Vec<usize> {
    let bands = cameras.clone().next().map_or(0, CameraResponse::bands);
    (0..bands).filter(|band| cameras.clone().any(|camera| camera.sees(*band))).collect()
}

/// A light on a fold of known response, and how the camera sees it.
pub struct Lit<'a> {
    /// Index of the response.
    pub response: usize,
    /// The light.
    pub light: ModeLight,
    /// The camera's response to it.
    pub camera: &'a CameraResponse,
}
