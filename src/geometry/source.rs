//! Sources of light around any surface.

use nalgebra::Vector3;

use super::StandardSky;
use crate::error::{Error, Result};

/// Brightest and darkest source, relative to the sun or whatever stands in its place: sums of such numbers
/// keep their digits.
const IRRADIANCES: std::ops::RangeInclusive<f64> = 1e-9..=1e9;

/// Lamps are nearer than this: squares of such distances are numbers.
const FURTHEST: f64 = 1e30;
/// A lamp that faces this much along the y axis, as a cosine, does not have its width there.
const ALONG: f64 = 0.999;
/// How far off corners of a rectangle may be, relative to its sides: rounding in a file.
const SKEW: f64 = 1e-6;

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
    /// A lamp or a window of some size: flat, alike bright all over and in all directions, on the side to
    /// which it faces.
    Area {
        /// Corners of a rectangle, counter-clockwise seen from where it shines to, in the unit of the
        /// surface.
        corners: [Vector3<f64>; 4],
        /// On a plane that faces its middle squarely at `distance` before it.
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
    /// One of the CIE's standard skies, dark below the horizon.
    StandardSky {
        /// Which.
        sky: StandardSky,
        /// Unit vector to the zenith.
        zenith: Vector3<f64>,
        /// Unit vector to the sun, which may be hidden.
        sun: Vector3<f64>,
        /// On a horizontal plane that nothing hides.
        irradiance: f64,
    },
    /// A light of which nothing is known but what it gives to every facet.
    PerFacet,
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

    /// A lamp `at` a place that gives `irradiance` to a plane facing it at `distance`.
    ///
    /// # Errors
    /// As [`LightSource::directional`].
    pub fn point(at: [f64; 3], irradiance: f64, distance: f64) -> Result<Self> {
        check_place(at, distance)?;
        Ok(Self::Point { at: at.into(), irradiance: possible(irradiance)?, distance })
    }

    /// A rectangle with its middle `at` a place, turned `towards` another, `size` along the y axis, or as
    /// nearly as it can be, and across it; it gives `irradiance` to a plane there that faces it.
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

    /// The same by its corners.
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
            return Err(Error::field(
                "light",
                "the corners of a lamp or a window are not those of a rectangle",
            ));
        }
        Ok(Self::Area { corners, irradiance: possible(irradiance)?, distance })
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

    /// One of the CIE's standard skies, the sun being where `sun` points.
    ///
    /// # Errors
    /// As [`LightSource::directional`]; a sun that is not above the horizon.
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

    /// Whether it surrounds the surface.
    #[must_use]
    pub fn is_sky(&self) -> bool {
        match self {
            Self::UniformSky { .. } | Self::OvercastSky { .. } | Self::StandardSky { .. } => true,
            Self::Directional { .. } | Self::Point { .. } | Self::Area { .. } | Self::PerFacet => false,
        }
    }

    /// Irradiance by which it is compared with others: on a plane facing it, of a sky on an open one.
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
    Err(Error::field("light", format!("{at:?}, at a distance of {distance}, is no place of a lamp")))
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
