//! `--light`, `--sky-type`, `--zenith`: light sources around any surface.

use clap::Args;
use vfold::cli::{pair, vector};
use vfold::geometry::{LightSource, StandardSky, Vec3};
use vfold::surfaces::Shape;
use vfold::{Error, Result};

/// Default direction of sun and zenith.
pub const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// Sources of light around any surface, a fold among them.
#[derive(Args)]
#[command(next_help_heading = "Light from anywhere")]
pub struct LightArgs {
    /// A light; repeat for several. X,Y,Z: the direction towards the sun; point:X,Y,Z: a small lamp there;
    /// area:X,Y,Z,WIDTHxHEIGHT: a window or large lamp centred there, facing the middle of the sheet, its
    /// width along the y axis. :E sets the irradiance on a plane facing the light (for a lamp: at the middle
    /// of the sheet), by default 1. none: the sky alone. In a fold the middle of the crease is at 0,0,0, y
    /// runs along the crease, z out of the opening, and panel 1 is at positive x; the unit is that of --panel
    /// [default: 0,0,1; for a fold as --tilt-deg and --slant-deg state]
    #[arg(
        long,
        value_name = "X,Y,Z[:E]|point:X,Y,Z[:E]|area:X,Y,Z,WxH[:E]|none",
        value_parser = light,
        allow_hyphen_values = true
    )]
    light: Vec<LightArg>,
    /// Type of the sky of --sky: uniform, the same in all directions; or, dark below the horizon, overcast
    /// (Moon and Spencer), clear, or a CIE standard sky by its number, 1 to 15 (12 is clear), brightest
    /// around the first sun of --light, else 0,0,1 [default: uniform]
    #[arg(
        long,
        value_name = "uniform|overcast|clear|1..15",
        default_value = "uniform",
        hide_default_value = true,
        value_parser = sky_type
    )]
    sky_type: SkyType,
    /// Direction X,Y,Z to the zenith of a sky that is not uniform [default: 0,0,1]
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    zenith: Option<[f64; 3]>,
}

/// The value of `--light`.
#[derive(Clone, Copy)]
enum LightArg {
    None,
    Directional([f64; 3], f64),
    Point([f64; 3], f64),
    Area([f64; 3], [f64; 2], f64),
}

/// The value of `--sky-type`.
#[derive(Clone, Copy, PartialEq, Eq)]
enum SkyType {
    /// Equal in all directions.
    Uniform,
    /// An overcast sky.
    Overcast,
    /// A CIE standard sky.
    Standard(StandardSky),
}

impl LightArgs {
    /// Whether there are sources other than a sun and a uniform sky.
    pub fn is_present(&self) -> bool {
        !self.light.is_empty() || self.sky_type != SkyType::Uniform || self.zenith.is_some()
    }

    /// Whether the lights are stated individually, so that no other flag defines the sun.
    pub fn states_lights(&self) -> bool {
        !self.light.is_empty()
    }

    /// The sources around `shape`, including a sky of irradiance `sky` if that is above 0, or a sky alone of
    /// irradiance 1 if it is infinite; the sun is in direction `sun` if no light is stated.
    pub fn sources(&self, shape: &Shape, sky: f64, sun: [f64; 3]) -> Result<Vec<LightSource>> {
        if self.zenith.is_some() && self.sky_type == SkyType::Uniform {
            return Err(Error::usage("--zenith", "a uniform sky has no zenith", "add --sky-type overcast"));
        }
        if self.sky_type != SkyType::Uniform && sky == 0.0 {
            return Err(Error::usage(
                "--sky-type",
                "there is no sky",
                "add --sky only, or --sky with a number",
            ));
        }
        if sky.is_infinite() && !matches!(self.light.as_slice(), [] | [LightArg::None]) {
            return Err(Error::usage("--sky", "'only' excludes --light", "leave one of them out"));
        }
        let lights = match self.light.as_slice() {
            [] if sky.is_infinite() => Vec::new(),
            [] => vec![LightArg::Directional(sun, 1.0)],
            flags => flags.to_vec(),
        };
        let mut sources = Vec::new();
        for light in &lights {
            sources.extend(light.source(shape).map_err(|e| usage("--light", &e))?);
        }
        let sky = if sky.is_infinite() { 1.0 } else { sky };
        if sky != 0.0 {
            let sun = lights.iter().find_map(LightArg::sun).unwrap_or(sun);
            sources.push(self.sky(sky, sun)?);
        }
        if sources.is_empty() {
            return Err(Error::usage("--light", "'none' without a sky leaves no light", "add --sky 1"));
        }
        Ok(sources)
    }

