//! The reflection of a sheet: a coloured body and a colourless surface, each with its own angular shape.
//!
//! `f = ρ(1 − κρ) · B + κρ²/π + S`, 1/sr, where `ρ` is the sheet's 45°:0° reflectance factor in a waveband,
//! as a spectrophotometer measures it, `B` the body, normalised to `π·B = 1` at 45°:0°, and `S` the surface,
//! 0 there. Between upright fibres, bright felt scatters light so often that it leaves equally in all
//! directions, dark felt does not: κ is how much of the body that levels at a reflectance of 1, and 0 for
//! other sheets.
//!
//! The sheet's albedo `a`, which transport between panels depends on most, is `ρ = (a − s)/b` with the
//! bihemispherical albedos `b` of body and `s` of surface (averages over cosine-weighted directions of
//! incidence and exit); of bright felt it leaves out the levelling.

mod angles;
mod family;
mod fresnel;
mod measured;
mod place;
mod powers;
mod table;

use std::f64::consts::{FRAC_1_PI, PI};
use std::sync::LazyLock;

use nalgebra::Vector3;
use pulp::Arch;

use crate::kernel::quadrature::Rule;

pub use angles::{AngleList, Angles};
pub use family::Family;
use family::Terms;
pub use measured::{measured, measured_names};
pub use powers::{POWERS, Twice};
use table::Table;

/// Quadrature nodes in the cosines and the azimuth for albedos.
const COSINES: usize = 20;
const AZIMUTHS: usize = 16;

/// The angular shape of a sheet's reflection, independent of its colour.
#[derive(Clone, Debug)]
pub struct Shape {
    parts: Parts,
    /// Body and surface at 45:0 before normalisation, times π.
    instrument: [f64; 2],
    /// Albedos of the normalised body and surface.
    albedos: [f64; 2],
    /// κ: how much of the body light scattered often levels at a reflectance of 1.
    levelling: f64,
}

/// The source of body and surface.
#[derive(Clone, Debug)]
enum Parts {
    Family(Terms),
    Table(Table),
}

impl From<Family> for Shape {
    fn from(family: Family) -> Self {
        let Family { body_roughness_deg, specular_weight, sheen, .. } = family;
        if [body_roughness_deg, specular_weight, sheen].iter().all(|effect| effect.abs() <= 0.0) {
            return Self::lambertian();
        }
        Self::of(Parts::Family(Terms::new(family)), 0.0)
    }
}

impl Shape {
    /// The shape of a perfectly matte sheet.
    #[must_use]
    pub fn lambertian() -> Self {
        Self {
            parts: Parts::Family(Terms::new(Family::default())),
            instrument: [1.0, 0.0],
            albedos: [1.0, 0.0],
            levelling: 0.0,
        }
    }

    fn of(parts: Parts, levelling: f64) -> Self {
        let instrument = parts.at(&Angles::instrument()).map(|value| PI * value);
        let mut shape = Self { parts, instrument, albedos: [1.0, 0.0], levelling };
        shape.albedos = shape.at_each(&HEMISPHERES.0).map(|reflections| bihemispherical(&reflections));
        shape
    }

