//! Light of a sky with a horizon on patches from which only a few facets hide it, by quadrature.
//!
//! Half-planes through an axis in the patch's plane divide the sky into semicircles, on each of which the
//! horizon and every facet hide an arc. The quadrature rules restart wherever a corner of a facet comes into
//! view, so that their integrands are smooth.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector3;
use rayon::prelude::*;

use super::casters::Casters;
use super::patches::Patch;
use crate::geometry::Vec3;
use crate::kernel::quadrature::Rule;
use crate::surfaces::polygon::{Polygon, edges};
use crate::surfaces::shape::Shape;

/// Most flat parts of a surface between which the sky is seen: with more, rays are faster.
const FEW: usize = 8;
/// Points along each side of a patch, on a semicircle between obstructions, and of semicircles between
/// corners.
const POINTS: usize = 2;
const ON_ARC: usize = 16;
const ARCS: usize = 12;
/// A zenith with a smaller component than this along the axis has its horizon along it.
const ALONG: f64 = 1e-9;

/// Mean irradiance of every patch under a sky with this `radiance` times π by direction, dark below the
/// horizon of `zenith`, past all facets; none if there are too many.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold, Vec3};
/// use vfold::surfaces::kernel::patches::{Division, patches};
/// use vfold::surfaces::kernel::wedges::skylight;
/// let fold = Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?.shape()?;
/// // of a sky that is even above the horizon, a panel at 45° has 1/2 + cos 45°/2 where nothing hides it;
/// // of the other panel, to which its form factor is 0.2000 (Howell, C-14), half is as much above the
/// // horizon as the rest is below
/// let light = skylight(&fold, &patches(&fold, Division::NONE), &Vec3::z(), |_| 1.0);
/// assert!((light.unwrap()[0] - (0.853_553 - 0.100_022)).abs() < 3e-3); // at two by two points of each panel
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn skylight(
    shape: &Shape,
    patches: &[Patch],
    zenith: &Vec3,
    radiance: impl Fn(&Vec3) -> f64 + Sync,
) -> Option<Vec<f64>> {
    let casters = Casters::new(shape.facets(), shape.size());
    if casters.numbers().len() > FEW {
        return None;
    }
    let rules = [POINTS, ARCS, ON_ARC].map(Rule::gauss_legendre);
    let on = |Patch { polygon, .. }: &Patch| {
        let before = casters.in_front_of(&polygon.plane());
        let points = || rules[0].on(0.0, 1.0);
        let light = points().flat_map(|(u, of_u)| points().map(move |(v, of_v)| (u, v, of_u * of_v)));
        let light = light.map(|(u, v, weight)| {
            let (point, element) = polygon.at(u, v);
            let place = Place::new(point, polygon, &before);
            weight * element * place.irradiance(zenith, &radiance, [&rules[1], &rules[2]])
        });
        light.sum::<f64>() / polygon.area()
    };
    Some(patches.par_iter().map(on).collect())
}

/// A point on a patch, and the facets in front of it.
struct Place<'a> {
    point: Vec3,
    normal: Vec3,
    axis: Vec3,
    /// Perpendicular to both.
    aside: Vec3,
    before: &'a [Polygon],
}

impl<'a> Place<'a> {
    fn new(point: Vec3, patch: &Polygon, before: &'a [Polygon]) -> Self {
        let normal = patch.normal();
        // two corners of a patch may coincide
        let mut sides = patch.edges().map(|(from, to)| to - from);
        let side = sides.find(|side| side.norm() > 0.0);
        let axis = side.map_or_else(Vector3::y, |side| side.normalize());
        Self { point, normal, axis, aside: axis.cross(&normal), before }
    }

    /// Irradiance, integrated over the angles between half-planes and the patch's plane, and over
    /// semicircles.
    fn irradiance(&self, zenith: &Vec3, radiance: &impl Fn(&Vec3) -> f64, [arcs, on_arc]: [&Rule; 2]) -> f64 {
        let of_arc = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            let out = cos * self.aside + sin * self.normal;
            let mut seen = above_horizon(zenith.dot(&out), zenith.dot(&self.axis));
            for [low, high] in self.before.iter().filter_map(|caster| self.hidden(caster, &out)) {
                seen = seen
                    .into_iter()
                    .flat_map(|arc| [[arc[0], arc[1].min(low)], [arc[0].max(high), arc[1]]])
                    .collect();
                seen.retain(|[low, high]| low < high);
            }
            let light = seen.iter().flat_map(|arc| on_arc.on(arc[0], arc[1])).map(|(turn, weight)| {
                let (turn_sin, turn_cos) = turn.sin_cos();
                weight * turn_cos * turn_cos * radiance(&(turn_cos * out + turn_sin * self.axis))
            });
            sin * light.sum::<f64>()
        };
        let breaks = self.breaks(zenith);
        let pieces = breaks.windows(2).flat_map(|ends| arcs.on(ends[0], ends[1]));
        pieces.map(|(angle, weight)| weight * of_arc(angle)).sum::<f64>() / PI
    }

    /// Angles at which a corner of a facet comes into view, or the horizon crosses the plane perpendicular to
    /// the axis.
    fn breaks(&self, zenith: &Vec3) -> Vec<f64> {
        let corners = self.before.iter().flat_map(Polygon::corners).map(|corner| corner - self.point);
        let angle = |towards: Vec3| towards.dot(&self.normal).atan2(towards.dot(&self.aside));
        let horizon = zenith.cross(&self.axis);
        let all = corners.map(angle).chain([angle(horizon), angle(-horizon)]);
        let mut breaks: Vec<f64> = all.filter(|angle| *angle > 0.0 && *angle < PI).chain([0.0, PI]).collect();
        breaks.sort_by(f64::total_cmp);
        breaks
    }

    /// The arc of the semicircle through the direction `out` that a facet hides.
    fn hidden(&self, caster: &Polygon, out: &Vec3) -> Option<[f64; 2]> {
        let side = self.axis.cross(out);
        let mut arc = [f64::INFINITY, f64::NEG_INFINITY];
        for (from, to) in edges(caster.corners()) {
            let (from, to) = (from - self.point, to - self.point);
            let (height_from, height_to) = (side.dot(&from), side.dot(&to));
            if (height_from > 0.0) == (height_to > 0.0) {
                continue;
            }
            let met = from + (to - from) * (height_from / (height_from - height_to));
            let turn = met.dot(&self.axis).atan2(met.dot(out));
            if turn.abs() < FRAC_PI_2 {
                arc = [arc[0].min(turn), arc[1].max(turn)];
            }
        }
        (arc[0] < arc[1]).then_some(arc)
    }
}

/// Arcs of a semicircle above the horizon, for a zenith with these components along `out` and along the axis.
fn above_horizon(out: f64, along: f64) -> Vec<[f64; 2]> {
    let horizon = -(out / along).atan();
    match along {
        along if along.abs() < ALONG => {
            if out > 0.0 {
                vec![[-FRAC_PI_2, FRAC_PI_2]]
            } else {
                Vec::new()
            }
        }
        along if along > 0.0 => vec![[horizon, FRAC_PI_2]],
        _ => vec![[-FRAC_PI_2, horizon]],
    }
}