    /// A sky of this irradiance, with the sun in this direction.
    fn sky(&self, irradiance: f64, sun: [f64; 3]) -> Result<LightSource> {
        let zenith = self.zenith.unwrap_or(UP);
        match self.sky_type {
            SkyType::Uniform => LightSource::uniform_sky(irradiance).map_err(|e| usage("--sky", &e)),
            SkyType::Overcast => {
                LightSource::overcast_sky(zenith, irradiance).map_err(|e| usage("--sky", &e))
            }
            SkyType::Standard(sky) => {
                LightSource::standard_sky(sky, zenith, sun, irradiance).map_err(|e| usage("--sky-type", &e))
            }
        }
    }
}

impl LightArg {
    fn source(self, shape: &Shape) -> Result<Option<LightSource>> {
        match self {
            Self::None => Ok(None),
            Self::Directional(towards, irradiance) => LightSource::directional(towards, irradiance).map(Some),
            Self::Point(at, irradiance) => {
                let distance = (middle(shape) - Vec3::from(at)).norm();
                LightSource::point(at, irradiance, distance).map(Some)
            }
            Self::Area(at, size, irradiance) => {
                LightSource::area(at, middle(shape), size, irradiance).map(Some)
            }
        }
    }

    /// Direction of a sun.
    fn sun(&self) -> Option<[f64; 3]> {
        match self {
            Self::Directional(towards, _) => Some(*towards),
            Self::None | Self::Point(..) | Self::Area(..) => None,
        }
    }
}

/// Area-weighted mean of the facets' centres.
fn middle(shape: &Shape) -> Vec3 {
    let area: f64 = shape.facets().map(vfold::surfaces::Polygon::area).sum();
    shape.facets().map(|facet| facet.area() * facet.centroid()).sum::<Vec3>() / area
}

fn usage(flag: &'static str, error: &Error) -> Error {
    Error::usage(flag, error.to_string(), "see --help")
}

fn light(text: &str) -> std::result::Result<LightArg, String> {
    if text == "none" {
        return Ok(LightArg::None);
    }
    let wrong = || {
        "write X,Y,Z, point:X,Y,Z or area:X,Y,Z,WIDTHxHEIGHT, optionally with :IRRADIANCE, or none".to_owned()
    };
    let (kind, rest) = match text.split_once(':') {
        Some((kind @ ("point" | "area"), rest)) => (kind, rest),
        _ => ("sun", text),
    };
    let (place, irradiance) = rest.split_once(':').unwrap_or((rest, "1"));
    let irradiance = irradiance.parse().map_err(|_| wrong())?;
    let at = |place| vector(place).map_err(|_| wrong());
    Ok(match kind {
        "point" => LightArg::Point(at(place)?, irradiance),
        "area" => {
            let (place, size) = place.rsplit_once(',').ok_or_else(wrong)?;
            let (width, height) = pair::<f64>(size).map_err(|_| wrong())?;
            LightArg::Area(at(place)?, [width, height], irradiance)
        }
        _ => LightArg::Directional(at(place)?, irradiance),
    })
}

fn sky_type(text: &str) -> std::result::Result<SkyType, String> {
    match text {
        "uniform" => Ok(SkyType::Uniform),
        "overcast" => Ok(SkyType::Overcast),
        "clear" => Ok(SkyType::Standard(StandardSky::CLEAR)),
        _ => text.parse().ok().and_then(StandardSky::of_type).map(SkyType::Standard).ok_or_else(|| {
            "write uniform, overcast, clear, or the number of a CIE standard sky, 1 to 15".to_owned()
        }),
    }
}