    /// Body and surface, 1/sr: `π·B` is 1 and `S` is 0 at 45°:0°.
    ///
    /// # Example
    /// ```
    /// use vfold::sheet::{Angles, Family, Shape};
    /// let shape = Shape::from(Family { specular_weight: 0.5, roughness: 0.4, ..Family::default() });
    /// let [body, surface] = shape.at(&Angles::instrument());
    /// assert!((std::f64::consts::PI * body - 1.0).abs() < 1e-12 && surface.abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn at(&self, angles: &Angles) -> [f64; 2] {
        let [body, surface] = self.parts.at(angles);
        let body = body / self.instrument[0];
        [body, surface - self.instrument[1] * body]
    }

    /// Body and surface for each of many pairs of directions, as [`Shape::at`] returns them, several at once.
    ///
    /// # Example
    /// ```
    /// use vfold::sheet::{AngleList, Angles, Family, Shape};
    /// let shape = Shape::from(Family { specular_weight: 0.5, roughness: 0.4, ..Family::default() });
    /// let [body, surface] = shape.at_each(&AngleList::from_iter([Angles::instrument(); 3]));
    /// assert!((std::f64::consts::PI * body[2] - 1.0).abs() < 1e-12 && surface[2].abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn at_each(&self, angles: &AngleList) -> [Vec<f64>; 2] {
        let [mut bodies, mut surfaces] = self.parts.at_each(angles);
        let [of_body, of_surface] = self.instrument;
        let scale = 1.0 / of_body;
        Arch::new().dispatch(|| {
            for (body, surface) in bodies.iter_mut().zip(&mut surfaces) {
                *body *= scale;
                *surface -= of_surface * *body;
            }
        });
        [bodies, surfaces]
    }

    /// The 45°:0° reflectance factor of a sheet of this albedo.
    ///
    /// # Example
    /// ```
    /// use vfold::sheet::{Family, Shape};
    /// assert!((Shape::from(Family::default()).reflectance_factor_45_0(0.3) - 0.3).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn reflectance_factor_45_0(&self, albedo: f64) -> f64 {
        let [slope, offset] = self.slope_and_offset();
        slope * albedo + offset
    }

    /// Slope and offset of the 45°:0° reflectance factor as a function of the albedo.
    #[must_use]
    pub fn slope_and_offset(&self) -> [f64; 2] {
        let [body, surface] = self.albedos;
        [1.0 / body, -surface / body]
    }

    /// BRDF of a sheet of this albedo, 1/sr.
    #[must_use]
    pub fn brdf(&self, albedo: f64, angles: &Angles) -> f64 {
        let [body, surface] = self.at(angles);
        let [of_body, level] = self.weights(albedo);
        of_body * body + level + surface
    }

    /// Weight of the body in a sheet of this albedo, and what it reflects equally in all directions, 1/sr.
    ///
    /// # Example
    /// ```
    /// assert_eq!(vfold::sheet::Shape::lambertian().weights(0.3), [0.3, 0.0]);
    /// ```
    #[must_use]
    pub fn weights(&self, albedo: f64) -> [f64; 2] {
        let reflectance = self.reflectance_factor_45_0(albedo);
        let level = self.levelling * reflectance * reflectance;
        [reflectance - level, FRAC_1_PI * level]
    }
}

impl Parts {
    fn at(&self, angles: &Angles) -> [f64; 2] {
        match self {
            Self::Family(terms) => terms.at(angles),
            Self::Table(table) => table.at(&angles.place),
        }
    }

    fn at_each(&self, angles: &AngleList) -> [Vec<f64>; 2] {
        match self {
            Self::Family(terms) => terms.at_each(angles),
            Self::Table(table) => table.at_each(angles),
        }
    }
}

/// Albedo of a reflection, given for all [`HEMISPHERES`]: the average over cosine-weighted incidence and
/// exit.
fn bihemispherical(reflections: &[f64]) -> f64 {
    reflections.iter().zip(&HEMISPHERES.1).map(|(value, weight)| weight * value).sum()
}

/// All pairs of directions of incidence and exit, with their weights in the albedo.
static HEMISPHERES: LazyLock<(AngleList, Vec<f64>)> = LazyLock::new(|| {
    let rule = Rule::gauss_legendre(COSINES);
    // in the square of the cosine the weight is constant
    let cosines: Vec<(f64, f64)> =
        rule.on(0.0, 1.0).map(|(square, weight)| (square.sqrt(), weight)).collect();
    let azimuths: Vec<f64> = (0..AZIMUTHS).map(|k| PI * (k as f64 + 0.5) / AZIMUTHS as f64).collect();
    let direction = |cos: f64, azimuth: f64| {
        let sin = (1.0 - cos * cos).sqrt();
        Vector3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos)
    };
    let mut all = Vec::with_capacity(COSINES * (COSINES + 1) / 2 * AZIMUTHS);
    for (n, &(cos_in, weight_in)) in cosines.iter().enumerate() {
        let from = direction(cos_in, 0.0);
        // by reciprocity half of the pairs suffice
        for (m, &(cos_out, weight_out)) in cosines[..=n].iter().enumerate() {
            let pairs = if m == n { 1.0 } else { 2.0 };
            let weight = pairs * weight_in * weight_out * PI / AZIMUTHS as f64;
            let pair = |azimuth: &f64| (Angles::new(&from, &direction(cos_out, *azimuth)), weight);
            all.extend(azimuths.iter().map(pair));
        }
    }
    all.into_iter().unzip()
});

