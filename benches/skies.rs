//! How far light of skies as they are is from that of the two which photographs are predicted with: what
//! `discrepancy_sky` stands for.
//!
//! `cargo bench --bench skies` lights folds by the overcast and partly cloudy ones of the fifteen standard
//! skies, the sun hidden in any direction before them, takes away what amount, ground and elevation of the
//! overcast sky explain, and prints what is left, relative to the facets.

#![allow(clippy::print_stdout, reason = "a measurement for the reader of a terminal")]
#![allow(clippy::unwrap_used, reason = "a benchmark stops at the first surprise")]

use nalgebra::{DMatrix, DVector, Vector3};
use vfold::geometry::StandardSky;
use vfold::geometry::{FacetGrid, Fold};
use vfold::kernel::bent::{BentExchange, BentFold};
use vfold::kernel::environment::{Environment, Surroundings, facet_radiances};

const ANGLES_DEG: [f64; 3] = [40.0, 55.0, 70.0];
const ELEVATIONS_DEG: [f64; 3] = [30.0, 45.0, 60.0];
const ALBEDO: f64 = 0.4;
/// Types of skies on days without sun.
const TYPES: std::ops::RangeInclusive<usize> = 1..=6;
const SUN_HEIGHTS_DEG: [f64; 2] = [25.0, 50.0];
const SUN_AZIMUTHS_DEG: [f64; 4] = [0.0, 45.0, 90.0, 135.0];
/// Step of the derivative by elevation.
const STEP_DEG: f64 = 10.0;

fn up(elevation_deg: f64) -> Vector3<f64> {
    let (sin, cos) = elevation_deg.to_radians().sin_cos();
    Vector3::new(0.0, cos, sin)
}

/// The sun at this height and azimuth from the heading of a fold that opens by so much above the horizon.
fn sun(elevation_deg: f64, height_deg: f64, azimuth_deg: f64) -> Vector3<f64> {
    let up = up(elevation_deg);
    let ahead = (Vector3::z() - up * up.z).normalize();
    let aside = up.cross(&ahead);
    let ((rise, level), (sin, cos)) = (height_deg.to_radians().sin_cos(), azimuth_deg.to_radians().sin_cos());
    up * rise + (ahead * cos + aside * sin) * level
}

fn facets<const PARTS: usize>(
    fold: &Fold,
    parts: [Surroundings; PARTS],
    elevation_deg: f64,
) -> [DVector<f64>; PARTS] {
    let light = Environment::new(parts, up(elevation_deg));
    let seen = BentExchange::new(&BentFold::ideal(fold.angle_deg()), fold, Vector3::z());
    let mut all = facet_radiances(&[light], &seen, &[ALBEDO]).unwrap();
    all.remove(0).map(|radiance| DVector::from_iterator(radiance.len(), radiance.iter().copied()))
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

fn main() {
    println!("| type | remainder | between the panels | within them |\n|---|---|---|---|");
    for number in TYPES {
        let (mut left, mut between, mut within) = (Vec::new(), Vec::new(), Vec::new());
        for angle_deg in ANGLES_DEG {
            let fold = Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 }).unwrap();
            for elevation_deg in ELEVATIONS_DEG {
                let parts = [Surroundings::OvercastSky, Surroundings::Ground];
                let [overcast, ground] = facets(&fold, parts, elevation_deg);
                let [higher, _] = facets(&fold, parts, elevation_deg + STEP_DEG);
                for height_deg in SUN_HEIGHTS_DEG {
                    for azimuth_deg in SUN_AZIMUTHS_DEG {
                        let sun = sun(elevation_deg, height_deg, azimuth_deg);
                        let sky = StandardSky::of_type(number).unwrap();
                        let [truth] = facets(&fold, [Surroundings::Standard(sky, sun)], elevation_deg);
                        let relative = |part: &DVector<f64>| part.component_div(&truth);
                        let known = [&overcast, &ground, &higher].map(relative);
                        let known = DMatrix::from_columns(&known);
                        let ones = DVector::from_element(truth.len(), 1.0);
                        let shares = known.clone().svd(true, true).solve(&ones, 1e-9).unwrap();
                        let rest = ones - known * shares;
                        let half = rest.len() / 2;
                        let step = 0.5 * (rest.rows(0, half).mean() - rest.rows(half, half).mean());
                        left.push(rest.norm() / (rest.len() as f64).sqrt());
                        between.push(step);
                        within.push((left.last().unwrap().powi(2) - step * step).max(0.0).sqrt());
                    }
                }
            }
        }
        println!("| {number} | {:.4} | {:.4} | {:.4} |", rms(&left), rms(&between), rms(&within));
    }
}
