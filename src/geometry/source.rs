//! Sources of light around any surface.

use nalgebra::Vector3;

use crate::error::{Error, Result};

/// Brightest and darkest source, relative to the sun or whatever stands in its place: sums of such numbers keep their digits.
const IRRADIANCES: std::ops::RangeInclusive<f64> = 1e-9..=1e9;

/// One source of light; irradiances are relative to each other, those of the first source commonly 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightSource {
    /// Parallel light, such as the sun's.
    Directional {
        /// Unit vector to the source.
        towards: Vector3<f64>,
        /// On a plane that faces it.
        irradiance: f64,
    },
    /// A lamp, small beside its distance, alike in all directions.
    Point {
        /// Where it is, in the unit of the surface.
        at: Vector3<f64>,
        /// On a plane that faces it at `distance`.
        irradiance: f64,
        /// Positive, in the unit of the surface.
        distance: f64,
    },
    /// Light from everywhere alike, from below as well.
    UniformSky {
        /// On a plane that nothing hides.
        irradiance: f64,
    },
    /// The sky of a dull day, brightest in the zenith, dark below the horizon.
    OvercastSky {
        /// Unit vector to the zenith.
        zenith: Vector3<f64>,
        /// On a horizontal plane that nothing hides.
        irradiance: f64,
    },
    /// A light of which nothing is known but what it gives to every facet.
    Given,
}

impl LightSource {
    /// Parallel light from the direction `towards`, of any length.
    ///
    /// # Errors
    /// [`Error::Field`] as for all sources: if a coordinate or an irradiance is no number, or out of range.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::LightSource;
    /// let LightSource::Directional { towards, .. } = LightSource::directional([3.0, 0.0, 4.0], 1.0)? else { panic!() };
    /// assert_eq!([towards.x, towards.y, towards.z], [0.6, 0.0, 0.8]);
    /// assert!(LightSource::directional([0.0, 0.0, 0.0], 1.0).is_err());
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn directional(towards: [f64; 3], irradiance: f64) -> Result<Self> {
        Ok(Self::Directional { towards: direction(towards)?, irradiance: possible(irradiance)? })
    }

    /// A lamp `at` a place that gives `irradiance` to a plane facing it at `distance`.
    ///
    /// # Errors
    /// As [`LightSource::directional`].
    pub fn point(at: [f64; 3], irradiance: f64, distance: f64) -> Result<Self> {
        if !(at.iter().all(|x| x.abs() < 1e30) && distance > 0.0 && distance < 1e30) {
            return Err(Error::field(
                "light",
                format!("{at:?}, at a distance of {distance}, is no place of a lamp"),
            ));
        }
        Ok(Self::Point { at: at.into(), irradiance: possible(irradiance)?, distance })
    }

    /// A sky alike in all directions.
    ///
    /// # Errors
    /// As [`LightSource::directional`].
    pub fn uniform_sky(irradiance: f64) -> Result<Self> {
        Ok(Self::UniformSky { irradiance: possible(irradiance)? })
    }

    /// The sky of a dull day: `L(γ) = (1 + 2 sin γ)/3` of the zenith's radiance at the elevation γ.
    ///
    /// # Source
    /// CIE S 011/E:2003, *Spatial Distribution of Daylight*, overcast sky; Moon and Spencer, 1942.
    ///
    /// # Errors
    /// As [`LightSource::directional`].
    pub fn overcast_sky(zenith: [f64; 3], irradiance: f64) -> Result<Self> {
        Ok(Self::OvercastSky { zenith: direction(zenith)?, irradiance: possible(irradiance)? })
    }

    /// Whether it surrounds the surface.
    #[must_use]
    pub fn is_sky(&self) -> bool {
        match self {
            Self::UniformSky { .. } | Self::OvercastSky { .. } => true,
            Self::Directional { .. } | Self::Point { .. } | Self::Given => false,
        }
    }

    /// Irradiance by which it is compared with others: on a plane facing it, of a sky on an open one.
    #[must_use]
    pub fn irradiance(&self) -> f64 {
        match self {
            Self::Directional { irradiance, .. }
            | Self::Point { irradiance, .. }
            | Self::UniformSky { irradiance }
            | Self::OvercastSky { irradiance, .. } => *irradiance,
            Self::Given => 1.0,
        }
    }
}

fn direction(vector: [f64; 3]) -> Result<Vector3<f64>> {
    let unit = Vector3::from(vector).try_normalize(f64::MIN_POSITIVE);
    let unit = unit.filter(|unit| unit.iter().all(|x| x.is_finite()));
    unit.ok_or_else(|| {
        Error::field("light", format!("{vector:?} is no direction; give X,Y,Z towards the light"))
    })
}

fn possible(irradiance: f64) -> Result<f64> {
    if IRRADIANCES.contains(&irradiance) {
        return Ok(irradiance);
    }
    Err(Error::field(
        "light",
        format!("an irradiance of {irradiance:?}; it is relative to the first light's, 1 for example"),
    ))
}