#[cfg(test)]
mod tests {
    use super::*;

    fn families() -> Vec<Family> {
        let mut families = vec![Family::default(), Family { sheen: 0.5, ..Family::default() }];
        for body_roughness_deg in [0.0, 15.0, 30.0] {
            for (specular_weight, roughness) in [(0.3, 0.3), (0.5, 0.4), (1.0, 0.6)] {
                families.push(Family { body_roughness_deg, specular_weight, roughness, sheen: 0.0 });
            }
        }
        families
    }

    #[test]
    fn light_goes_both_ways_alike() {
        let directions = [[0.3, 0.1, 0.9], [-0.8, 0.3, 0.4], [0.1, -0.95, 0.1], [0.0, 0.0, 1.0]];
        let directions = directions.map(|d| Vector3::from(d).normalize());
        for shape in families().into_iter().map(Shape::from).chain(measured().unwrap().iter().cloned()) {
            for (from, to) in directions.iter().flat_map(|a| directions.iter().map(move |b| (a, b))) {
                let [there, back] =
                    [shape.at(&Angles::new(from, to)), shape.at(&Angles::new(to, from))].map(|v| v[0] + v[1]);
                assert!((there - back).abs() < 1e-6 * (1.0 + there.abs()), "{there} {back}");
            }
        }
    }

    #[test]
    fn many_pairs_of_directions_are_reflected_as_one() {
        let directions =
            [[0.3, 0.1, 0.9], [-0.8, 0.3, 0.4], [0.1, -0.95, 0.1], [0.0, 0.0, 1.0], [0.6, 0.0, 0.8]];
        let directions = directions.map(|d| Vector3::from(d).normalize());
        let pairs = directions.iter().flat_map(|a| directions.iter().map(move |b| Angles::new(a, b)));
        let pairs: Vec<Angles> = pairs.collect();
        let list: AngleList = pairs.iter().copied().collect();
        let matt = Shape::lambertian();
        for shape in
            families().into_iter().map(Shape::from).chain(measured().unwrap().iter().cloned()).chain([matt])
        {
            let [body, surface] = shape.at_each(&list);
            for (n, pair) in pairs.iter().enumerate() {
                let one = shape.at(pair);
                assert!((body[n] - one[0]).abs() < 1e-12 * (1.0 + one[0].abs()), "{shape:?} {pair:?}");
                assert!((surface[n] - one[1]).abs() < 1e-12 * (1.0 + one[1].abs()), "{shape:?} {pair:?}");
            }
        }
    }

    /// The bihemispherical albedo is the one asked for, and from no direction is more light reflected than
    /// arrives (except by sheen).
    #[test]
    fn albedos_are_what_is_asked_for() {
        for family in families() {
            let shape = Shape::from(family);
            for albedo in [0.1, 0.5, 0.9] {
                let fine = 48;
                let rule = Rule::gauss_legendre(fine);
                let mut sum = 0.0;
                for (square_in, weight_in) in rule.on(0.0, 1.0) {
                    let mut lit = 0.0;
                    let from = Vector3::new((1.0 - square_in).sqrt(), 0.0, square_in.sqrt());
                    for (square, weight) in rule.on(0.0, 1.0) {
                        for k in 0..fine {
                            let (y, x) = (PI * (k as f64 + 0.5) / fine as f64).sin_cos();
                            let sin = (1.0 - square).sqrt();
                            let to = Vector3::new(sin * x, sin * y, square.sqrt());
                            lit += weight * PI / fine as f64 * shape.brdf(albedo, &Angles::new(&from, &to));
                        }
                    }
                    sum += weight_in * lit;
                    assert!(
                        lit > 0.0 && (lit < 1.0 || family.sheen > 0.0),
                        "{family:?} {albedo} {square_in}: {lit}"
                    );
                }
                assert!((sum - albedo).abs() < 2e-3, "{family:?}: {sum} for {albedo}");
            }
        }
    }
}
