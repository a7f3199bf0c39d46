//! Radiance of a non-Lambertian sheet towards the eye minus that of a Lambertian sheet of the same albedo,
//! over a fold.
//!
//! Eq. (4) with a direction-dependent reflection: light leaving one panel is traced to each place of the
//! other. Single reflections are exact, and double ones are integrated over the directions at each
//! [point](points); further reflections are computed between flat [patches]. The Lambertian sheet, solved
//! exactly in [`crate::response`], is subtracted from both.

mod frame;
pub mod patches;
pub mod points;
mod pooling;

use nalgebra::{Point3, Vector3};
use ndarray::{Array2, Array3, Axis, concatenate};
use rayon::prelude::*;

use crate::geometry::Fold;
use crate::sheet::{POWERS, Shape};
use frame::Frame;
use patches::Patches;
use points::Points;

/// Radiance of every facet towards the eye minus that of a Lambertian sheet of the same albedo: shapes by
/// facets by albedos.
///
/// # Arguments
/// - `sun`: direction towards the light, in the coordinates of [`Fold::panels`]; `eye`: position of the
///   camera, in the fold's unit.
/// - `shapes`: angular BRDFs; `albedos`: the albedos at which the radiance is computed.
///
/// # Returns
/// Facet means, panel by panel and row by row, relative to the radiance of an isolated perfect diffuser
/// facing the sun.
///
/// # Source
/// Deeb et al., eq. (4), without its Lambertian assumption.
///
/// # Example
/// ```
/// use nalgebra::{Point3, Vector3};
/// use vfold::geometry::{FacetGrid, Fold};
/// use vfold::sheet::{Family, Shape};
/// use vfold::transport::departures;
/// let fold = Fold::new(48.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
/// let matt = Shape::from(Family::default());
/// let glossy = Shape::from(Family { specular_weight: 0.5, roughness: 0.4, ..Family::default() });
/// let beyond = departures(&fold, &Vector3::z(), &Point3::new(1.0, 1.1, 8.4), &[matt, glossy], &[0.1, 0.6]);
/// assert!((0..200).all(|facet| beyond[[0, facet, 1]].abs() < 1e-12));
/// assert!(beyond[[1, 5, 1]].abs() > 1e-3); // panel 0, at the crease
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn departures(
    fold: &Fold,
    sun: &Vector3<f64>,
    eye: &Point3<f64>,
    shapes: &[Shape],
    albedos: &[f64],
) -> Array3<f64> {
    let frames = [0, 1].map(|panel| Frame::new(fold, panel, sun, eye));
    let points = Points::new(fold, &frames);
    let patches = (!fold.is_flat()).then(|| Patches::new(fold, &frames));
    let lambertian = patches.as_ref().map(|patches| patches.radiances(&Shape::lambertian()));
    let departure = |shape: &Shape| {
        let more = patches.iter().zip(&lambertian).map(|(patches, matt)| patches.radiances(shape) - matt);
        (points.departures(shape), more.collect())
    };
    let (few, more): (Vec<_>, Vec<Vec<_>>) = shapes.par_iter().map(departure).unzip();
    let mut all = Array3::zeros((shapes.len(), 2 * fold.facets().len(), albedos.len()));
    if shapes.is_empty() {
        return all;
    }
    let powers = Array2::from_shape_fn((POWERS, albedos.len()), |(power, n)| albedos[n].powi(power as i32));
    add(&mut all, &points.pooled(&side_by_side(&few)), &powers);
    if let Some(patches) = &patches {
        let more: Vec<_> = more.into_iter().flatten().collect();
        add(&mut all, &patches.pooled(&side_by_side(&more)), &patches.shares(albedos));
    }
    all
}

/// The columns of all matrices: what is the same for all of their rows is then done once.
fn side_by_side(all: &[Array2<f64>]) -> Array2<f64> {
    let views: Vec<_> = all.iter().map(|one| one.view()).collect();
    concatenate(Axis(1), &views).unwrap_or_default()
}

/// Adds to all shapes their facets at each albedo: those at nodes or of powers, side by side, times their
/// `shares` in each albedo.
fn add(all: &mut Array3<f64>, facets: &Array2<f64>, shares: &Array2<f64>) {
    let each = facets.axis_chunks_iter(Axis(1), shares.nrows());
    all.axis_iter_mut(Axis(0)).zip(each).for_each(|(mut all, one)| all += &one.dot(shares));
}
