//! Standard skies: the distribution of sky radiance for different amounts of cloud and haze.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// One of the fifteen standard general skies: 1 to 5 are overcast, 6 to 10 partly cloudy, 11 to 15 clear.
///
/// # Source
/// CIE S 011/E:2003, *Spatial distribution of daylight: CIE standard general sky*, table 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StandardSky {
    number: usize,
}

/// Gradation of radiance from horizon to zenith: a and b.
const GRADATIONS: [[f64; 2]; 6] =
    [[4.0, -0.70], [1.1, -0.8], [0.0, -1.0], [-1.0, -0.55], [-1.0, -0.32], [-1.0, -0.15]];
/// Indicatrix, the change of radiance with the distance from the sun: c, d and e.
const INDICATRICES: [[f64; 3]; 6] = [
    [0.0, -1.0, 0.0],
    [2.0, -1.5, 0.15],
    [5.0, -2.5, 0.30],
    [10.0, -3.0, 0.45],
    [16.0, -3.0, 0.30],
    [24.0, -2.8, 0.15],
];
/// Indices of gradation and indicatrix for each type.
const TYPES: [[usize; 2]; 15] = [
    [0, 0],
    [0, 1],
    [1, 0],
    [1, 1],
    [2, 0],
    [2, 1],
    [2, 2],
    [2, 3],
    [3, 1],
    [3, 2],
    [3, 3],
    [4, 3],
    [4, 4],
    [5, 4],
    [5, 5],
];

/// Last of the overcast types.
const LAST_OVERCAST: usize = 5;

/// Numerical integration over height and azimuth: the error is less than 1e-4.
const HEIGHTS: usize = 128;
const AZIMUTHS: usize = 96;

impl StandardSky {
    /// A clear sky of low turbidity: type 12.
    pub const CLEAR: Self = Self { number: 12 };

    /// The sky of this type, 1 to 15; `None` for other numbers.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::StandardSky;
    /// assert_eq!(StandardSky::of_type(12), Some(StandardSky::CLEAR));
    /// assert_eq!(StandardSky::of_type(16), None);
    /// ```
    #[must_use]
    pub fn of_type(number: usize) -> Option<Self> {
        (1..=TYPES.len()).contains(&number).then_some(Self { number })
    }

    /// Number of its type, 1 to 15.
    #[must_use]
    pub fn number(self) -> usize {
        self.number
    }

    /// Whether clouds cover it: types 1 to 5.
    #[must_use]
    pub fn is_overcast(self) -> bool {
        self.number <= LAST_OVERCAST
    }

    /// Irradiance of an unobstructed horizontal plane, on the scale of [`StandardSky::radiance`].
    /// `sun_height` is the sine of the sun's elevation.
    #[must_use]
    pub fn irradiance(self, sun_height: f64) -> f64 {
        let sun_horizontal = (1.0 - sun_height * sun_height).max(0.0).sqrt();
        let ring = |height: f64| {
            let horizontal = (1.0 - height * height).sqrt();
            let at = |n: usize| {
                let azimuth = TAU * (n as f64 + 0.5) / AZIMUTHS as f64;
                self.radiance(height, sun_height * height + sun_horizontal * horizontal * azimuth.cos())
            };
            (0..AZIMUTHS).map(at).sum::<f64>()
        };
        // rings that contribute equally to a horizontal plane under a uniform sky
        let height = |n: usize| ((n as f64 + 0.5) / HEIGHTS as f64).sqrt();
        PI / (HEIGHTS * AZIMUTHS) as f64 * (0..HEIGHTS).map(|n| ring(height(n))).sum::<f64>()
    }

    /// Relative radiance in a direction, by the cosines of its angles to the zenith (above 0) and to the sun.
    #[must_use]
    pub fn radiance(self, cos_to_zenith: f64, cos_to_sun: f64) -> f64 {
        let [gradation, indicatrix] = TYPES[self.number - 1];
        let ([a, b], [c, d, e]) = (GRADATIONS[gradation], INDICATRICES[indicatrix]);
        let cos = cos_to_sun.clamp(-1.0, 1.0);
        let at_right_angle = (d * FRAC_PI_2).exp();
        let indicatrix = 1.0 + c * ((d * cos.acos()).exp() - at_right_angle) + e * cos * cos;
        (1.0 + a * (b / cos_to_zenith).exp()) * indicatrix
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A uniform sky gives a horizontal plane π times its radiance, an overcast one after Moon and Spencer
    /// nearly 7/9 of that for the radiance at its zenith.
    #[test]
    fn skies_are_added_up() {
        let of = |number: usize, height| StandardSky::of_type(number).unwrap().irradiance(height);
        assert!((of(5, 0.5) / PI - 1.0).abs() < 1e-12);
        let zenith = StandardSky::of_type(1).unwrap().radiance(1.0, 0.5);
        assert!((of(1, 0.5) / (zenith * PI) - 7.0 / 9.0).abs() < 0.01);
    }

    /// According to the standard an overcast sky of type 1 is three times as bright at the zenith as at the
    /// horizon, and one of type 5 is uniform.
    #[test]
    fn skies_are_those_of_the_standard() {
        let of = |number: usize, height: f64| StandardSky::of_type(number).unwrap().radiance(height, 0.0);
        assert!((of(1, 1.0) / of(1, 1e-6) - 2.986).abs() < 1e-3);
        assert!((of(5, 1.0) - of(5, 0.1)).abs() < 1e-12);
        // clear skies are brightest at the sun, and bright at the horizon
        let clear = StandardSky::CLEAR;
        assert!(clear.radiance(0.7, 1.0) > 5.0 * clear.radiance(0.7, 0.0));
        assert!(clear.radiance(0.05, 0.0) > 2.0 * clear.radiance(1.0, 0.0));
    }
}
