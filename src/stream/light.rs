//! The scene's light: sun and sky on a fold, or sources around any surface.

use serde::{Deserialize, Serialize};

use super::Scene;
use crate::error::{Error, Result};
use crate::geometry::{Light, LightSource};

#[derive(Serialize, Deserialize)]
struct LightRecord {
    tilt_deg: f64,
    slant_deg: f64,
    sky: f64,
    #[serde(skip_deserializing)]
    panel_irradiance: [f64; 2],
}

#[derive(Serialize, Deserialize)]
struct SourcesRecord {
    sources: Vec<SourceRecord>,
}

/// A source as [`LightSource`] has it.
#[derive(Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
enum SourceRecord {
    Directional { towards: [f64; 3], irradiance: f64 },
    Point { at: [f64; 3], irradiance: f64, distance: f64 },
    UniformSky { irradiance: f64 },
    OvercastSky { zenith: [f64; 3], irradiance: f64 },
    Given,
}

impl From<&LightSource> for SourceRecord {
    fn from(source: &LightSource) -> Self {
        match *source {
            LightSource::Directional { towards, irradiance } => {
                Self::Directional { towards: towards.into(), irradiance }
            }
            LightSource::Point { at, irradiance, distance } => {
                Self::Point { at: at.into(), irradiance, distance }
            }
            LightSource::UniformSky { irradiance } => Self::UniformSky { irradiance },
            LightSource::OvercastSky { zenith, irradiance } => {
                Self::OvercastSky { zenith: zenith.into(), irradiance }
            }
            LightSource::Given => Self::Given,
        }
    }
}

impl SourceRecord {
    fn into_source(self) -> Result<LightSource> {
        match self {
            Self::Directional { towards, irradiance } => LightSource::directional(towards, irradiance),
            Self::Point { at, irradiance, distance } => LightSource::point(at, irradiance, distance),
            Self::UniformSky { irradiance } => LightSource::uniform_sky(irradiance),
            Self::OvercastSky { zenith, irradiance } => LightSource::overcast_sky(zenith, irradiance),
            Self::Given => Ok(LightSource::Given),
        }
    }
}

impl Scene {
    pub(super) fn set_light(&mut self, light: &Light) -> Result<()> {
        let (tilt_deg, slant_deg, sky) = (light.tilt_deg(), light.slant_deg(), light.sky());
        let record = LightRecord { tilt_deg, slant_deg, sky, panel_irradiance: light.panel_irradiance() };
        self.fields.set("light", record)
    }

    pub(super) fn set_sources(&mut self, sources: &[LightSource]) -> Result<()> {
        let sources = sources.iter().map(SourceRecord::from).collect();
        self.fields.set("light", SourcesRecord { sources })
    }

    /// The sun and the sky on a fold.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or leave a panel unlit, or if there is no fold.
    pub fn light(&self) -> Result<Light> {
        let fold = self.fold()?;
        let light: LightRecord = self.fields.require("light", "make the scene with vkernel")?;
        Light::new(&fold, light.tilt_deg, light.slant_deg, light.sky).map_err(|e| Error::field("light", e))
    }

    /// The sources around a surface that is no fold.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or impossible.
    pub fn sources(&self) -> Result<Vec<LightSource>> {
        let light: SourcesRecord = self.fields.require("light", "make the scene with vkernel")?;
        if light.sources.is_empty() {
            return Err(Error::field("light.sources", "none; make the scene with vkernel"));
        }
        light.sources.into_iter().map(SourceRecord::into_source).collect()
    }
}
