//! Kinds of sheets on the fold of a photograph, before its camera.

use std::sync::LazyLock;

use nalgebra::{Point3, Vector3};
use ndarray::Axis;

use super::bins::Bins;
use crate::error::Result;
use crate::estimate::photograph::sheets::{Departure, FAMILY_NODES, Instrument, SHEEN, Sheets};
use crate::geometry::Fold;
use crate::sheet::{Family, Shape, measured, measured_names};
use crate::transport::departures;

/// Each of the measured sheets described by the others from what its facets show: by how much its 45:0
/// reflectance is off in all bands (6.3 to 6.7 %, left out in turn on two folds), and, of the six that were
/// photographed, how far each band is off beside that.
const INSTRUMENT: Instrument = Instrument { shared: 0.065, own: 0.06 };

/// The sheets that are known, seen on this fold, but for a measured one of that name.
pub fn of(
    fold: &Fold,
    [sun, eye]: [Vector3<f64>; 2],
    nodes: &[f64],
    bins: &Bins,
    left_out: Option<&str>,
) -> Result<Sheets> {
    let tables = measured()?.iter().zip(measured_names()).filter(|(_, name)| Some(*name) != left_out);
    let all: Vec<Shape> = FORMULAS.iter().chain(tables.map(|(shape, _)| shape)).cloned().collect();
    let beyond = departures(fold, &sun, &Point3::from(eye), &all, nodes);
    let departure = |(shape, radiance): (&Shape, ndarray::ArrayView2<f64>)| Departure {
        radiance: bins.pool(&radiance.to_owned()),
        reflectance: shape.slope_and_offset(),
    };
    let mut known: Vec<Departure> = all.iter().zip(beyond.axis_iter(Axis(0))).map(departure).collect();
    let measured = known.split_off(FORMULAS.len());
    let fuzzy = known.split_off(FORMULAS.len() - SHEEN.len());
    let place = |n: usize| n - (0..=n).filter(|one| representative(*one) != *one).count();
    let of_family = |n: usize| &known[place(representative(n))];
    Ok(Sheets {
        sheen: [0, 1].map(|n| fuzzy[n].less(of_family(MIDDLE))),
        families: (0..FAMILIES).map(|n| of_family(n).clone()).collect(),
        measured,
        instrument: INSTRUMENT,
    })
}

/// The family in the middle of all nodes.
const MIDDLE: usize = 13;

/// Families at the nodes.
const FAMILIES: usize = 27;

/// Shapes that formulas give: of the families that differ, then those with sheen.
static FORMULAS: LazyLock<Vec<Shape>> = LazyLock::new(|| {
    let distinct = (0..FAMILIES).filter(|n| representative(*n) == *n).map(family);
    distinct.chain(SHEEN.map(|sheen| Family { sheen, ..family(MIDDLE) })).map(Shape::from).collect()
});

/// The family at a node: strength and roughness of the surface, roughness of the body, the last fastest.
fn family(n: usize) -> Family {
    let nodes = FAMILY_NODES;
    Family {
        specular_weight: nodes.specular_weight[n / 9],
        roughness: nodes.specular_roughness[n / 3 % 3],
        body_roughness_deg: nodes.body_roughness_deg[n % 3],
        ..Family::default()
    }
}

/// Without gloss its roughness makes no difference.
fn representative(n: usize) -> usize {
    if n < 9 { n % 3 } else { n }
}
