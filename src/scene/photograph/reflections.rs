//! Light that a sheet reflects once or twice on a fold that is rounded or bowed, or in a sun that stands
//! elsewhere.
//!
//! What a sheet reflects beyond a Lambertian one is computed for the fold and the sun as stated
//! ([`crate::transport`]); this gives how it changes. A rounded crease faces the sun and shines, while
//! panels that no longer meet mirror less light to each other; a bow, or a sun further aside, moves the
//! highlights of the panels. Reflected twice, light matters near the crease alone.

use std::f64::consts::{FRAC_1_PI, PI};

use nalgebra::{Vector2, Vector3};
use ndarray::{Array2, Axis};

use super::bends::{BOWS_DEG, Bends};
use crate::geometry::Fold;
use crate::kernel::bent::{BentExchange, Incoming};
use crate::sheet::{AngleList, Angles, POWERS, Shape, Twice};

/// Rows that begin further from the crease, in panel depths, get no light reflected twice.
const TWICE: f64 = 0.3;
/// Sizes of tilts between which a change is taken, degrees.
const TILTS_DEG: [f64; 2] = [-3.0, 3.0];

/// The fold of a photograph under all changes.
pub struct Reflections {
    cols: usize,
    stated: Paths,
    rounded: [Paths; 2],
    bowed: [Paths; 2],
    tilted: [Paths; 2],
}

/// Paths of light from the sun to the eye by way of the points that a row of facets shows.
#[derive(Default)]
struct Paths {
    rows: usize,
    /// Row of each path with one reflection, and its irradiance; then the reflection.
    once: Vec<(usize, f64)>,
    at_point: AngleList,
    /// Row of each path with two reflections, and its irradiance; then the two, that at the point last.
    twice: Vec<(usize, f64)>,
    at_patch: AngleList,
    next_at_point: AngleList,
}

impl Reflections {
    /// Of a fold in a sun in this direction.
    pub fn of(fold: &Fold, bends: &Bends, sun: Vector3<f64>) -> Self {
        let eye = bends.view.towards;
        let near = fold.spacing().edges(fold.facets().rows).iter().filter(|edge| **edge < TWICE).count();
        let paths = |bent: &BentExchange, sun: &Vector3<f64>| Paths::of(bent, near, [sun, &eye]);
        let tilted = |tilt_deg: f64| {
            let (sin, cos) = tilt_deg.to_radians().sin_cos();
            Vector3::new(cos * sun.x + sin * sun.z, sun.y, cos * sun.z - sin * sun.x)
        };
        Self {
            cols: fold.facets().cols,
            stated: paths(&bends.ideal, &sun),
            rounded: bends.rounded.each_ref().map(|(_, bent)| paths(bent, &sun)),
            bowed: bends.bowed.each_ref().map(|(_, bent)| paths(bent, &sun)),
            tilted: TILTS_DEG.map(|tilt_deg| paths(&bends.ideal, &tilted(tilt_deg))),
        }
    }

    /// Changes of a sheet's departure from a Lambertian one, as
    /// [`Departure::changes`](crate::estimate::photograph::sheets::Departure::changes) has them, but facet
    /// by facet.
    pub fn changes(&self, shape: &Shape) -> Array2<f64> {
        let stated = self.stated.departures(shape);
        let per_degree = |[low, high]: &[Paths; 2], sizes: [f64; 2]| {
            (high.departures(shape) - low.departures(shape)) / (sizes[1] - sizes[0])
        };
        let blocks = [
            self.rounded[0].departures(shape) - &stated,
            self.rounded[1].departures(shape) - &stated,
            per_degree(&self.bowed, BOWS_DEG),
            per_degree(&self.tilted, TILTS_DEG),
        ];
        let rows: Vec<_> = blocks.iter().flat_map(|block| block.axis_iter(Axis(1))).collect();
        Array2::from_shape_fn((stated.nrows() * self.cols, rows.len()), |(facet, n)| {
            rows[n][facet / self.cols]
        })
    }
}

impl Paths {
    /// On a fold, with two reflections in this many rows of each panel.
    fn of(bent: &BentExchange, near: usize, [sun, eye]: [&Vector3<f64>; 2]) -> Self {
        let all = bent.rows();
        let mut paths = Self { rows: all.len(), ..Self::default() };
        for (row, points) in all.iter().enumerate() {
            for point in points {
                let [sun, eye] = [sun, eye].map(|direction| local(direction, &point.normal));
                paths.once.push((row, point.share * sun.z.max(0.0)));
                paths.at_point.extend([Angles::new(&sun, &eye)]);
            }
            if row % (all.len() / 2) < near {
                paths.add_twice(row, &bent.incoming(row), [sun, eye]);
            }
        }
        paths
    }

