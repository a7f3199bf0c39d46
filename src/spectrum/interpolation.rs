//! Values between the samples of a spectrum.
//!
//! CIE 167:2005, "Recommended practice for tabulating spectral data for use in colour computations":
//! Sprague's polynomial of fifth degree for evenly spaced samples. Uneven or too few samples are interpolated
//! linearly.

/// How values for wavelengths are made of samples at others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Linear.
    Linear,
    /// Polynomials of fifth degree through at least six evenly spaced samples.
    Sprague,
    /// No interpolation, but the mean of a light's samples that are closer to each other than wavebands.
    Average,
}

impl Interpolation {
    /// The method suited to samples at these wavelengths.
    pub(super) fn for_samples(wavelengths_nm: &[f64]) -> Self {
        if wavelengths_nm.len() >= 6 && even_step_nm(wavelengths_nm).is_some() {
            Self::Sprague
        } else {
            Self::Linear
        }
    }

    /// `linear`, `sprague` or `average`, as in records.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Sprague => "sprague",
            Self::Average => "average",
        }
    }
}

/// The step of at least two evenly spaced wavelengths; `None` if they are uneven.
pub(super) fn even_step_nm(wavelengths_nm: &[f64]) -> Option<f64> {
    let &[first_nm, .., last_nm] = wavelengths_nm else { return None };
    let step_nm = (last_nm - first_nm) / (wavelengths_nm.len() - 1) as f64;
    let even = |(i, nm): (usize, &f64)| (first_nm + i as f64 * step_nm - nm).abs() < 1e-6 * step_nm;
    wavelengths_nm.iter().enumerate().all(even).then_some(step_nm)
}

/// Coefficients of the two samples that extrapolate before six evenly spaced ones, the farther one first; CIE
/// 167:2005, table 1. Reversed they extrapolate beyond the last six.
#[rustfmt::skip]
const BEFORE: [[f64; 6]; 2] = [
    [884.0, -1960.0, 3033.0, -2648.0, 1080.0, -180.0],
    [508.0, -540.0, 488.0, -367.0, 144.0, -24.0],
];

/// Coefficients of x, x², .. x⁵ between the third and fourth of six evenly spaced samples; CIE 167:2005,
/// eq. (1).
#[rustfmt::skip]
const POLYNOMIAL: [[f64; 6]; 5] = [
    [2.0, -16.0, 0.0, 16.0, -2.0, 0.0],
    [-1.0, 16.0, -30.0, 16.0, -1.0, 0.0],
    [-9.0, 39.0, -70.0, 66.0, -33.0, 7.0],
    [13.0, -64.0, 126.0, -124.0, 61.0, -12.0],
    [-5.0, 25.0, -50.0, 50.0, -25.0, 5.0],
];

/// Sprague's value at the fraction `x`, 0..1, of the way from sample `left` to the next, for at least six
/// evenly spaced samples.
pub(super) fn sprague(samples: &[f64], left: usize, x: f64) -> f64 {
    let around: [f64; 6] = std::array::from_fn(|k| sample(samples, left as isize + k as isize - 2));
    let horner = |sum, row| (sum + dot(row, around) / 24.0) * x;
    around[2] + POLYNOMIAL.into_iter().rev().fold(0.0, horner)
}

/// A sample, or one of the two extrapolated ones at either end.
fn sample(samples: &[f64], at: isize) -> f64 {
    let count = samples.len() as isize;
    match at {
        ..0 => dot(BEFORE[(at + 2) as usize], std::array::from_fn(|k| samples[k])) / 209.0,
        _ if at >= count => {
            let row = BEFORE[(count + 1 - at) as usize];
            dot(row, std::array::from_fn(|k| samples[samples.len() - 1 - k])) / 209.0
        }
        _ => samples[at as usize],
    }
}

fn dot(a: [f64; 6], b: [f64; 6]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `colour.SpragueInterpolator(range(7), y)`, colour-science 0.4.7, first, middle and last interval.
    #[test]
    fn agrees_with_colour_science() {
        let y = [5.92, 9.37, 10.8135, 4.51, 69.59, 27.8007, 86.05];
        for (at, want) in [
            (0.25_f64, 6.729516121107766),
            (0.75, 7.814062514601707),
            (1.5, 12.235688333582534),
            (3.2, 14.841160480000013),
            (4.9, 29.82408197388459),
            (5.6, 51.62030623693777),
        ] {
            let got = sprague(&y, at as usize, at.fract());
            assert!((got - want).abs() < 1e-12 * want.abs().max(1.0), "{at}: {got} for {want}");
        }
    }

    #[test]
    fn uneven_or_few_samples_are_joined_by_lines() {
        let even: Vec<f64> = (0..6).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
        assert_eq!(Interpolation::for_samples(&even), Interpolation::Sprague);
        assert_eq!(Interpolation::for_samples(&even[..5]), Interpolation::Linear);
        let uneven: Vec<f64> = even.iter().map(|nm| nm + 1e-3 * (nm - 400.0).powi(2)).collect();
        assert_eq!(Interpolation::for_samples(&uneven), Interpolation::Linear);
    }
}
