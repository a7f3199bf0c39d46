//! Light sources around any surface.

use nalgebra::Vector3;

use super::StandardSky;
use crate::error::{Error, Result};

/// Allowed irradiances, relative to the sun or whatever replaces it: sums of such numbers stay accurate.
const IRRADIANCES: std::ops::RangeInclusive<f64> = 1e-9..=1e9;

/// Upper bound on the distance of a lamp: its square does not overflow.
const FURTHEST: f64 = 1e30;
/// A lamp facing this nearly along the y axis (cosine) has its width along x instead.
const ALONG: f64 = 0.999;
/// Allowed error of a rectangle's corners relative to its sides: rounding in files.
const SKEW: f64 = 1e-6;

/// A light source. Irradiances are relative to each other; that of the first source is usually 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightSource {
    /// Parallel light, such as the sun's.
    Directional {
        /// Unit vector towards the source.
        towards: Vector3<f64>,
        /// Irradiance on a plane facing the source.
        irradiance: f64,
    },
    /// A lamp that is small compared with its distance and radiates equally in all directions.
    Point {
        /// Position, in the unit of the surface.
        at: Vector3<f64>,
        /// Irradiance on a plane facing the lamp at `distance`.
        irradiance: f64,
        /// Positive, in the unit of the surface.
        distance: f64,
    },
    /// A lamp or window of finite size: flat, of uniform radiance over its area and in all directions, on the
    /// side that it faces.
    Area {
        /// Corners of a rectangle, counter-clockwise as seen from the lit side, in the unit of the surface.
        corners: [Vector3<f64>; 4],
        /// Irradiance on a plane that faces its middle squarely at `distance`.
        irradiance: f64,
        /// Positive, in the unit of the surface.
        distance: f64,
    },
    /// Uniform light from all directions, including from below.
    UniformSky {
        /// Irradiance on an unobstructed plane.
        irradiance: f64,
    },
    /// A CIE overcast sky, brightest at the zenith, dark below the horizon.
    OvercastSky {
        /// Unit vector towards the zenith.
        zenith: Vector3<f64>,
        /// Irradiance on an unobstructed horizontal plane.
        irradiance: f64,
    },
    /// A CIE standard sky, dark below the horizon.
    StandardSky {
        /// Its type.
        sky: StandardSky,
        /// Unit vector towards the zenith.
        zenith: Vector3<f64>,
        /// Unit vector towards the sun, which may be hidden.
        sun: Vector3<f64>,
        /// Irradiance on an unobstructed horizontal plane.
        irradiance: f64,
    },
    /// A light known only by the irradiance of every facet.
    PerFacet,
}

impl LightSource {
    /// Parallel light from the direction `towards`, of any length.
    ///
    /// # Errors
    /// [`Error::Field`], as for all sources, if a coordinate or an irradiance is not a number or out of
    /// range.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::LightSource;
    /// let LightSource::Directional { towards, .. } = LightSource::directional([3.0, 0.0, 4.0], 1.0)? else {
    ///     panic!()
    /// };
    /// assert_eq!([towards.x, towards.y, towards.z], [0.6, 0.0, 0.8]);
    /// assert!(LightSource::directional([0.0, 0.0, 0.0], 1.0).is_err());
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn directional(towards: [f64; 3], irradiance: f64) -> Result<Self> {
        Ok(Self::Directional { towards: direction(towards)?, irradiance: possible(irradiance)? })
    }

    /// A lamp `at` a position, giving `irradiance` to a plane that faces it at `distance`.
    ///
    /// # Errors
    /// As [`LightSource::directional`].
    pub fn point(at: [f64; 3], irradiance: f64, distance: f64) -> Result<Self> {
        check_place(at, distance)?;
        Ok(Self::Point { at: at.into(), irradiance: possible(irradiance)?, distance })
    }

