//! Light of sky and ground on the fold of a photograph.

use nalgebra::Vector3;

use super::bins::Bins;
use crate::error::Result;
use crate::estimate::photograph::parts::Ambient;
use crate::geometry::Fold;
use crate::kernel::environment::{Environment, Surroundings};

/// A clear sky and the ground on a fold.
pub fn of(
    fold: &Fold,
    up: Vector3<f64>,
    sun: Vector3<f64>,
    nodes: &[f64],
    bins: &Bins,
) -> Result<[Ambient; 2]> {
    let of = |part| {
        let environment = Environment::new(part, up);
        let radiance = bins.pool(&environment.facet_radiance(fold, nodes)?);
        Ok(Ambient { radiance, open: environment.on_plane(sun) })
    };
    Ok([of(Surroundings::ClearSky { sun })?, of(Surroundings::Ground)?])
}
