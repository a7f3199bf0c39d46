//! Kinds of sheets on the fold of a photograph, before its camera.

use nalgebra::{DMatrix, DVector, Point3, Vector3};
use ndarray::Axis;

use super::bins::Bins;
use crate::error::Result;
use crate::estimate::photograph::parts::Radiance;
use crate::estimate::photograph::sheets::{Departure, FAMILY_NODES, FUZZ, Instrument, Sheets};
use crate::geometry::Fold;
use crate::sheet::{Family, Shape, measured, measured_names};
use crate::solve::Eigen;
use crate::transport::{Resolution, departures};

/// Numbers by which measured sheets vary.
const VARIATIONS: usize = 8;
/// Each of the measured sheets described by the others from what its facets show: by how much its 45:0 reflectance is off in all bands
/// (6.3 to 6.7 %, left out in turn on two folds), and, of the six that were photographed, how far each band is off beside that.
const INSTRUMENT: Instrument = Instrument { shared: 0.065, own: 0.06 };
/// Least radiance that departures are compared with: what is added to the brightness of the facets.
const FLOOR: f64 = 0.05;
/// A kind that departs from a Lambertian sheet by more than that in the mean, relative to the brightness of the facets, is taken to depart
/// by that: measured far from grazing directions, it is not known there.
const MOST: f64 = 0.6;

/// The kinds that are known, seen on this fold, but for a measured one of that name; `even` is the radiance of a Lambertian sheet in
/// pooled facets.
pub fn of(
    fold: &Fold,
    [sun, eye]: [Vector3<f64>; 2],
    nodes: &[f64],
    bins: &Bins,
    lambertian: &Radiance,
    left_out: Option<&str>,
) -> Result<Sheets> {
    let families = families();
    let fuzzy = FUZZ.map(|fuzz| Family { fuzz, ..families[MIDDLE] });
    let distinct: Vec<usize> = (0..families.len()).filter(|n| is_distinct(*n)).collect();
    let formulas = distinct.iter().map(|n| families[*n]).chain(fuzzy).map(Shape::from);
    let tables = measured()?.iter().zip(measured_names()).filter(|(_, name)| Some(*name) != left_out);
    let all: Vec<Shape> = formulas.chain(tables.map(|(shape, _)| shape.clone())).collect();
    let beyond = departures(fold, &sun, &Point3::from(eye), &all, nodes, &Resolution::COARSE);
    let departure = |(shape, radiance): (&Shape, ndarray::ArrayView2<f64>)| Departure {
        radiance: bins.pool(&radiance.to_owned()),
        reflectance: shape.slope_and_offset(),
    };
    let mut known: Vec<Departure> = all.iter().zip(beyond.axis_iter(Axis(0))).map(departure).collect();
    let mut measured = known.split_off(distinct.len() + FUZZ.len());
    measured.iter_mut().for_each(|one| bound(one, lambertian));
    let place = |n: usize| distinct.iter().position(|one| *one == representative(n)).unwrap_or(0);
    let fuzz = [0, 1].map(|n| known[distinct.len() + n].less(&known[place(MIDDLE)]));
    Ok(Sheets {
        fuzz,
        families: (0..families.len()).map(|n| known[place(n)].clone()).collect(),
        variations: variations(&measured, lambertian),
        measured: mean(&measured),
        instrument: INSTRUMENT,
    })
}

/// The family in the middle of all nodes.
const MIDDLE: usize = 13;

fn mean(all: &[Departure]) -> Departure {
    let share = 1.0 / all.len() as f64;
    let mut sum = all[0].less(&all[0]);
    all.iter().for_each(|one| sum.add(share, one, [0.0; 2]));
    sum
}

/// The families at the nodes: strength and roughness of the surface, roughness of the body, the last fastest.
fn families() -> Vec<Family> {
    let nodes = FAMILY_NODES;
    let of = |n: usize| Family {
        gloss: nodes.gloss[n / 9],
        roughness: nodes.gloss_roughness[n / 3 % 3],
        body_roughness_deg: nodes.body_roughness_deg[n % 3],
        ..Family::default()
    };
    (0..27).map(of).collect()
}

/// Without gloss its roughness makes no difference.
fn representative(n: usize) -> usize {
    if n < 9 { n % 3 } else { n }
}

fn is_distinct(n: usize) -> bool {
    representative(n) == n
}

fn bound(departure: &mut Departure, lambertian: &Radiance) {
    let size = weighted(departure, lambertian).norm() / (lambertian.len() as f64).sqrt();
    if size > MOST {
        let share = MOST / size;
        departure.radiance *= share;
        let [slope, offset] = departure.reflectance;
        departure.reflectance = [1.0 + share * (slope - 1.0), share * offset];
    }
}

fn weighted(departure: &Departure, lambertian: &Radiance) -> DVector<f64> {
    let relative = departure.radiance.zip_map(lambertian, |beyond, radiance| beyond / (radiance + FLOOR));
    DVector::from_iterator(relative.len(), relative.iter().copied())
}

/// The directions in which measured sheets differ most, in units of a standard deviation.
///
/// # Source
/// Principal components: Bishop, *Pattern Recognition and Machine Learning* (2006), section 12.1.4 (fewer points than dimensions).
fn variations(measured: &[Departure], lambertian: &Radiance) -> Vec<Departure> {
    let count = measured.len();
    let columns: Vec<_> = measured.iter().map(|one| weighted(one, lambertian)).collect();
    let columns = DMatrix::from_columns(&columns);
    let middle = columns.column_mean();
    let off = DMatrix::from_fn(columns.nrows(), count, |row, column| columns[(row, column)] - middle[row]);
    let Eigen { values, vectors } = Eigen::of_symmetric(off.tr_mul(&off));
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
    let scale = 1.0 / (count as f64).sqrt();
    let component = |n: &usize| {
        // coefficients of the kinds, which add up to nothing
        let own = vectors.column(*n);
        let middle = own.mean();
        let mut sum = measured[0].less(&measured[0]);
        for (kind, share) in measured.iter().zip(own.iter()) {
            sum.add(scale * (share - middle), kind, [0.0; 2]);
        }
        sum
    };
    order.iter().take(VARIATIONS.min(count.saturating_sub(1))).map(component).collect()
}
