//! Light reflected once or twice, at points of both panels.
//!
//! A direction at a point is given by the angle ψ in the plane across the crease, from the perpendicular to
//! the other panel, and by the sine v of the angle out of that plane: `dω = dψ dv`, and the cosine of
//! incidence is `√(1 − v²) cos(ψ − θ)` in a fold opened by θ. As the sun is distant, the light along a
//! direction depends only on that direction, so Gauss rules in ψ and v converge fast at every point, even at
//! the crease.

use std::f64::consts::{FRAC_1_PI, PI};

use nalgebra::Vector3;
use ndarray::Array2;

use super::frame::Frame;
use super::pooling::Pooling;
use crate::geometry::Fold;
use crate::kernel::quadrature::Rule;
use crate::sheet::{AngleList, Angles, POWERS, Shape, Twice};

/// Numbers of points and directions.
#[derive(Clone, Copy)]
struct Orders {
    /// Points of a panel, away from the crease and along it.
    points: [usize; 2],
    /// Directions at each point, across the crease and along it.
    directions: [usize; 2],
}

/// Finer orders change facets of all but the glossiest sheets by a few thousandths.
const ORDERS: Orders = Orders { points: [8, 6], directions: [8, 10] };

/// The points of both panels, with all directions of light that reaches the eye by one or two reflections.
pub struct Points {
    /// Irradiance from the sun of each point's panel and of the other.
    lit: Vec<[f64; 2]>,
    /// From the sun to the eye, by point.
    from_sun: AngleList,
    /// All paths of light with two reflections, by point, each with as many.
    paths: Paths,
    pooling: Pooling,
}

/// Paths of light with two reflections.
#[derive(Default)]
struct Paths {
    /// Reflection by the other panel, and then at the point.
    at_other: AngleList,
    at_point: AngleList,
    /// Cosine of incidence times solid angle.
    weights: Vec<f64>,
}

impl Points {
    /// The points of `fold`, with sun and eye taken from the frames.
    pub(super) fn new(fold: &Fold, frames: &[Frame; 2]) -> Self {
        Self::with(ORDERS, fold, frames)
    }

    fn with(Orders { points, directions }: Orders, fold: &Fold, frames: &[Frame; 2]) -> Self {
        let shares =
            |order: usize| Rule::gauss_legendre(order).on(0.0, 1.0).map(|(x, _)| x).collect::<Vec<_>>();
        let [out, along] = points.map(shares);
        let rules = directions.map(Rule::gauss_legendre);
        let count = 2 * out.len() * along.len();
        let (mut lit, mut from_sun) = (Vec::with_capacity(count), AngleList::default());
        let mut paths = Paths::default();
        for (here, other) in [(&frames[0], &frames[1]), (&frames[1], &frames[0])] {
            for place in out.iter().flat_map(|out| along.iter().map(move |along| (out, along))) {
                let place = [place.0 * here.depth, (place.1 - 0.5) * here.width];
                let to_eye = here.to_eye(place);
                lit.push([here.lit(), other.lit()]);
                from_sun.extend([Angles::new(&here.sun, &to_eye)]);
                if !fold.is_flat() {
                    paths.add(here, other, place, &to_eye, &rules);
                }
            }
        }
        let pooling = Pooling::smooth(fold, &out, &along);
        Self { lit, from_sun, paths, pooling }
    }

    /// Radiance towards the eye minus that of a Lambertian sheet: point by power of the albedo.
    #[must_use]
    pub fn departures(&self, shape: &Shape) -> Array2<f64> {
        let mut departures = Array2::zeros((self.lit.len(), POWERS));
        let [body, surface] = shape.at_each(&self.from_sun);
        let twice = self.paths.twice(shape, self.lit.len());
        for (point, (mut row, lit)) in departures.outer_iter_mut().zip(&self.lit).enumerate() {
            let (mut once, (mut twice, of_matt)) = (shape.once([body[point], surface[point]]), twice[point]);
            once[1] -= FRAC_1_PI;
            twice[2] -= of_matt;
            for (value, (once, twice)) in row.iter_mut().zip(once.iter().zip(twice)) {
                *value = PI * (lit[0] * once + lit[1] * twice);
            }
        }
        departures
    }

