//! `--light`, `--sky-type`, `--zenith`: sources of light around any surface.

use clap::{Args, ValueEnum};
use vfold::cli::{refuse, vector};
use vfold::geometry::{LightSource, Shape, Vec3};
use vfold::{Error, Result};

/// Where the sun stands if nothing is said.
const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// Sources of light around any surface.
#[derive(Args)]
#[command(next_help_heading = "Light on shapes")]
pub struct LightArgs {
    /// A light, repeated for several: direction X,Y,Z towards the sun, or point:X,Y,Z, a lamp there; a number after another colon is
    /// its irradiance on a plane facing it (of a lamp: in the middle of the shape), 1 if there is none. none: the sky alone
    /// [default: 0,0,1]
    #[arg(long, value_name = "X,Y,Z[:E]|point:X,Y,Z[:E]|none", value_parser = light, allow_hyphen_values = true)]
    light: Vec<LightArg>,
    /// Sky of --sky on a shape: alike in all directions, or that of a dull day (CIE), dark below the horizon
    #[arg(
        long,
        value_name = "uniform|overcast",
        default_value = "uniform",
        hide_possible_values = true,
        hide_default_value = true
    )]
    sky_type: SkyType,
    /// Direction X,Y,Z to the zenith of an overcast sky [default: 0,0,1]
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    zenith: Option<[f64; 3]>,
}

/// What `--light` takes.
#[derive(Clone, Copy)]
enum LightArg {
    None,
    Directional([f64; 3], f64),
    Point([f64; 3], f64),
}

/// What `--sky-type` takes.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SkyType {
    /// Alike in all directions.
    Uniform,
    /// That of a dull day.
    Overcast,
}

impl LightArgs {
    /// Refuses flags that a fold does not know.
    pub fn check_fold(&self) -> Result<()> {
        let given = [
            ("--light", !self.light.is_empty()),
            ("--sky-type", self.sky_type != SkyType::Uniform),
            ("--zenith", self.zenith.is_some()),
        ];
        refuse(given, "a fold has its light by --tilt-deg, --slant-deg and --sky", "leave it out")
    }

    /// The sources around `shape`, among them a sky of irradiance `sky` if that is above 0, alone and of 1 if it is infinite.
    pub fn sources(&self, shape: &Shape, sky: f64) -> Result<Vec<LightSource>> {
        if self.zenith.is_some() && self.sky_type == SkyType::Uniform {
            return Err(Error::usage("--zenith", "a uniform sky has none", "add --sky-type overcast"));
        }
        if sky.is_infinite() && !matches!(self.light.as_slice(), [] | [LightArg::None]) {
            return Err(Error::usage("--sky", "only, beside a --light", "leave one of them out"));
        }
        let lights = match self.light.as_slice() {
            [] if sky.is_infinite() => Vec::new(),
            [] => vec![LightArg::Directional(UP, 1.0)],
            given => given.to_vec(),
        };
        let mut sources = Vec::new();
        for light in lights {
            sources.extend(light.source(shape).map_err(|e| usage("--light", &e))?);
        }
        let sky = if sky.is_infinite() { 1.0 } else { sky };
        if sky != 0.0 {
            let sky = match self.sky_type {
                SkyType::Uniform => LightSource::uniform_sky(sky),
                SkyType::Overcast => LightSource::overcast_sky(self.zenith.unwrap_or(UP), sky),
            };
            sources.push(sky.map_err(|e| usage("--sky", &e))?);
        }
        if sources.is_empty() {
            return Err(Error::usage("--light", "none, and no sky", "add --sky 1"));
        }
        Ok(sources)
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
        }
    }
}

/// Mean of the facets' centres by area.
fn middle(shape: &Shape) -> Vec3 {
    let area: f64 = shape.facets().map(vfold::geometry::Polygon::area).sum();
    shape.facets().map(|facet| facet.area() * facet.centroid()).sum::<Vec3>() / area
}

fn usage(flag: &'static str, error: &Error) -> Error {
    Error::usage(flag, error.to_string(), "see --help")
}

fn light(text: &str) -> std::result::Result<LightArg, String> {
    if text == "none" {
        return Ok(LightArg::None);
    }
    let wrong = || "write X,Y,Z or point:X,Y,Z, with :IRRADIANCE or without, or none".to_owned();
    let (is_point, rest) = text.strip_prefix("point:").map_or((false, text), |rest| (true, rest));
    let (place, irradiance) = rest.split_once(':').unwrap_or((rest, "1"));
    let (place, irradiance) = (vector(place).map_err(|_| wrong())?, irradiance.parse().map_err(|_| wrong())?);
    Ok(if is_point { LightArg::Point(place, irradiance) } else { LightArg::Directional(place, irradiance) })
}
