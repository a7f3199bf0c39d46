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
    /// Any sources around any surface.
    Sources(SourcesRecord),
}

/// The sun and a uniform sky on a fold.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct SunRecord {
    /// Angle of the sun off the bisecting plane of the fold, degrees; above 0 it lights panel 0 more.
    tilt_deg: f64,
    /// Angle of the sun along the crease, degrees.
    slant_deg: f64,
    /// Irradiance that the sun gives a plane that faces it: 1, or 0 if the sky is the only light.
    #[serde(default = "one")]
    #[schemars(range(min = 0, max = 1))]
    sun: f64,
    /// Diffuse-to-direct ratio: irradiance that the sky gives an unobstructed plane facing the sun, relative
    /// to that which the sun gives it, if there is a sun.
    #[schemars(range(min = 0))]
    sky: f64,
    /// Irradiance that the sun gives each panel, relative to a plane that faces it. It follows from the
    /// angles, and is written but not read.
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
    /// The sources, at least one. The illuminants are in the same order, skies left out.
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
    /// A small lamp, taken to be a point.
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
    /// A large lamp or a window: a rectangle that is equally bright all over and in all directions.
    Area {
        /// Corners of the rectangle, counter-clockwise as seen from the side that it lights, in the unit of
        /// the vertices.
        corners: [[f64; 3]; 4],
        /// Irradiance of a plane straight in front of its middle and parallel to it, at that distance.
        #[schemars(range(min = 0))]
        irradiance: f64,
        /// Distance at which it gives that irradiance, in the unit of the vertices.
        #[schemars(range(min = 0))]
        distance: f64,
    },
    /// Light that is equal from all directions, also from below.
    UniformSky {
        /// Irradiance of an unobstructed plane.
        #[schemars(range(min = 0))]
        irradiance: f64,
    },
    /// An overcast sky, brightest at the zenith and dark below the horizon.
    OvercastSky {
        /// Direction towards the zenith.
        zenith: [f64; 3],
        /// Irradiance of an unobstructed plane that faces the zenith.
        #[schemars(range(min = 0))]
        irradiance: f64,
    },
    /// A CIE standard sky, dark below the horizon.
    StandardSky {
        /// Its type, 1 to 15.
        #[schemars(range(min = 1, max = 15))]
        number: usize,
        /// Direction towards the zenith.
        zenith: [f64; 3],
        /// Direction towards the sun, which may be hidden.
        sun: [f64; 3],
        /// Irradiance of an unobstructed plane that faces the zenith.
        #[schemars(range(min = 0))]
        irradiance: f64,
    },
    /// Light of which only the irradiance of each facet is known.
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
