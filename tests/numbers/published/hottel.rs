//! H. C. Hottel and A. F. Sarofim, *Radiative Transfer* (1967), chapter 2: crossed strings, exact for
//! surfaces without end. A V of depths a and b whose outer edges are c apart has a F = (a + b - c) / 2.

use super::{assert_near, between_panels};

/// A crease so long that its ends take no more than 4e-4.
const LONG: f64 = 500.0;

#[test]
fn long_folds_have_the_form_factor_of_crossed_strings() {
    for angle_deg in [10.0, 45.0, 90.0, 135.0, 170.0] {
        for [a, b] in [[1.0, 1.0], [1.0, 0.5], [0.5, 2.0]] {
            let c = f64::sqrt(a * a + b * b - 2.0 * a * b * f64::to_radians(angle_deg).cos());
            let got = between_panels(angle_deg, LONG, [a, b]);
            assert_near(&[got], &[0.5 * (a + b - c) / a], 4e-4, &format!("{angle_deg}° {a} {b}"));
        }
    }
}
