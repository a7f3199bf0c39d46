//! Light of surroundings that are not alike in all directions on an ideal fold: sky, ground, and the glow about the sun.
//!
//! Radiances are summed over directions; the opposite panel hides some, and what the panels get is bounced between them as in
//! [`super::bent`].

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Vector3;
use ndarray::Array2;

use crate::error::Result;
use crate::geometry::Fold;
use crate::kernel::quadrature::Rule;

use super::bent::{BentExchange, BentFold};

/// Directions from the horizon to the pole, and around it.
const DIRECTIONS: [usize; 2] = [12, 48];

/// One part of the surroundings, which `up` parts into an upper and a lower half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surroundings {
    /// Alike from everywhere above the horizon: irradiance 1 on a horizontal plane that faces up.
    Sky,
    /// Alike from everywhere below the horizon: irradiance 1 on a horizontal plane that faces down.
    Ground,
    /// A clear sky, irradiance 1 on a horizontal plane that faces up: the CIE standard general sky of type 12 (CIE S 011/E:2003).
    ClearSky {
        /// Unit vector to the sun, above the horizon.
        sun: Vector3<f64>,
    },
    /// What a clear sky has more about the sun than far from it, irradiance 1 on a horizontal plane that faces up.
    Glow {
        /// Unit vector to the sun, above the horizon.
        sun: Vector3<f64>,
    },
}

impl Surroundings {
    /// Relative radiance from a direction whose cosine with the zenith (the nadir for the ground) is `height`.
    fn radiance(self, towards: &Vector3<f64>, height: f64) -> f64 {
        // CIE S 011/E:2003, type 12: a -1, b -0.32, c 10, d -3, e 0.45
        let gradation = 1.0 - (-0.32 / height).exp();
        let glow = |sun: Vector3<f64>| {
            let cos = towards.dot(&sun).clamp(-1.0, 1.0);
            10.0 * ((-3.0 * cos.acos()).exp() - (-3.0 * FRAC_PI_2).exp()) + 0.45 * cos * cos
        };
        match self {
            Self::Sky | Self::Ground => 1.0,
            Self::ClearSky { sun } => gradation * (1.0 + glow(sun)),
            Self::Glow { sun } => gradation * glow(sun).max(0.0),
        }
    }
}

/// One part of the surroundings as directions that share its light.
pub struct Environment {
    /// Unit vectors towards the light, with irradiance on a plane that faces them.
    rays: Vec<(Vector3<f64>, f64)>,
}

impl Environment {
    /// The light of `part`, where the unit vector `up` points to the zenith in the coordinates of [`Fold::panels`].
    #[must_use]
    pub fn new(part: Surroundings, up: Vector3<f64>) -> Self {
        let side = if part == Surroundings::Ground { -1.0 } else { 1.0 };
        let pole = side * up;
        let east = pole.cross(&if pole.x.abs() < 0.7 { Vector3::x() } else { Vector3::y() }).normalize();
        let north = pole.cross(&east);
        let [heights, around] = DIRECTIONS;
        // Even in the square of the sine, so that every ray has the same share of an even light's horizontal irradiance.
        let heights = Rule::gauss_legendre(heights);
        let mut rays = Vec::with_capacity(DIRECTIONS.iter().product());
        for (square, weight) in heights.on(0.0, 1.0) {
            let (height, spread) = ((1.0 - square).sqrt(), square.sqrt());
            for n in 0..around {
                let (sin, cos) = (TAU * (n as f64 + 0.5) / around as f64).sin_cos();
                let towards = height * pole + spread * (cos * east + sin * north);
                rays.push((towards, part.radiance(&towards, height) * weight / height));
            }
        }
        let horizontal: f64 = rays.iter().map(|(towards, irradiance)| irradiance * towards.dot(&pole)).sum();
        rays.iter_mut().for_each(|(_, irradiance)| *irradiance /= horizontal);
        Self { rays }
    }

    /// Irradiance of an open plane with this unit normal.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use vfold::kernel::environment::{Environment, Surroundings};
    /// let sky = Environment::new(Surroundings::Sky, Vector3::z());
    /// assert!((sky.on_plane(Vector3::x()) - 0.5).abs() < 0.05); // an upright plane sees about half of it
    /// ```
    #[must_use]
    pub fn on_plane(&self, normal: Vector3<f64>) -> f64 {
        self.rays.iter().map(|(towards, irradiance)| irradiance * towards.dot(&normal).max(0.0)).sum()
    }

