//! The sources around a fold, as the light of a photograph: the sun and a stated sky.

use nalgebra::Vector3;

use crate::error::Result;
use crate::geometry::{Fold, Light, LightSource};

/// The stated light on a fold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedLight {
    /// Sun and sky, the latter treated as uniform.
    pub light: Light,
    /// The sky, if it is not uniform.
    pub sky: Option<StatedSky>,
    /// True if there are lights other than one sun and one sky, or a sun that leaves a panel in shade.
    pub is_other: bool,
}

/// A sky with a horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedSky {
    /// True if it is covered by clouds.
    pub is_overcast: bool,
    /// Unit vector towards the zenith, in the coordinates of [`Fold::panels`].
    pub zenith: Vector3<f64>,
}

impl From<Light> for StatedLight {
    fn from(light: Light) -> Self {
        Self { light, sky: None, is_other: false }
    }
}

impl StatedLight {
    /// From these sources.
    ///
    /// # Errors
    /// As [`Light::new`].
    pub fn of(sources: &[LightSource], fold: &Fold) -> Result<Self> {
        let (skies, lights): (Vec<&LightSource>, Vec<&LightSource>) =
            sources.iter().partition(|source| source.is_sky());
        let light = match (lights.as_slice(), skies.as_slice()) {
            ([], [_]) => Light::new(fold, 0.0, 0.0, f64::INFINITY).ok(),
            ([LightSource::Directional { towards, irradiance }], [] | [_]) => {
                let [tilt_deg, slant_deg] =
                    [towards.x.atan2(towards.z), towards.y.asin()].map(f64::to_degrees);
                let sky = skies.first().map_or(0.0, |sky| sky.irradiance() / irradiance);
                Light::new(fold, tilt_deg, slant_deg, sky).ok()
            }
            _ => None,
        };
        let Some(light) = light else {
            let light = Light::new(fold, 0.0, 0.0, f64::INFINITY)?;
            return Ok(Self { light, sky: None, is_other: true });
        };
        Ok(Self { light, sky: skies.first().and_then(|sky| StatedSky::of(sky)), is_other: false })
    }
}

impl StatedSky {
    /// True if the zenith was stated; by default it is the direction in which the fold opens.
    pub fn is_zenith_stated(&self) -> bool {
        self.zenith != Vector3::z()
    }

    fn of(source: &LightSource) -> Option<Self> {
        match source {
            LightSource::OvercastSky { zenith, .. } => Some(Self { is_overcast: true, zenith: *zenith }),
            LightSource::StandardSky { sky, zenith, .. } => {
                Some(Self { is_overcast: sky.is_overcast(), zenith: *zenith })
            }
            LightSource::Directional { .. }
            | LightSource::Point { .. }
            | LightSource::Area { .. }
            | LightSource::UniformSky { .. }
            | LightSource::PerFacet => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{FacetGrid, StandardSky};

    /// A sun written by vkernel as a source is read back unchanged.
    #[test]
    fn a_source_is_the_sun_that_it_was() {
        let fold = Fold::new(50.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 }).unwrap();
        let light = Light::new(&fold, 6.0, -10.0, 0.4).unwrap();
        let sun = LightSource::directional(light.towards().into(), 2.0).unwrap();
        let sky =
            LightSource::standard_sky(StandardSky::CLEAR, [0.0, 0.6, 0.8], [0.0, 0.0, 1.0], 0.8).unwrap();
        let stated = StatedLight::of(&[sun, sky], &fold).unwrap();
        assert!(
            (stated.light.tilt_deg() - 6.0).abs() < 1e-12 && (stated.light.slant_deg() + 10.0).abs() < 1e-12
        );
        assert!((stated.light.sky() - 0.4).abs() < 1e-12 && !stated.is_other);
        assert!(stated.sky.is_some_and(|sky| !sky.is_overcast && (sky.zenith.y - 0.6).abs() < 1e-12));
        let lamp = LightSource::point([0.0, 0.0, 2.0], 1.0, 2.0).unwrap();
        assert!(StatedLight::of(&[sun, lamp], &fold).unwrap().is_other);
    }
}
