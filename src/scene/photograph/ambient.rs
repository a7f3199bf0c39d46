//! Light of sky and ground on the fold of a photograph.

use nalgebra::Vector3;
use ndarray::Array2;

use super::bends::Bends;
use super::bins::Bins;
use super::framing::Pose;
use crate::error::Result;
use crate::estimate::photograph::parts::{Ambient, Change, ELEVATIONS_DEG, Surroundings};
use crate::geometry::{Fold, StandardSky};
use crate::kernel::bent::{BentExchange, BentFold};
use crate::kernel::environment::{Environment, Surroundings as Part, facet_radiances};

/// Change of the angle for which light is recomputed: degrees, at most a share of the angle.
const ANGLE_DEG: f64 = 3.0;
const ANGLE_MOST: f64 = 0.15;

/// Light of skies and ground on a fold facing `sun`. The `zenith` is as stated, or else follows from the
/// camera, which people hold upright.
///
/// `even` is the exact radiance of the facets in uniform light of irradiance 1 on an open plane, facet by
/// node. Radiance in other light is coarse and corrected by the same ratio.
pub fn of(
    fold: &Fold,
    (pose, sun, zenith): (&Pose, Vector3<f64>, Option<Vector3<f64>>),
    (nodes, even): (&[f64], &Array2<f64>),
    (bends, bins): (&Bends, &Bins),
) -> Result<Surroundings> {
    let lights = ELEVATIONS_DEG.map(|elevation_deg| {
        let up = pose.up(sun, elevation_deg.to_radians().sin(), zenith);
        Environment::new(
            [Part::Standard(StandardSky::CLEAR, sun), Part::OvercastSky, Part::Ground, Part::Sky],
            up,
        )
    });
    let known = facet_radiances(&lights, &bends.ideal, nodes)?;
    let middle = ELEVATIONS_DEG.len() / 2;
    let [_, _, ground, sky] = &known[middle];
    let true_of = even / &(ground + sky);
    let step = ANGLE_DEG.min(ANGLE_MOST * fold.angle_deg());
    let wider = BentExchange::new(&BentFold::ideal(fold.angle_deg() + step), fold, bends.view);
    let [_, hollow] = &bends.bowed;
    let changed = |bent: &BentExchange| {
        let mut radiances = facet_radiances(&lights[middle..=middle], bent, nodes)?;
        Ok(radiances.remove(0))
    };
    let all = [&wider, &hollow.1].into_iter().chain(bends.rounded.iter().map(|(_, bent)| bent));
    let changed: Vec<_> = all.map(changed).collect::<Result<_>>()?;
    let ambient = |part: usize| {
        let more = |n: usize| bins.pool(&((&changed[n][part] - &known[middle][part]) * &true_of));
        Ambient {
            radiance: [0, 1, 2].map(|n| bins.pool(&(&known[n][part] * &true_of))),
            open: lights.each_ref().map(|light| light.on_plane(sun)[part]),
            by_angle: more(0) / step,
            by_bow: more(1) / hollow.0,
            crease_radius: Change { known: [0, 1].map(|n| (bends.rounded[n].0, more(2 + n))).to_vec() },
        }
    };
    Ok(Surroundings { clear: ambient(0), overcast: ambient(1), ground: ambient(2) })
}
