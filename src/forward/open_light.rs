//! The light of a scene on an unobstructed flat sheet: a chart, or a white card.

use super::lighting::{Lighting, seen_bands};
use crate::camera::CameraResponse;
use crate::geometry::LightSource;

/// The lights of a scene as the camera responds to them, independent of the surface they fall on.
#[derive(Clone, Debug)]
pub struct OpenLight {
    /// The first is the sun or its substitute.
    sources: Vec<OpenSource>,
}

#[derive(Clone, Debug)]
struct OpenSource {
    irradiance: f64,
    is_sky: bool,
    camera: CameraResponse,
}

impl OpenLight {
    /// From the lights around a surface, at least one, each with the camera's response to it.
    #[must_use]
    pub fn new(sources: &[(LightSource, CameraResponse)]) -> Self {
        let open = |(source, camera): &(LightSource, CameraResponse)| OpenSource {
            irradiance: source.irradiance(),
            is_sky: source.is_sky(),
            camera: camera.clone(),
        };
        Self { sources: sources.iter().map(open).collect() }
    }

    /// RGB at exposure 1 of a flat sheet outside the scene with this `reflectance` per waveband. `cos` is the
    /// cosine of the sun's incidence; the sky is unobstructed, and other lamps do not reach the sheet.
    ///
    /// # Example
    /// ```
    /// use vfold::camera::CameraResponse;
    /// use vfold::forward::OpenLight;
    /// use vfold::geometry::LightSource;
    /// let camera = CameraResponse::from_weights(vec![vec![0.75, 0.25]]);
    /// let sun = (LightSource::directional([0.0, 0.0, 1.0], 1.0)?, camera.clone());
    /// let sky = (LightSource::uniform_sky(0.2)?, camera);
    /// // 0.8 from the sun, 0.2 from the sky
    /// assert_eq!(OpenLight::new(&[sun, sky]).flat_rgb(0.8, &[1.0, 1.0]), [1.0]);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn flat_rgb(&self, cos: f64, reflectance: &[f64]) -> Vec<f64> {
        let mut rgb = vec![0.0; self.sun().channels()];
        for (n, source) in self.sources.iter().enumerate() {
            let share = match source {
                OpenSource { is_sky: true, irradiance, .. } => *irradiance,
                _ if n == 0 => cos * source.irradiance,
                _ => 0.0,
            };
            for (channel, value) in rgb.iter_mut().enumerate() {
                let weights = source.camera.channel(channel).iter();
                *value += share * weights.zip(reflectance).map(|(weight, r)| weight * r).sum::<f64>();
            }
        }
        rgb
    }

    /// The camera's response to the sun or its substitute.
    #[must_use]
    pub fn sun(&self) -> &CameraResponse {
        &self.sources[0].camera
    }

    /// The wavebands in which at least one channel sees one of the lights.
    #[must_use]
    pub fn seen_bands(&self) -> Vec<usize> {
        seen_bands(self.sources.iter().map(|source| &source.camera))
    }
}

impl From<&Lighting> for OpenLight {
    fn from(lighting: &Lighting) -> Self {
        let sun =
            OpenSource { irradiance: lighting.light.sun(), is_sky: false, camera: lighting.sun.clone() };
        let sky = lighting.light.sky();
        let sky =
            (sky > 0.0).then(|| OpenSource { irradiance: sky, is_sky: true, camera: lighting.sky.clone() });
        Self { sources: std::iter::once(sun).chain(sky).collect() }
    }
}