    fn add_twice(&mut self, row: usize, all: &[Incoming], [sun, eye]: [&Vector3<f64>; 2]) {
        for Incoming { at, towards, normal, form_factor } in all {
            let sun = local(sun, normal);
            let [from, eye] = [towards, eye].map(|direction| local(direction, &at.normal));
            self.twice.push((row, at.share * form_factor * sun.z.max(0.0)));
            self.at_patch.extend([Angles::new(&sun, &local(&-towards, normal))]);
            self.next_at_point.extend([Angles::new(&from, &eye)]);
        }
    }

    /// Radiance beyond that of a Lambertian sheet, relative to that of a perfect diffuser facing the sun:
    /// row by power of the albedo.
    fn departures(&self, shape: &Shape) -> Array2<f64> {
        let mut sums = Array2::zeros((self.rows, POWERS));
        let mut add = |row: usize, weight: f64, powers: [f64; POWERS]| {
            sums.row_mut(row).iter_mut().zip(powers).for_each(|(sum, power)| *sum += weight * power);
        };
        let [body, surface] = shape.at_each(&self.at_point);
        for (n, (row, lit)) in self.once.iter().enumerate() {
            let mut once = shape.once([body[n], surface[n]]);
            once[1] -= FRAC_1_PI;
            add(*row, PI * lit, once);
        }
        let [body, surface] = shape.at_each(&self.at_patch);
        let [next_body, next_surface] = shape.at_each(&self.next_at_point);
        let mut of_rows = vec![Twice::default(); self.rows];
        for (n, (row, lit)) in self.twice.iter().enumerate() {
            of_rows[*row].add(*lit, [body[n], surface[n]], [next_body[n], next_surface[n]]);
        }
        for (row, sums) in of_rows.iter().enumerate() {
            let mut twice = shape.twice(sums);
            twice[2] -= FRAC_1_PI * FRAC_1_PI * sums.weight();
            add(row, PI * PI, twice);
        }
        sums
    }
}

/// A direction in the coordinates of a part of the sheet, with z along its normal, which lies across the
/// crease.
fn local(direction: &Vector3<f64>, normal: &Vector2<f64>) -> Vector3<f64> {
    let (x, z) = (direction.x, direction.z);
    Vector3::new(x * normal.y - z * normal.x, direction.y, x * normal.x + z * normal.y)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use nalgebra::Point3;

    use super::*;
    use crate::geometry::FacetGrid;
    use crate::kernel::bent::View;
    use crate::sheet::Family;
    use crate::transport::departures;

    fn fold() -> Fold {
        Fold::new(48.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 5 }).unwrap()
    }

    fn sun(tilt_deg: f64) -> Vector3<f64> {
        let (sin, cos) = tilt_deg.to_radians().sin_cos();
        Vector3::new(sin, 0.0, cos)
    }

    fn glossy() -> Shape {
        Shape::from(Family {
            specular_weight: 0.6,
            roughness: 0.42,
            body_roughness_deg: 15.0,
            ..Family::default()
        })
    }

    #[test]
    fn a_lambertian_sheet_departs_by_nothing() {
        let eye = Vector3::new(0.1, 0.2, 1.0).normalize();
        let bends = Bends::of(&fold(), View::from(eye));
        let changes = Reflections::of(&fold(), &bends, sun(2.0)).changes(&Shape::lambertian());
        assert!(changes.iter().all(|change| change.abs() < 1e-12));
    }

    /// Against folds in suns that stand elsewhere, with all reflections, in the columns at the middle.
    #[test]
    fn a_sun_elsewhere_is_that_of_the_fold_in_it() {
        let eye = Vector3::new(0.1, 0.05, 1.0).normalize();
        let bends = Bends::of(&fold(), View::from(eye));
        let changes = Reflections::of(&fold(), &bends, sun(0.0)).changes(&glossy());
        let albedo: f64 = 0.3;
        let of_sun =
            |tilt_deg| departures(&fold(), &sun(tilt_deg), &Point3::from(1e3 * eye), &[glossy()], &[albedo]);
        let [low, high] = [-1.0, 1.0].map(of_sun);
        for facet in (2..100).step_by(5) {
            let want = 0.5 * (high[[0, facet, 0]] - low[[0, facet, 0]]);
            let got: f64 =
                (0..POWERS).map(|n| changes[[facet, 3 * POWERS + n]] * albedo.powi(n as i32)).sum();
            let most = if facet % 50 < 10 { 5e-4 } else { 1.2e-4 };
            assert!((got - want).abs() < most, "{facet}: {got} for {want}");
        }
    }
}
