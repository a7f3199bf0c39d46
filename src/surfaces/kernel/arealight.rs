//! Direct light of an extended lamp or window on patches, including shadows.

use rayon::prelude::*;

use super::casters::Casters;
use super::patches::Patch;
use super::shadow::{Eye, point_factor, visible};
use crate::geometry::Vec3;
use crate::kernel::quadrature::Rule;
use crate::surfaces::polygon::Polygon;
use crate::surfaces::shape::Shape;

/// Points along each side of a patch: for a whole panel with a window at half its size, unshadowed, the error
/// is 1e-5.
const POINTS: usize = 4;

/// Mean irradiance of every patch by a `lamp` that shines on the side of its normal and would give 1 to a
/// plane that sees nothing else: at points of the patch, by Lambert's formula for the part of the lamp that
/// is above the horizon and not hidden by facets.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold, Vec3};
/// use vfold::surfaces::{Polygon, Accordion};
/// use vfold::surfaces::kernel::arealight::arealight;
/// use vfold::surfaces::kernel::patches::{Division, patches};
/// let valley = Fold::new(180.0, 0.01, 0.01, FacetGrid { rows: 1, cols: 1 })?;
/// let flat = Accordion { valley, creases: 1, ridge_deg: 90.0, bow_deg: 0.0 }.shape()?;
/// let square = [[0.5, 0.5], [0.5, -0.5], [-0.5, -0.5], [-0.5, 0.5]];
/// let lamp = Polygon::new(&square.map(|[x, y]| Vec3::new(x, y, 1.0)));
/// let irradiance = arealight(&flat, &patches(&flat, Division::NONE), &lamp);
/// // four times the 0.0599 of a quarter over its corner (Howell, B-4)
/// assert!((irradiance[0] - 0.2395).abs() < 1e-4);
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn arealight(shape: &Shape, patches: &[Patch], lamp: &Polygon) -> Vec<f64> {
    let casters = Casters::new(shape.facets(), shape.size());
    let (front, rule) = (lamp.plane(), Rule::gauss_legendre(POINTS));
    let on = |patch: &Patch| {
        let polygon = &patch.polygon;
        let horizon = polygon.plane();
        let Some(lamp) = lamp.in_front_of(&horizon) else { return 0.0 };
        let before: Vec<Polygon> =
            casters.in_front_of(&horizon).iter().filter_map(|caster| caster.in_front_of(&front)).collect();
        let seen = |point: &Vec3| -> f64 {
            if front.height(point) <= casters.margin() {
                return 0.0;
            }
            let pieces = visible(&lamp, &before, Eye::Point(*point));
            pieces.iter().map(|piece| point_factor(point, &horizon.normal, piece.corners())).sum()
        };
        let points = rule
            .on(0.0, 1.0)
            .flat_map(|(u, of_u)| rule.on(0.0, 1.0).map(move |(v, of_v)| (u, v, of_u * of_v)));
        let light = points.map(|(u, v, weight)| {
            let (point, element) = polygon.at(u, v);
            weight * element * seen(&point)
        });
        light.sum::<f64>() / polygon.area()
    };
    patches.par_iter().map(on).collect()
}
