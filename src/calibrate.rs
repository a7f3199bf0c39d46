//! From patches of known colour in a photograph to absolute values.
//!
//! Paper, section 5D: a second-degree polynomial per channel maps the values of a colour chart in the
//! photograph to those of the scene's camera. It includes the exposure, a difference in the colour of the
//! light, stray light and a non-linear curve. A white card is a chart of one patch. This module knows no
//! pixels: patches are means.
//!
//! Facets are darker than most patches, so the polynomial's constant matters most, and errors of reference
//! values are relative. With plain least squares, 2 % of error in each patch becomes 7.5 % at 3 % of white.
//! Here errors are relative, with a size inferred from the residuals, and constant and curvature have priors:
//! 2.5 %, and 0.5 % at 30 % of white (`tests/numbers/calibration.rs` measures both).

mod patch;
mod polynomial;

pub use patch::Patch;
use polynomial::Polynomial;

use crate::error::{Error, Result};

/// Mean residuals above this are not noise: a picture with an undone curve or another camera's has 0.02 to
/// 0.12, patches in the wrong order 0.45 and more.
const LARGEST_RESIDUAL: f64 = 0.25;

/// The map from a photograph's values to those of the scene's camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    polynomials: Vec<Polynomial>,
    exposure: f64,
    exposure_sd: f64,
}

impl Calibration {
    /// Fits the calibration to patches.
    ///
    /// # Arguments
    /// - `patches`: one or more, all with as many channels as the camera.
    /// - `reference_channel`: the channel in which a white diffuser facing the sun is 1 at exposure 1.
    ///
    /// # Errors
    /// [`Error::Numeric`] if the patches do not increase with their expected values, or are off by more than
    /// a quarter.
    ///
    /// # Source
    /// Deeb et al., section 5D, for the polynomial.
    ///
    /// # Example
    /// ```
    /// use vfold::calibrate::{Calibration, Patch};
    /// let patch = |name: &str, measured, expected| Patch {
    ///     name: name.into(),
    ///     measured: vec![measured],
    ///     standard_error: vec![1e-4],
    ///     expected: vec![expected],
    /// };
    /// let patches = [patch("white", 0.45, 0.9), patch("grey", 0.1, 0.2), patch("black", 0.02, 0.04)];
    /// let calibration = Calibration::fit(&patches, 0)?;
    /// assert!((calibration.exposure() - 0.5).abs() < 1e-6); // values are half of what exposure 1 gives
    /// assert!((calibration.value(0, 0.3) - 0.3).abs() < 1e-6); // and linear
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn fit(patches: &[Patch], reference_channel: usize) -> Result<Self> {
        let channels = patches.first().map_or(0, |patch| patch.expected.len());
        patches.iter().try_for_each(|patch| check(patch, channels))?;
        let polynomials = (0..channels).map(|n| Polynomial::fit(patches, n)).collect::<Result<Vec<_>>>()?;
        let Some(reference) = polynomials.get(reference_channel) else {
            return Err(Error::Numeric("there are no patches to calibrate with".to_owned()));
        };
        let (exposure, exposure_sd) = reference.gain();
        let polynomials =
            polynomials.into_iter().map(|polynomial| polynomial.at_exposure(exposure)).collect();
        let calibration = Self { polynomials, exposure, exposure_sd };
        let worst = calibration.residual_rms(patches).into_iter().fold(0.0, f64::max);
        if worst > LARGEST_RESIDUAL {
            return Err(Error::Numeric(format!(
                "on average the patches are off by {:.0} % from their expected values",
                100.0 * worst
            )));
        }
        Ok(calibration)
    }

    /// Value of a perfect white diffuser facing the sun in the strongest channel: the exposure at which the
    /// scene's camera would have recorded the photograph's values.
    #[must_use]
    pub fn exposure(&self) -> f64 {
        self.exposure
    }

    /// Standard deviation of the exposure.
    #[must_use]
    pub fn exposure_sd(&self) -> f64 {
        self.exposure_sd
    }

    /// The value that the scene's camera would have recorded at [`Calibration::exposure`] for a value of the
    /// photograph. Beyond the brightest patch the polynomial continues as its tangent.
    #[must_use]
    pub fn value(&self, channel: usize, measured: f64) -> f64 {
        self.polynomials[channel].value(measured)
    }

    /// The same for a standard deviation around a value.
    #[must_use]
    pub fn sd(&self, channel: usize, measured: f64, sd: f64) -> f64 {
        self.polynomials[channel].slope(measured) * sd
    }

    /// The polynomial of a channel: constant, linear and quadratic coefficient.
    #[must_use]
    pub fn coefficients(&self, channel: usize) -> [f64; 3] {
        self.polynomials[channel].coefficients()
    }

    /// Relative deviation of a patch from its expected value, per channel.
    #[must_use]
    pub fn residual(&self, patch: &Patch) -> Vec<f64> {
        let channel = |(channel, polynomial): (usize, &Polynomial)| {
            polynomial.value(patch.measured[channel]) / (self.exposure * patch.expected[channel]) - 1.0
        };
        self.polynomials.iter().enumerate().map(channel).collect()
    }

    /// Root mean square of the patches' residuals per channel.
    #[must_use]
    pub fn residual_rms(&self, patches: &[Patch]) -> Vec<f64> {
        let mut squares = vec![0.0; self.polynomials.len()];
        for patch in patches {
            self.residual(patch)
                .iter()
                .zip(&mut squares)
                .for_each(|(residual, sum)| *sum += residual.powi(2));
        }
        squares.into_iter().map(|sum| (sum / patches.len() as f64).sqrt()).collect()
    }
}

/// A patch must have all channels, and light in each.
fn check(patch: &Patch, channels: usize) -> Result<()> {
    let Patch { name, measured, standard_error, expected } = patch;
    if [measured, standard_error, expected].iter().any(|values| values.len() != channels) {
        return Err(Error::Numeric(format!("patch '{name}' does not have one number per channel")));
    }
    if expected.iter().any(|value| *value <= 0.0) {
        return Err(Error::Numeric(format!("patch '{name}' is expected to be black")));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;

    /// NumPy 2, twenty rounds of `C = inv(A.T @ (A/v[:,None]) + P); t = C @ (A.T @ (y/v))` with A =
    /// [1, x, x²].
    #[test]
    fn the_polynomial_is_that_of_numpy() {
        let patch = |measured, expected| Patch {
            name: String::new(),
            measured: vec![measured],
            standard_error: vec![2e-4],
            expected: vec![expected],
        };
        let patches = [(0.3, 0.9), (0.16, 0.5), (0.07, 0.21), (0.03, 0.09), (0.012, 0.036)];
        let patches: Vec<_> = patches.map(|(measured, expected)| patch(measured, expected)).into();
        let calibration = Calibration::fit(&patches, 0).unwrap();
        let [constant, slope, quadratic] = calibration.coefficients(0);
        for (got, want) in [
            (calibration.exposure(), 0.3295619941699522),
            (calibration.exposure_sd(), 0.004554031650739234),
            (calibration.value(0, 0.1), 0.10010484013992393),
            (constant + 0.1 * slope + 0.01 * quadratic, 0.10010484013992393),
        ] {
            assert!((got / want - 1.0).abs() < 1e-12, "{got}, not {want}");
        }
    }
}
