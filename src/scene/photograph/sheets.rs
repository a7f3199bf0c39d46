//! Kinds of sheets on the fold of a photograph, before its camera.

use nalgebra::{DMatrix, DVector, Point3, Vector3};
use ndarray::Axis;

use super::bins::Bins;
use crate::error::Result;
use crate::estimate::photograph::parts::Radiance;
use crate::estimate::photograph::sheets::{Departure, FAMILY_NODES, Sheets};
use crate::geometry::Fold;
use crate::sheet::{Family, Shape, measured};
use crate::solve::Eigen;
use crate::transport::departures;

/// Numbers by which sheets of a kind vary.
const VARIATIONS: usize = 8;
/// How far sheets of a kind vary, relative to how far kinds do.
const WITHIN_KINDS: f64 = 0.4;
/// How much more or less an instrument of 45:0 says of sheets that send the same to the camera, relative to their albedo: kinds that were
/// measured differ by that.
const INSTRUMENT: f64 = 0.08;
/// Least radiance that departures are compared with: what is added to the brightness of the facets.
const FLOOR: f64 = 0.05;
/// A kind that departs from a Lambertian sheet by more than that in the mean, relative to the brightness of the facets, is taken to depart
/// by that: measured far from grazing directions, it is not known there.
const MOST: f64 = 0.6;

/// The kinds that are known, seen on this fold; `even` is the radiance of a Lambertian sheet in pooled facets.
pub fn of(
    fold: &Fold,
    sun: Vector3<f64>,
    eye: Vector3<f64>,
    nodes: &[f64],
    bins: &Bins,
    lambertian: &Radiance,
) -> Result<Sheets> {
    let families = families();
    let shapes: Vec<Shape> = families.iter().map(|family| Shape::from(*family)).collect();
    let distinct: Vec<usize> = (0..families.len()).filter(|n| is_distinct(*n)).collect();
    let all: Vec<Shape> =
        distinct.iter().map(|n| shapes[*n].clone()).chain(measured()?.iter().cloned()).collect();
    let eye = Point3::from(eye);
    let beyond = departures(fold, &sun, &eye, &all, nodes);
    let departure = |(shape, radiance): (&Shape, ndarray::ArrayView2<f64>)| Departure {
        radiance: bins.pool(&radiance.to_owned()),
        reflectance: shape.slope_and_offset(),
    };
    let mut known: Vec<Departure> = all.iter().zip(beyond.axis_iter(Axis(0))).map(departure).collect();
    let mut measured = known.split_off(distinct.len());
    measured.iter_mut().for_each(|one| bound(one, lambertian));
    let variations = variations(&measured, lambertian);
    let place = |n: usize| distinct.iter().position(|one| *one == representative(n)).unwrap_or(0);
    let families = (0..families.len()).map(|n| known[place(n)].clone()).collect();
    Ok(Sheets { families, measured, variations, instrument: INSTRUMENT })
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

/// The directions in which measured kinds differ most, in units of a standard deviation within a kind.
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
    let scale = WITHIN_KINDS / (count as f64).sqrt();
    let component = |n: &usize| {
        // coefficients of the kinds, which add up to nothing
        let own = vectors.column(*n);
        let middle = own.mean();
        let mut sum = Departure {
            radiance: Radiance::zeros(lambertian.nrows(), lambertian.ncols()),
            reflectance: [0.0; 2],
        };
        for (kind, share) in measured.iter().zip(own.iter()) {
            let share = scale * (share - middle);
            sum.radiance += share * &kind.radiance;
            sum.reflectance[0] += share * kind.reflectance[0];
            sum.reflectance[1] += share * kind.reflectance[1];
        }
        sum
    };
    order.iter().take(VARIATIONS.min(count.saturating_sub(1))).map(component).collect()
}
