//! Direct light on patches, including shadows.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::casters::Casters;
use super::patches::Patch;
use super::shadow::{Eye, visible};
use crate::geometry::Vec3;
use crate::surfaces::polygon::{Polygon, edges};
use crate::surfaces::shape::Shape;

/// Mean irradiance of every patch in parallel light that gives 1 on a plane facing it: the cosine of its
/// incidence times the unshaded fraction of the patch, exact.
///
/// # Arguments
/// - `towards`: direction towards the light, of any length.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold, Vec3};
/// use vfold::surfaces::Accordion;
/// use vfold::surfaces::kernel::patches::{Division, patches};
/// use vfold::surfaces::kernel::sunlight::sunlight;
/// let valley = Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?;
/// let v = Accordion { valley, creases: 1, ridge_deg: 90.0, bow_deg: 0.0 }.shape()?;
/// let irradiance = sunlight(&v, &patches(&v, Division::NONE), &Vec3::z());
/// assert!((irradiance[0] - 0.5_f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn sunlight(shape: &Shape, patches: &[Patch], towards: &Vec3) -> Vec<f64> {
    let towards = towards.normalize();
    let lit = |patch: &Polygon, lit: &[Polygon]| {
        lit.iter().map(Polygon::area).sum::<f64>() / patch.area() * patch.normal().dot(&towards)
    };
    light(shape, patches, Eye::Direction(towards), lit)
}

/// Mean irradiance of every patch in the light of a point source that gives 1 on a plane facing it at
/// distance 1: the solid angle of the lit part of the patch, divided by the patch's area, exact.
#[must_use]
pub fn lamplight(shape: &Shape, patches: &[Patch], lamp: &Vec3) -> Vec<f64> {
    let lit = |patch: &Polygon, lit: &[Polygon]| {
        lit.iter().map(|piece| solid_angle(lamp, piece.corners())).sum::<f64>() / patch.area()
    };
    light(shape, patches, Eye::Point(*lamp), lit)
}

/// `irradiance` is computed from each patch that faces the light, and its lit pieces.
fn light(
    shape: &Shape,
    patches: &[Patch],
    eye: Eye,
    irradiance: impl Fn(&Polygon, &[Polygon]) -> f64 + Sync,
) -> Vec<f64> {
    let size = shape.size();
    let casters = Casters::new(shape.facets(), size);
    let on = |patch: &Patch| {
        let plane = patch.polygon.plane();
        let height = match eye {
            Eye::Direction(towards) => plane.normal.dot(&towards) * size,
            Eye::Point(lamp) => plane.height(&lamp),
        };
        if height <= casters.margin() {
            return 0.0;
        }
        let before = match eye {
            Eye::Direction(_) => casters.in_front_of(&plane),
            // parts further from the plane than the lamp would shade what is behind the lamp
            Eye::Point(lamp) => {
                let low = |part: Polygon| part.in_front_of(&plane.raised(height).reversed());
                casters
                    .in_front_of(&plane)
                    .into_iter()
                    .filter_map(low)
                    .filter(|part| part.plane().height(&lamp).abs() > 0.0)
                    .collect()
            }
        };
        irradiance(&patch.polygon, &visible(&patch.polygon, &before, eye))
    };
    patches.par_iter().map(on).collect()
}

/// Solid angle of a polygon seen from a point, up to 2π (Van Oosterom and Strackee 1983, triangle by
/// triangle).
#[must_use]
pub fn solid_angle(point: &Vec3, corners: &[Vec3]) -> f64 {
    let rays: Vec<Vec3> = corners.iter().map(|corner| corner - point).collect();
    let triangle = |(b, c): (Vec3, Vec3)| {
        let (a, lengths) = (rays[0], [rays[0].norm(), b.norm(), c.norm()]);
        let along = lengths.iter().product::<f64>()
            + a.dot(&b) * lengths[2]
            + a.dot(&c) * lengths[1]
            + b.dot(&c) * lengths[0];
        2.0 * a.dot(&b.cross(&c)).atan2(along)
    };
    edges(&rays).skip(1).take(rays.len().saturating_sub(2)).map(triangle).sum::<f64>().abs().min(2.0 * PI)
}
