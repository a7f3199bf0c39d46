//! The scene's light: sun and sky on a fold, or sources around any surface.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::BY_VKERNEL;
use crate::error::{Error, Result};
use crate::geometry::{Fold, Light, LightSource, StandardSky};

/// Where light comes from.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
pub(super) enum LightRecord {
    /// The sun and a uniform sky on a fold.
    Sun(SunRecord),
    /// On any other surface, and of other kinds on a fold.
    Sources(SourcesRecord),
}

/// The sun and a uniform sky on a fold.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct SunRecord {
    /// Angle of the sun off the plane that halves the fold, degrees; above 0 it lights panel 0 more.
    tilt_deg: f64,
    /// Angle of the sun along the crease, degrees.
    slant_deg: f64,
    /// Irradiance by the sun of a plane that faces it: 1, or 0 if the sky is alone.
    #[serde(default = "one")]
    #[schemars(range(min = 0, max = 1))]
    sun: f64,
    /// Diffuse-to-direct ratio: irradiance by the sky of an open plane that faces the sun, relative to the
    /// sun's if there is one.
    #[schemars(range(min = 0))]
    sky: f64,
    /// Irradiance of each panel by the sun, a plane that faces it having 1. Follows from the angles and is
    /// not read.
    #[serde(skip_deserializing)]
    #[schemars(inner(range(min = 0, max = 1)))]
    panel_irradiance: [f64; 2],
}

fn one() -> f64 {
    1.0
}

/// Sources around a surface.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct SourcesRecord {
    /// The sources, at least one; illuminants are in their order, skies aside.
    #[schemars(length(min = 1))]
    sources: Vec<SourceRecord>,
}

/// A source of light.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
enum SourceRecord {
    /// Parallel light, such as the sun's.
    Directional {
        /// Direction towards it.
        towards: [f64; 3],
        /// Irradiance of a plane that faces it.
        #[schemars(range(min = 0))]
        irradiance: f64,
    },
    /// A lamp.
    Point {
        /// Where it is, in the unit of the vertices.
        at: [f64; 3],
        /// Irradiance of a plane that faces it at that distance.
        #[schemars(range(min = 0))]
        irradiance: f64,
        /// Distance at which it has that irradiance, in the unit of the vertices.
        #[schemars(range(min = 0))]
        distance: f64,
    },
    /// A lamp or a window of some size, alike bright all over and in all directions.
    Area {
        /// Corners of a rectangle, counter-clockwise seen from where it shines to, in the unit of the
        /// vertices.
        corners: [[f64; 3]; 4],
        /// Irradiance of a plane that faces its middle squarely at that distance.
        #[schemars(range(min = 0))]
        irradiance: f64,
        /// Distance at which it gives that irradiance, in the unit of the vertices.
        #[schemars(range(min = 0))]
        distance: f64,
    },
    /// Light from everywhere alike, from below as well.
    UniformSky {
        /// Irradiance of a plane that nothing hides.
        #[schemars(range(min = 0))]
        irradiance: f64,
    },
    /// The sky of a dull day, brightest in the zenith, dark below the horizon.
    OvercastSky {
        /// Direction towards the zenith.
        zenith: [f64; 3],
        /// Irradiance of a plane that faces the zenith and that nothing hides.
        #[schemars(range(min = 0))]
        irradiance: f64,
    },
    /// One of the CIE's standard skies, dark below the horizon.
    StandardSky {
        /// Its type.
        #[schemars(range(min = 1, max = 15))]
        number: usize,
        /// Direction towards the zenith.
        zenith: [f64; 3],
        /// Direction towards the sun, which may be hidden.
        sun: [f64; 3],
        /// Irradiance of a plane that faces the zenith and that nothing hides.
        #[schemars(range(min = 0))]
        irradiance: f64,
    },
    /// Light of which nothing is known but how much each facet gets.
    #[serde(alias = "given")]
    PerFacet,
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
            LightSource::Area { corners, irradiance, distance } => {
                Self::Area { corners: corners.map(Into::into), irradiance, distance }
            }
            LightSource::StandardSky { sky, zenith, sun, irradiance } => {
                Self::StandardSky { number: sky.number(), zenith: zenith.into(), sun: sun.into(), irradiance }
            }
            LightSource::UniformSky { irradiance } => Self::UniformSky { irradiance },
            LightSource::OvercastSky { zenith, irradiance } => {
                Self::OvercastSky { zenith: zenith.into(), irradiance }
            }
            LightSource::PerFacet => Self::PerFacet,
        }
    }
}

