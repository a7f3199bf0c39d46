//! Standard skies: how bright a sky is in each direction, by its cloud and haze.

/// One of the fifteen standard general skies: 1 to 5 are overcast, 6 to 10 partly cloudy, 11 to 15 clear.
///
/// # Source
/// CIE S 011/E:2003, *Spatial distribution of daylight: CIE standard general sky*, table 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandardSky {
    /// How radiance changes from horizon to zenith: a and b.
    gradation: [f64; 2],
    /// How it changes with the distance from the sun: c, d and e.
    indicatrix: [f64; 3],
}

const GRADATIONS: [[f64; 2]; 6] =
    [[4.0, -0.70], [1.1, -0.8], [0.0, -1.0], [-1.0, -0.55], [-1.0, -0.32], [-1.0, -0.15]];
const INDICATRICES: [[f64; 3]; 6] = [
    [0.0, -1.0, 0.0],
    [2.0, -1.5, 0.15],
    [5.0, -2.5, 0.30],
    [10.0, -3.0, 0.45],
    [16.0, -3.0, 0.30],
    [24.0, -2.8, 0.15],
];
/// Which of both each type has.
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

impl StandardSky {
    /// A clear sky of low turbidity: type 12.
    pub const CLEAR: Self = Self { gradation: GRADATIONS[4], indicatrix: INDICATRICES[3] };

    /// The sky of this type, 1 to 15; none of another.
    ///
    /// # Example
    /// ```
    /// use vfold::kernel::standard_sky::StandardSky;
    /// assert_eq!(StandardSky::of_type(12), Some(StandardSky::CLEAR));
    /// assert_eq!(StandardSky::of_type(16), None);
    /// ```
    #[must_use]
    pub fn of_type(number: usize) -> Option<Self> {
        let [gradation, indicatrix] = *TYPES.get(number.checked_sub(1)?)?;
        Some(Self { gradation: GRADATIONS[gradation], indicatrix: INDICATRICES[indicatrix] })
    }

    /// Relative radiance from a direction with these cosines of its angles with the zenith, above 0, and with the sun.
    #[must_use]
    pub fn radiance(self, cos_to_zenith: f64, cos_to_sun: f64) -> f64 {
        let Self { gradation: [a, b], indicatrix: [c, d, e] } = self;
        let cos = cos_to_sun.clamp(-1.0, 1.0);
        let at_right_angle = (d * std::f64::consts::FRAC_PI_2).exp();
        let indicatrix = 1.0 + c * ((d * cos.acos()).exp() - at_right_angle) + e * cos * cos;
        (1.0 + a * (b / cos_to_zenith).exp()) * indicatrix
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The standard's own numbers: an overcast sky of type 1 is three times as bright at the zenith as at the horizon, one of type 5 is even.
    #[test]
    fn skies_are_those_of_the_standard() {
        let of = |number: usize, height: f64| StandardSky::of_type(number).unwrap().radiance(height, 0.0);
        assert!((of(1, 1.0) / of(1, 1e-6) - 2.986).abs() < 1e-3);
        assert!((of(5, 1.0) - of(5, 0.1)).abs() < 1e-12);
        // clear ones are brightest at the sun and bright at the horizon
        let clear = StandardSky::CLEAR;
        assert!(clear.radiance(0.7, 1.0) > 5.0 * clear.radiance(0.7, 0.0));
        assert!(clear.radiance(0.05, 0.0) > 2.0 * clear.radiance(1.0, 0.0));
    }
}