    /// Radiance of the facets of an ideal fold in this light, all bounces included: in the unit in which a perfect diffuser with
    /// irradiance 1 has 1.
    ///
    /// # Returns
    /// Facet by albedo, as [`BentFold::facet_radiance`].
    ///
    /// # Errors
    /// [`crate::Error::Numeric`] if light does not leave the fold.
    pub fn facet_radiance(&self, fold: &Fold, albedos: &[f64]) -> Result<Array2<f64>> {
        let (rows, cols) = (fold.facets().rows, fold.facets().cols);
        let half = cols.div_ceil(2);
        let facets = facet_places(fold);
        let direct: Vec<f64> =
            facets.iter().map(|[place, normal]| self.on_sheet(*place, *normal, fold)).collect();
        let mut radiance = Array2::from_shape_fn((facets.len(), albedos.len()), |(facet, node)| {
            albedos[node] * direct[facet]
        });
        for image in [1.0, -1.0] {
            let exchange =
                BentExchange::of_light(&BentFold::ideal(fold.angle_deg()), fold, Vector3::z(), image);
            let on_patch = |[place, normal]: [Vector3<f64>; 2]| {
                let mirrored = Vector3::new(place.x, -place.y, place.z);
                0.5 * (self.on_sheet(place, normal, fold) + image * self.on_sheet(mirrored, normal, fold))
            };
            let patches: Vec<f64> = exchange.places(fold.width()).map(on_patch).collect();
            for (node, albedo) in albedos.iter().enumerate() {
                let bounced = exchange.bounced(&patches, *albedo)?;
                for (n, row) in (0..2 * rows).flat_map(|row| (0..cols).map(move |col| (col, row))) {
                    let mirror = cols - 1 - n;
                    let sign = if n <= mirror { 1.0 } else { image };
                    radiance[(row * cols + n, node)] += albedo * sign * bounced[row * half + n.min(mirror)];
                }
            }
        }
        Ok(radiance)
    }

    /// Irradiance of a place on the fold past the other panel.
    fn on_sheet(&self, place: Vector3<f64>, normal: Vector3<f64>, fold: &Fold) -> f64 {
        let other = usize::from(normal.x > 0.0);
        let (sin, cos) = (fold.angle_rad() / 2.0).sin_cos();
        let side = if other == 0 { -1.0 } else { 1.0 };
        let (out, facing) = (Vector3::new(side * sin, 0.0, cos), Vector3::new(-side * cos, 0.0, sin));
        let height = facing.dot(&place);
        let seen = |towards: &Vector3<f64>| {
            let approach = -facing.dot(towards);
            if approach <= 0.0 {
                return true;
            }
            let met = place + towards * (height / approach);
            !((0.0..=fold.depths()[other]).contains(&out.dot(&met)) && met.y.abs() <= 0.5 * fold.width())
        };
        let lit = self.rays.iter().map(|(towards, irradiance)| (towards, irradiance * towards.dot(&normal)));
        lit.filter(|(towards, irradiance)| *irradiance > 0.0 && seen(towards))
            .map(|(_, irradiance)| irradiance)
            .sum()
    }
}

/// Middles of the facets with their normals.
fn facet_places(fold: &Fold) -> Vec<[Vector3<f64>; 2]> {
    let (sin, cos) = (fold.angle_rad() / 2.0).sin_cos();
    let cols = fold.facets().cols;
    let mut places = Vec::with_capacity(2 * fold.facets().len());
    for (side, edges) in [-1.0, 1.0].into_iter().zip(fold.row_edges()) {
        for row in edges.windows(2) {
            let out = 0.5 * (row[0] + row[1]) * Vector3::new(side * sin, 0.0, cos);
            let along = |col: usize| ((col as f64 + 0.5) / cols as f64 - 0.5) * fold.width() * Vector3::y();
            places.extend((0..cols).map(|col| [out + along(col), Vector3::new(-side * cos, 0.0, sin)]));
        }
    }
    places
}
