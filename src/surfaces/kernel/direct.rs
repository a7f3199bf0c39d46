//! Direct light of any source on patches, including shadows.

use std::f64::consts::PI;

use super::arealight::arealight;
use super::patches::Patch;
use super::shadow::point_factor;
use super::skylight::{backs, skylight};
use super::sunlight::{lamplight, sunlight};
use super::{SurfaceKernel, wedges};
use crate::geometry::{LightSource, Vec3};
use crate::surfaces::Polygon;
use crate::surfaces::shape::Shape;

/// Mean irradiance of every patch, and its largest standard error, zero if exact.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectLight {
    /// One number per patch.
    pub irradiance: Vec<f64>,
    /// For the least certain patch.
    pub standard_error: f64,
}

impl DirectLight {
    /// Irradiance of `patches` of `shape` by `source`, with their exchange in `kernel`. A uniform sky
    /// contributes what the patches do not hide from each other, minus the visible backs, which are sampled;
    /// other skies are sampled where more than a few flat parts hide them. A light of which only the
    /// irradiance is known contributes nothing.
    ///
    /// # Source
    /// CIE S 011/E:2003: the overcast sky's irradiance of a horizontal plane is 7/9 of π times the radiance
    /// of its zenith.
    #[must_use]
    pub fn of(source: &LightSource, shape: &Shape, patches: &[Patch], kernel: &SurfaceKernel) -> Self {
        match source {
            LightSource::UniformSky { .. } => {
                let (backs, error) = backs(shape, patches);
                let open = |(sum, backs): (f64, f64)| (1.0 - sum - backs).max(0.0);
                Self::sampled(source, (kernel.row_sums().into_iter().zip(backs).map(open).collect(), error))
            }
            LightSource::OvercastSky { zenith, .. } => {
                Self::of_sky(source, shape, patches, zenith, |towards| overcast(zenith.dot(towards)))
            }
            LightSource::StandardSky { sky, zenith, sun, .. } => {
                let unit = PI / sky.irradiance(zenith.dot(sun));
                Self::of_sky(source, shape, patches, zenith, |towards| match zenith.dot(towards) {
                    height if height > 0.0 => unit * sky.radiance(height, sun.dot(towards)),
                    _ => 0.0,
                })
            }
            LightSource::Directional { .. }
            | LightSource::Point { .. }
            | LightSource::Area { .. }
            | LightSource::PerFacet => {
                Self { irradiance: Self::of_lamp(source, shape, patches), standard_error: 0.0 }
            }
        }
    }

    /// Irradiance of `patches` by the sun or a lamp, exact except for extended lamps, whose accuracy depends
    /// on the size of the patches; zero if `source` is neither.
    #[must_use]
    pub fn of_lamp(source: &LightSource, shape: &Shape, patches: &[Patch]) -> Vec<f64> {
        let (unit, amount) = match source {
            LightSource::Directional { towards, irradiance } => {
                (sunlight(shape, patches, towards), *irradiance)
            }
            LightSource::Point { at, distance, irradiance } => {
                (lamplight(shape, patches, at), irradiance * distance * distance)
            }
            LightSource::Area { corners, distance, irradiance } => {
                let (lamp, reach) = (Polygon::new(corners), *distance);
                let facing = lamp.plane().normal;
                let before = lamp.centroid() + reach * facing;
                (arealight(shape, patches, &lamp), irradiance / point_factor(&before, &-facing, corners))
            }
            LightSource::UniformSky { .. }
            | LightSource::OvercastSky { .. }
            | LightSource::StandardSky { .. }
            | LightSource::PerFacet => (vec![0.0; patches.len()], 0.0),
        };
        unit.into_iter().map(|light| amount * light).collect()
    }

    /// For a sky with a horizon: by quadrature, or else by rays.
    fn of_sky(
        source: &LightSource,
        shape: &Shape,
        patches: &[Patch],
        zenith: &Vec3,
        radiance: impl Fn(&Vec3) -> f64 + Sync,
    ) -> Self {
        let exact = wedges::skylight(shape, patches, zenith, &radiance).map(|light| (light, 0.0));
        Self::sampled(source, exact.unwrap_or_else(|| skylight(shape, patches, &radiance)))
    }

    fn sampled(source: &LightSource, (unit, error): (Vec<f64>, f64)) -> Self {
        let amount = source.irradiance();
        Self {
            irradiance: unit.into_iter().map(|light| amount * light).collect(),
            standard_error: amount * error,
        }
    }
}

/// Radiance times π of an overcast sky with unit irradiance on a horizontal plane, by the sine of the
/// elevation.
fn overcast(sin_elevation: f64) -> f64 {
    if sin_elevation > 0.0 { 9.0 / 7.0 * (1.0 + 2.0 * sin_elevation) / 3.0 } else { 0.0 }
}
