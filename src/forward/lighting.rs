//! The lights of a fold, each with the camera's response to it.

use crate::camera::CameraResponse;
use crate::geometry::Light;
use crate::response::ModeLight;

/// The lights of a scene as the camera responds to them.
#[derive(Clone, Debug)]
pub struct Lighting {
    /// Where the sun stands and how much sky there is.
    pub light: Light,
    /// Response of the camera to the sun.
    pub sun: CameraResponse,
    /// Response to the sky, scaled to 1 in the sun's reference channel; needed only where the light has a sky.
    pub sky: CameraResponse,
}

impl Lighting {
    /// The lights of the scene: the sun, and the sky if there is one, each with the camera's response to it.
    pub fn sources(&self) -> impl Iterator<Item = (ModeLight, &CameraResponse)> + Clone {
        let sun = (ModeLight::Sun(self.light.panel_irradiance()), &self.sun);
        let sky = (ModeLight::Sky(self.light.sky()), &self.sky);
        std::iter::once(sun).chain((self.light.sky() > 0.0).then_some(sky))
    }

    /// RGB at exposure 1 of a flat sheet of this `reflectance`, a number a waveband, outside the fold: the sun meets it at an angle
    /// of cosine `cos`, nothing hides the sky.
    ///
    /// # Example
    /// ```
    /// use vfold::camera::CameraResponse;
    /// use vfold::forward::Lighting;
    /// use vfold::geometry::{FacetGrid, Fold, Light};
    /// let light = Light::new(&Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?, 0.0, 0.0, 0.2)?;
    /// let camera = CameraResponse::from_weights(vec![vec![0.75, 0.25]]);
    /// let lighting = Lighting { light, sun: camera.clone(), sky: camera };
    /// assert_eq!(lighting.flat_rgb(0.8, &[1.0, 1.0]), [1.0]); // 0.8 from the sun, 0.2 from the sky
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn flat_rgb(&self, cos: f64, reflectance: &[f64]) -> Vec<f64> {
        let seen = |camera: &CameraResponse, channel| -> f64 {
            camera.channel(channel).iter().zip(reflectance).map(|(weight, r)| weight * r).sum()
        };
        (0..self.sun.channels())
            .map(|channel| cos * seen(&self.sun, channel) + self.light.sky() * seen(&self.sky, channel))
            .collect()
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
    /// Which of the responses.
    pub response: usize,
    /// The light.
    pub light: ModeLight,
    /// The camera's response to it.
    pub camera: &'a CameraResponse,
}