    /// A rectangle centred `at` a position and facing `towards` another. `size` is its length along the y
    /// axis (or as nearly as possible) and across it; it gives `irradiance` to a plane there that faces it.
    ///
    /// # Errors
    /// As [`LightSource::directional`].
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{LightSource, Vec3};
    /// let LightSource::Area { corners, distance, .. } =
    ///     LightSource::area([0.0, 0.0, 3.0], Vec3::zeros(), [2.0, 1.0], 1.0)?
    /// else {
    ///     panic!()
    /// };
    /// assert_eq!((corners[0] - corners[1]).norm(), 2.0);
    /// assert_eq!(distance, 3.0);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn area(at: [f64; 3], towards: Vector3<f64>, size: [f64; 2], irradiance: f64) -> Result<Self> {
        let middle = Vector3::from(at);
        let distance = (towards - middle).norm();
        check_place(at, distance)?;
        let facing = (towards - middle) / distance;
        let axis = if facing.y.abs() < ALONG { Vector3::y() } else { Vector3::x() };
        let along = (axis - axis.dot(&facing) * facing).normalize();
        let [along, across] = [along * (0.5 * size[0]), facing.cross(&along) * (0.5 * size[1])];
        let corners = [
            middle + along + across,
            middle - along + across,
            middle - along - across,
            middle + along - across,
        ];
        Self::rectangle(corners, irradiance, distance)
    }

    /// A rectangle given by its corners.
    ///
    /// # Errors
    /// As [`LightSource::directional`].
    pub fn rectangle(corners: [Vector3<f64>; 4], irradiance: f64, distance: f64) -> Result<Self> {
        let middle = corners.iter().sum::<Vector3<f64>>() / 4.0;
        check_place(middle.into(), distance)?;
        let [along, across] = [corners[1] - corners[0], corners[3] - corners[0]];
        let is_rectangle = (corners[0] + corners[2] - corners[1] - corners[3]).norm() < SKEW * along.norm()
            && along.dot(&across).abs() < SKEW * along.norm() * across.norm()
            && along.cross(&across).norm() > 0.0;
        if !is_rectangle {
            return Err(Error::field("light", "the corners of a lamp or window do not form a rectangle"));
        }
        Ok(Self::Area { corners, irradiance: possible(irradiance)?, distance })
    }

    /// A sky of equal radiance in all directions.
    ///
    /// # Errors
    /// As [`LightSource::directional`].
    pub fn uniform_sky(irradiance: f64) -> Result<Self> {
        Ok(Self::UniformSky { irradiance: possible(irradiance)? })
    }

    /// A CIE overcast sky: at elevation γ its radiance is `L(γ) = (1 + 2 sin γ)/3` of the zenith's.
    ///
    /// # Source
    /// CIE S 011/E:2003, *Spatial Distribution of Daylight*, overcast sky; Moon and Spencer, 1942.
    ///
    /// # Errors
    /// As [`LightSource::directional`].
    pub fn overcast_sky(zenith: [f64; 3], irradiance: f64) -> Result<Self> {
        Ok(Self::OvercastSky { zenith: direction(zenith)?, irradiance: possible(irradiance)? })
    }

    /// A CIE standard sky with the sun in the direction `sun`.
    ///
    /// # Errors
    /// As [`LightSource::directional`], and if the sun is not above the horizon.
    pub fn standard_sky(sky: StandardSky, zenith: [f64; 3], sun: [f64; 3], irradiance: f64) -> Result<Self> {
        let (zenith, sun) = (direction(zenith)?, direction(sun)?);
        if zenith.dot(&sun) <= 0.0 {
            return Err(Error::field(
                "light",
                "the sun of this sky stands below its horizon; give another zenith or sun",
            ));
        }
        Ok(Self::StandardSky { sky, zenith, sun, irradiance: possible(irradiance)? })
    }

    /// True for a source that surrounds the surface.
    #[must_use]
    pub fn is_sky(&self) -> bool {
        match self {
            Self::UniformSky { .. } | Self::OvercastSky { .. } | Self::StandardSky { .. } => true,
            Self::Directional { .. } | Self::Point { .. } | Self::Area { .. } | Self::PerFacet => false,
        }
    }

    /// Irradiance by which sources are compared: on a plane facing the source, or unobstructed under a sky.
    #[must_use]
    pub fn irradiance(&self) -> f64 {
        match self {
            Self::Directional { irradiance, .. }
            | Self::Point { irradiance, .. }
            | Self::Area { irradiance, .. }
            | Self::StandardSky { irradiance, .. }
            | Self::UniformSky { irradiance }
            | Self::OvercastSky { irradiance, .. } => *irradiance,
            Self::PerFacet => 1.0,
        }
    }
}

fn check_place(at: [f64; 3], distance: f64) -> Result<()> {
    if at.iter().all(|x| x.abs() < FURTHEST) && distance > 0.0 && distance < FURTHEST {
        return Ok(());
    }
    Err(Error::field("light", format!("a lamp cannot be at {at:?}, at a distance of {distance}")))
}

fn direction(vector: [f64; 3]) -> Result<Vector3<f64>> {
    let unit = Vector3::from(vector).try_normalize(f64::MIN_POSITIVE);
    let unit = unit.filter(|unit| unit.iter().all(|x| x.is_finite()));
    unit.ok_or_else(|| {
        Error::field("light", format!("{vector:?} is not a direction; give X,Y,Z towards the light"))
    })
}

fn possible(irradiance: f64) -> Result<f64> {
    if IRRADIANCES.contains(&irradiance) {
        return Ok(irradiance);
    }
    Err(Error::field(
        "light",
        format!("the irradiance {irradiance:?} is out of range; it is relative, such as 1"),
    ))
}