    /// Facet means.
    #[must_use]
    pub fn pooled(&self, of_points: &Array2<f64>) -> Array2<f64> {
        self.pooling.pool(of_points)
    }
}

impl Paths {
    /// Adds all directions from which light of the `other` panel reaches a point.
    fn add(
        &mut self,
        here: &Frame,
        other: &Frame,
        [out, along]: [f64; 2],
        to_eye: &Vector3<f64>,
        [across, sideways]: &[Rule; 2],
    ) {
        let Frame { sin, cos, .. } = *here;
        let opening = sin.atan2(cos);
        // from the crease to the outer edge of the other panel
        let edge = ((here.other_depth / out - cos) / sin).atan();
        for (psi, weight_across) in across.on(opening - 0.5 * PI, edge) {
            let away = out * sin / psi.cos();
            let [low, high] =
                [-0.5, 0.5].map(|end| end * here.width - along).map(|end| end / end.hypot(away));
            for (side, weight) in sideways.on(low, high) {
                let flat = (1.0 - side * side).sqrt();
                let (slope, cosine) = (psi - opening).sin_cos();
                let from = Vector3::new(flat * slope, side, flat * cosine);
                let back = Vector3::new(-flat * psi.sin(), -side, flat * psi.cos());
                self.at_other.extend([Angles::new(&other.sun, &back)]);
                self.at_point.extend([Angles::new(&from, to_eye)]);
                self.weights.push(weight_across * weight * flat * cosine);
            }
        }
    }

    /// Doubly reflected light per π times the other panel's irradiance, at each of the points, by power of
    /// the albedo; and that of a Lambertian sheet of albedo 1.
    fn twice(&self, shape: &Shape, points: usize) -> Vec<([f64; POWERS], f64)> {
        let [body, surface] = shape.at_each(&self.at_other);
        let [next_body, next_surface] = shape.at_each(&self.at_point);
        let of_point = self.weights.len() / points;
        let twice = |point: usize| {
            let mut sums = Twice::default();
            for n in point * of_point..(point + 1) * of_point {
                sums.add(self.weights[n], [body[n], surface[n]], [next_body[n], next_surface[n]]);
            }
            (shape.twice(&sums), FRAC_1_PI * FRAC_1_PI * sums.weight())
        };
        (0..points).map(twice).collect()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;
    use ndarray::arr1;

    use super::*;
    use crate::geometry::FacetGrid;
    use crate::sheet::Family;

    #[test]
    fn finer_points_change_little() {
        let rough = Family { body_roughness_deg: 25.0, ..Family::default() };
        let glossy = [(0.4, 0.28), (1.0, 0.42), (0.4, 0.65)];
        let glossy = glossy.map(|(specular_weight, roughness)| Family {
            specular_weight,
            roughness,
            ..Family::default()
        });
        for (angle_deg, sun, eye) in [
            (48.0, [0.0, 0.0, 1.0], [1.0, 1.1, 8.4]),
            (70.0, [0.05, 0.0, 1.0], [-2.5, 1.1, 8.4]),
            (40.0, [0.0, 0.1, 1.0], [1.0, 2.6, 6.4]),
        ] {
            let fold = Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 }).unwrap();
            let frames =
                [0, 1].map(|panel| Frame::new(&fold, panel, &Vector3::from(sun), &Point3::from(eye)));
            let fine = Orders { points: [14, 10], directions: [20, 20] };
            let [few, many] = [ORDERS, fine].map(|orders| Points::with(orders, &fold, &frames));
            for (family, bound) in glossy.into_iter().zip([3e-3; 3]).chain([(rough, 1e-3)]) {
                let [a, b] = [&few, &many].map(|points| {
                    let powers = arr1(&[1.0, 0.4, 0.16, 0.064, 0.0256]);
                    points.pooled(&points.departures(&family.into())).dot(&powers)
                });
                let rms = ((&a - &b).pow2().sum() / a.len() as f64).sqrt();
                assert!(rms < bound * 0.4, "{angle_deg}° {family:?}: {rms:.1e}");
            }
        }
    }
}
