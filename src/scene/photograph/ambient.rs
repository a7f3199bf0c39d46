//! Light of sky and ground on the fold of a photograph.

use nalgebra::Vector3;
use ndarray::Array2;

use super::bins::Bins;
use super::framing::Pose;
use crate::error::Result;
use crate::estimate::photograph::parts::{Ambient, Change, ELEVATIONS_DEG, Surroundings};
use crate::geometry::{Fold, StandardSky};
use crate::kernel::bent::BentFold;
use crate::kernel::environment::{Environment, Surroundings as Part, facet_radiances};

/// Crease radii for which light is computed, in panel depths.
pub(super) const CREASE_RADII: [f64; 2] = [0.012, 0.03];
/// Changes of the fold for which light is recomputed: degrees between the panels, at most a share of the
/// angle, and bow.
const ANGLE_DEG: f64 = 3.0;
const ANGLE_MOST: f64 = 0.15;
const BOW_DEG: f64 = 3.0;

/// Light of skies and ground on a fold facing `sun`. The `zenith` is as stated, or else follows from the
/// camera, which people hold upright.
///
/// `even` is the exact radiance of the facets in uniform light of irradiance 1 on an open plane, facet by
/// node. Radiance in other light is coarse and corrected by the same ratio.
pub fn of(
    fold: &Fold,
    (pose, sun, zenith): (&Pose, Vector3<f64>, Option<Vector3<f64>>),
    (nodes, even): (&[f64], &Array2<f64>),
    bins: &Bins,
) -> Result<Surroundings> {
    let lights = ELEVATIONS_DEG.map(|elevation_deg| {
        let up = pose.up(sun, elevation_deg.to_radians().sin(), zenith);
        Environment::new(
            [Part::Standard(StandardSky::CLEAR, sun), Part::OvercastSky, Part::Ground, Part::Sky],
            up,
        )
    });
    let view = pose.eye.normalize();
    let flat = BentFold::ideal(fold.angle_deg());
    let known = facet_radiances(&lights, (&flat, fold, view), nodes)?;
    let middle = ELEVATIONS_DEG.len() / 2;
    let [_, _, ground, sky] = &known[middle];
    let true_of = even / &(ground + sky);
    let step = ANGLE_DEG.min(ANGLE_MOST * fold.angle_deg());
    let changes = [
        (step, BentFold::ideal(fold.angle_deg() + step)),
        (BOW_DEG, BentFold { bow_deg: [BOW_DEG; 2], ..flat }),
    ];
    let rounded = CREASE_RADII.map(|crease_radius| (crease_radius, BentFold { crease_radius, ..flat }));
    let changed = |(_, bent): &(f64, BentFold)| {
        let mut radiances = facet_radiances(&lights[middle..=middle], (bent, fold, view), nodes)?;
        Ok(radiances.remove(0))
    };
    let changed: Vec<_> = changes.iter().chain(&rounded).map(changed).collect::<Result<_>>()?;
    let ambient = |part: usize| {
        let more = |n: usize| bins.pool(&((&changed[n][part] - &known[middle][part]) * &true_of));
        Ambient {
            radiance: [0, 1, 2].map(|n| bins.pool(&(&known[n][part] * &true_of))),
            open: lights.each_ref().map(|light| light.on_plane(sun)[part]),
            by_angle: more(0) / changes[0].0,
            by_bow: more(1) / changes[1].0,
            crease_radius: Change { known: [0, 1].map(|n| (rounded[n].0, more(2 + n))).to_vec() },
        }
    };
    Ok(Surroundings { clear: ambient(0), overcast: ambient(1), ground: ambient(2) })
}
