//! Sheet models on the fold of a photograph, seen from its camera.

use std::sync::LazyLock;

use nalgebra::{Point3, Vector3};
use ndarray::Axis;
use rayon::prelude::*;

use super::bends::Bends;
use super::bins::Bins;
use super::reflections::Reflections;
use crate::error::Result;
use crate::estimate::photograph::sheets::{
    BODY_ROUGHNESSES_DEG, Departure, SHEEN, SPECULAR_ROUGHNESSES, SPECULAR_WEIGHTS, Sheets,
};
use crate::geometry::Fold;
use crate::sheet::{Family, Shape, measured, measured_names};
use crate::transport::departures;

/// The known sheets as seen on this fold, without the measured one named `left_out`.
pub fn of(
    (fold, bends): (&Fold, &Bends),
    [sun, eye]: [Vector3<f64>; 2],
    (nodes, bins): (&[f64], &Bins),
    left_out: Option<&str>,
) -> Result<Sheets> {
    let tables = measured()?.iter().zip(measured_names()).filter(|(_, name)| Some(*name) != left_out);
    let all: Vec<Shape> = FORMULAS.iter().chain(tables.map(|(shape, _)| shape)).cloned().collect();
    let beyond = departures(fold, &sun, &Point3::from(eye), &all, nodes);
    let reflections = Reflections::of(fold, bends, sun);
    let changes: Vec<_> = all.par_iter().map(|shape| reflections.changes(shape)).collect();
    let departure = |(n, shape): (usize, &Shape)| Departure {
        radiance: bins.pool(&beyond.index_axis(Axis(0), n).to_owned()),
        reflectance: shape.slope_and_offset(),
        changes: Some(bins.pool(&changes[n])),
    };
    let mut known: Vec<Departure> = all.iter().enumerate().map(departure).collect();
    let measured = known.split_off(FORMULAS.len());
    let fuzzy = known.split_off(FORMULAS.len() - SHEEN.len());
    let place = |n: usize| n - (0..=n).filter(|one| representative(*one) != *one).count();
    let of_family = |n: usize| &known[place(representative(n))];
    Ok(Sheets {
        sheen: [0, 1].map(|n| fuzzy[n].less(of_family(MIDDLE))),
        families: (0..FAMILIES).map(|n| of_family(n).clone()).collect(),
        measured,
    })
}

/// The family at the middle of all nodes.
const MIDDLE: usize = 13;

/// Number of families at the nodes.
const FAMILIES: usize = 27;

/// Shapes given by formulas: the distinct families, then those with sheen.
static FORMULAS: LazyLock<Vec<Shape>> = LazyLock::new(|| {
    let distinct = (0..FAMILIES).filter(|n| representative(*n) == *n).map(family);
    distinct.chain(SHEEN.map(|sheen| Family { sheen, ..family(MIDDLE) })).map(Shape::from).collect()
});

/// The family at a node: specular weight, specular roughness and body roughness, the last varying fastest.
fn family(n: usize) -> Family {
    Family {
        specular_weight: SPECULAR_WEIGHTS[n / 9],
        roughness: SPECULAR_ROUGHNESSES[n / 3 % 3],
        body_roughness_deg: BODY_ROUGHNESSES_DEG[n % 3],
        ..Family::default()
    }
}

/// Without a specular surface its roughness makes no difference.
fn representative(n: usize) -> usize {
    if n < 9 { n % 3 } else { n }
}
