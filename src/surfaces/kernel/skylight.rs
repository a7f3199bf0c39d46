//! Skylight on patches, from directions sampled for every patch in proportion to their effect.

use std::f64::consts::TAU;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

use super::casters::Casters;
use super::patches::Patch;
use crate::geometry::Vec3;
use crate::surfaces::polygon::{Polygon, edges};
use crate::surfaces::shape::Shape;

/// Sets of rays from a patch, each a shift of the same quasirandom one: their scatter determines the error of
/// their mean.
const SETS: usize = 16;
/// Rays per set.
const RAYS: usize = 512;
/// Steps of the quasirandom set along its four axes: reciprocal powers of the root of x⁵ = x + 1.
const STEPS: [f64; 4] =
    [0.856_674_883_854_502_9, 0.733_891_856_627_126, 0.628_706_721_037_820_3, 0.538_597_257_223_610_7];

/// Mean irradiance of every patch under a sky with this `radiance` times π by direction, past all facets, and
/// the largest standard error among them.
///
/// # Source
/// Roberts, *The Unreasonable Effectiveness of Quasirandom Sequences* (2018), for the set; shifts after
/// Cranley and Patterson, *SIAM J. Numer. Anal.* 13 (1976), p. 904.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold};
/// use vfold::surfaces::Accordion;
/// use vfold::surfaces::kernel::patches::{Division, patches};
/// use vfold::surfaces::kernel::skylight::skylight;
/// let valley = Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?;
/// let v = Accordion { valley, creases: 1, ridge_deg: 90.0, bow_deg: 0.0 }.shape()?;
/// // A uniform sky gives a panel what the other panel does not hide.
/// let (irradiance, error) = skylight(&v, &patches(&v, Division::NONE), |_| 1.0);
/// assert!((irradiance[0] - (1.0 - 0.20004377607540316)).abs() < 4.0 * error, "{irradiance:?} {error}");
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn skylight(shape: &Shape, patches: &[Patch], radiance: impl Fn(&Vec3) -> f64 + Sync) -> (Vec<f64>, f64) {
    means(shape, patches, |screens, point, towards| {
        let light = radiance(towards);
        let hidden = light > 0.0 && screens.iter().any(|screen| screen.distance(point, towards).is_some());
        if hidden { 0.0 } else { light }
    })
}

/// Fraction of every patch's view that is filled by the backs of facets, and the largest standard error among
/// them; exactly zero if no back is seen.
#[must_use]
pub fn backs(shape: &Shape, patches: &[Patch]) -> (Vec<f64>, f64) {
    means(shape, patches, |screens, point, towards| {
        let nearest = |is_back: bool| {
            let facing = screens.iter().filter(|screen| (screen.normal.dot(towards) > 0.0) == is_back);
            facing.filter_map(|screen| screen.distance(point, towards)).fold(f64::INFINITY, f64::min)
        };
        // facets that reflect on both sides have a front in place of every back
        if nearest(true) < (1.0 - 1e-9) * nearest(false) { 1.0 } else { 0.0 }
    })
}

/// Means of `value` over rays from every patch, and their largest standard error.
fn means(
    shape: &Shape,
    patches: &[Patch],
    value: impl Fn(&[Screen], &Vec3, &Vec3) -> f64 + Sync,
) -> (Vec<f64>, f64) {
    let casters = Casters::new(shape.facets(), shape.size());
    let of_patch = |(seed, patch): (usize, &Patch)| {
        let screens: Vec<Screen> =
            casters.in_front_of(&patch.polygon.plane()).iter().map(Screen::new).collect();
        let mut random = ChaCha8Rng::seed_from_u64(seed as u64);
        let of_ray = |point: &Vec3, towards: &Vec3| value(&screens, point, towards);
        let sets = [(); SETS].map(|()| mean_of_set(&patch.polygon, &of_ray, shift(&mut random)));
        let mean = sets.iter().sum::<f64>() / SETS as f64;
        let square = sets.iter().map(|set| (set - mean).powi(2)).sum::<f64>();
        (mean, (square / (SETS * (SETS - 1)) as f64).sqrt())
    };
    let all: Vec<(f64, f64)> = patches.par_iter().enumerate().map(of_patch).collect();
    let error = all.iter().map(|(_, error)| *error).fold(0.0, f64::max);
    (all.into_iter().map(|(mean, _)| mean).collect(), error)
}

fn shift(random: &mut ChaCha8Rng) -> [f64; 4] {
    [(); 4].map(|()| f64::from(random.next_u32()) / f64::from(u32::MAX))
}

/// Mean over rays from points all over a patch, in cosine-distributed directions.
fn mean_of_set(patch: &Polygon, value: &impl Fn(&Vec3, &Vec3) -> f64, shift: [f64; 4]) -> f64 {
    let across = patch.edges().next().map_or(Vec3::x(), |(from, to)| (to - from).normalize());
    let frame = [across, patch.normal().cross(&across), patch.normal()];
    let ray = |n: usize| {
        let [u, v, square, turn]: [f64; 4] =
            std::array::from_fn(|axis| (shift[axis] + n as f64 * STEPS[axis]).fract());
        let (point, element) = patch.at(u, v);
        let (sin, cos) = (TAU * turn).sin_cos();
        let out = square.sqrt();
        let towards = out * cos * frame[0] + out * sin * frame[1] + (1.0 - square).sqrt() * frame[2];
        element / patch.area() * value(&point, &towards)
    };
    (0..RAYS).map(ray).sum::<f64>() / RAYS as f64
}

/// A facet that may hide the sky.
struct Screen {
    normal: Vec3,
    offset: f64,
    /// Inward normals of its sides, in its plane, and their offsets.
    sides: Vec<(Vec3, f64)>,
}

impl Screen {
    fn new(polygon: &Polygon) -> Self {
        let (plane, normal) = (polygon.plane(), polygon.normal());
        let side = |(from, to): (Vec3, Vec3)| {
            let inwards = normal.cross(&(to - from));
            (inwards, inwards.dot(&from))
        };
        Self { normal, offset: plane.offset, sides: edges(polygon.corners()).map(side).collect() }
    }

    /// Distance from a point in a direction, if the ray meets it.
    fn distance(&self, from: &Vec3, towards: &Vec3) -> Option<f64> {
        let distance = (self.offset - self.normal.dot(from)) / self.normal.dot(towards);
        if !(distance > 0.0 && distance.is_finite()) {
            return None;
        }
        let point = from + distance * towards;
        self.sides.iter().all(|(inwards, offset)| inwards.dot(&point) >= *offset).then_some(distance)
    }
}
