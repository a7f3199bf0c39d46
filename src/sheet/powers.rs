//! Light reflected once or twice by a sheet, as powers of its albedo.

use std::f64::consts::FRAC_1_PI;

use super::Shape;

/// Number of powers, from 0 on: of light reflected twice at most.
pub const POWERS: usize = 5;

/// Sums over paths of light with two reflections, each with its weight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twice {
    /// Of the products of both bodies, of one's body and the other's surface, and of both surfaces.
    products: [f64; 3],
    /// Of both bodies, and of both surfaces.
    sums: [f64; 2],
    /// Of the weights.
    weight: f64,
}

impl Twice {
    /// Adds a path of this weight, with body and surface of both reflections.
    #[inline(always)]
    pub fn add(&mut self, weight: f64, [body, surface]: [f64; 2], [next_body, next_surface]: [f64; 2]) {
        self.products[0] += weight * (body * next_body);
        self.products[1] += weight * (body * next_surface + surface * next_body);
        self.products[2] += weight * (surface * next_surface);
        self.sums[0] += weight * (body + next_body);
        self.sums[1] += weight * (surface + next_surface);
        self.weight += weight;
    }

    /// Sum of the weights.
    #[must_use]
    pub fn weight(&self) -> f64 {
        self.weight
    }
}

impl Shape {
    /// One reflection, of which body and surface are given: factors of the [powers](POWERS) of the albedo.
    ///
    /// # Example
    /// ```
    /// use vfold::sheet::{Angles, Family, Shape};
    /// let shape = Shape::from(Family { specular_weight: 0.5, roughness: 0.4, ..Family::default() });
    /// let angles = Angles::instrument();
    /// let [none, one, ..] = shape.once(shape.at(&angles));
    /// assert!((none + one * 0.3 - shape.brdf(0.3, &angles)).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn once(&self, [body, surface]: [f64; 2]) -> [f64; POWERS] {
        let [of_body, level] = self.weight_powers();
        let mut powers = [0.0; POWERS];
        for (power, (of_body, level)) in powers.iter_mut().zip(of_body.iter().zip(level)) {
            *power = of_body * body + level;
        }
        powers[0] += surface;
        powers
    }

    /// Two reflections along many paths: factors of the [powers](POWERS) of the albedo.
    ///
    /// # Example
    /// ```
    /// use vfold::sheet::{Shape, Twice};
    /// let mut path = Twice::default();
    /// path.add(1.0, [1.0, 0.0], [1.0, 0.0]);
    /// assert_eq!(Shape::lambertian().twice(&path), [0.0, 0.0, 1.0, 0.0, 0.0]);
    /// ```
    #[must_use]
    pub fn twice(&self, Twice { products, sums, weight }: &Twice) -> [f64; POWERS] {
        let [of_body, level] = self.weight_powers();
        let mut powers = [0.0; POWERS];
        for (n, (body, level_n)) in of_body.iter().zip(level).enumerate() {
            powers[n] += body * products[1] + level_n * sums[1];
            for (m, (next_body, level_m)) in of_body.iter().zip(level).enumerate() {
                let of_levels = level_m * (body * sums[0] + level_n * weight);
                powers[n + m] += body * next_body * products[0] + of_levels;
            }
        }
        powers[0] += products[2];
        powers
    }

    /// The [`Shape::weights`]: factors of the first three powers of the albedo.
    fn weight_powers(&self) -> [[f64; 3]; 2] {
        let [slope, offset] = self.slope_and_offset();
        let level =
            [offset * offset, 2.0 * offset * slope, slope * slope].map(|square| self.levelling * square);
        let of_body = [offset - level[0], slope - level[1], -level[2]];
        [of_body, level.map(|level| FRAC_1_PI * level)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::{AngleList, Angles, measured};

    /// Of every measured sheet, felts among them.
    #[test]
    fn powers_of_the_albedo_give_what_is_reflected() {
        let [first, next] = [[0.6, 0.0, 0.8], [-0.48, 0.36, 0.8]].map(nalgebra::Vector3::from);
        let angles = [Angles::instrument(), Angles::new(&first, &next)];
        let list: AngleList = angles.iter().copied().collect();
        for (shape, albedo) in measured().unwrap().iter().zip([0.1_f64, 0.5, 0.9].into_iter().cycle()) {
            let [body, surface] = shape.at_each(&list);
            let brdf = angles.each_ref().map(|angles| shape.brdf(albedo, angles));
            let sum = |powers: [f64; POWERS]| -> f64 {
                (0..).zip(powers).map(|(power, factor)| factor * albedo.powi(power)).sum()
            };
            let once = sum(shape.once([body[1], surface[1]]));
            assert!((once - brdf[1]).abs() < 1e-12, "{once} {brdf:?}");
            let mut paths = Twice::default();
            paths.add(0.3, [body[0], surface[0]], [body[1], surface[1]]);
            paths.add(0.2, [body[1], surface[1]], [body[1], surface[1]]);
            let (twice, want) = (sum(shape.twice(&paths)), 0.3 * brdf[0] * brdf[1] + 0.2 * brdf[1] * brdf[1]);
            assert!((twice - want).abs() < 1e-12, "{twice} {want}");
        }
    }
}