impl SourceRecord {
    fn into_source(self) -> Result<LightSource> {
        match self {
            Self::Directional { towards, irradiance } => LightSource::directional(towards, irradiance),
            Self::Point { at, irradiance, distance } => LightSource::point(at, irradiance, distance),
            Self::Area { corners, irradiance, distance } => {
                LightSource::rectangle(corners.map(Into::into), irradiance, distance)
            }
            Self::StandardSky { number, zenith, sun, irradiance } => {
                let sky = StandardSky::of_type(number).ok_or_else(|| {
                    Error::field(
                        "light.sources",
                        format!("{number} is not a type of standard sky; types are 1 to 15"),
                    )
                })?;
                LightSource::standard_sky(sky, zenith, sun, irradiance)
            }
            Self::UniformSky { irradiance } => LightSource::uniform_sky(irradiance),
            Self::OvercastSky { zenith, irradiance } => LightSource::overcast_sky(zenith, irradiance),
            Self::PerFacet => Ok(LightSource::PerFacet),
        }
    }
}

impl From<&Light> for SunRecord {
    fn from(light: &Light) -> Self {
        Self {
            tilt_deg: light.tilt_deg(),
            slant_deg: light.slant_deg(),
            sun: light.sun(),
            sky: light.sky(),
            panel_irradiance: light.panel_irradiance(),
        }
    }
}

impl From<&[LightSource]> for SourcesRecord {
    fn from(sources: &[LightSource]) -> Self {
        Self { sources: sources.iter().map(SourceRecord::from).collect() }
    }
}

impl Scene {
    /// The sun and the sky on a fold.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or leave a panel unlit, or if there is no fold.
    pub fn light(&self) -> Result<Light> {
        self.light_on(&self.fold()?)
    }

    /// The same for a known fold.
    ///
    /// # Errors
    /// [`Error::Field`] if sun or sky are missing or leave a panel unlit.
    pub fn light_on(&self, fold: &Fold) -> Result<Light> {
        let SunRecord { tilt_deg, slant_deg, sun, sky, .. } = self.fields.require("light", BY_VKERNEL)?;
        let sky = match (sun, sky) {
            (1.0, sky) => sky,
            (0.0, 1.0) => f64::INFINITY,
            _ => {
                let problem = format!("sun {sun} with sky {sky}: the sun must be 1, or 0 with a sky of 1");
                return Err(Error::field("light", format!("{problem}; {BY_VKERNEL}")));
            }
        };
        Light::new(fold, tilt_deg, slant_deg, sky).map_err(|e| Error::field("light", e))
    }

    /// Whether light is defined by sources, as on surfaces other than folds.
    #[must_use]
    pub fn has_sources(&self) -> bool {
        matches!(self.fields.get::<SourcesRecord>("light"), Ok(Some(_)))
    }

    /// The sources around a surface.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or impossible.
    pub fn sources(&self) -> Result<Vec<LightSource>> {
        let SourcesRecord { sources } = self.fields.require("light", BY_VKERNEL)?;
        if sources.is_empty() {
            return Err(Error::field("light.sources", format!("none; {BY_VKERNEL}")));
        }
        sources.into_iter().map(SourceRecord::into_source).collect()
    }
}
