//! From patches of known colour in a photograph to its absolute values.
//!
//! Paper, section 5D: a polynomial of second degree a channel takes what a colour chart shows to what the scene's camera makes of
//! it. It holds the exposure, the colour of the light as far as it is not the scene's, stray light and a bent curve. A white card
//! is a chart of one patch. Nothing here knows pixels: patches come as means.
//!
//! Facets are darker than most patches, so the polynomial's constant matters most, and reference values are off by a share of
//! themselves. Plain least squares makes 2 % of error in each patch 7.5 % at 3 % of white. Here errors are relative, as
//! large as the residuals say, and constant and curvature have priors: 2.5 %, and 0.5 % at 30 % of white
//! (`tests/calibration.rs` measures both).

use nalgebra::{Matrix3, Vector3};

use crate::error::{Error, Result};

/// Standard deviation of the polynomial's constant before the picture, of the brightest patch: stray light and black level.
const OFFSET_SD: f64 = 5e-3;
/// Standard deviation of the quadratic term at the brightest patch before the picture, of that patch.
const CURVATURE_SD: f64 = 0.05;
/// Relative error of a patch before the picture, worth as much as so many patches: ageing, dirt, another batch.
const PATCH_SD: f64 = 0.01;
const PATCH_SD_COUNT: f64 = 2.0;
/// The relative error settles within a few rounds.
const ROUNDS: usize = 20;
/// Mean residuals above this are no noise: a picture with an undone curve or another camera's has 0.02 to 0.12, patches in the
/// wrong order 0.45 and more.
const LARGEST_RESIDUAL: f64 = 0.25;

/// A patch, and what it should be.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// The reference's name.
    pub name: String,
    /// Mean light per channel in the photograph.
    pub measured: Vec<f64>,
    /// Standard error of the mean per channel.
    pub standard_error: Vec<f64>,
    /// What the scene's camera makes of it at exposure 1, above 0.
    pub expected: Vec<f64>,
}

/// What takes a photograph's values to those of the scene's camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    curves: Vec<Curve>,
    exposure: f64,
    exposure_sd: f64,
}

impl Calibration {
    /// The calibration that patches ask for.
    ///
    /// # Arguments
    /// - `patches`: one or more, all with as many channels as the camera.
    /// - `reference_channel`: the channel in which a white diffuser facing the sun is 1 at exposure 1.
    ///
    /// # Errors
    /// [`Error::Numeric`] if the patches do not rise with what they should be, or are off by more than a quarter.
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
        if let Some(dark) = patches.iter().find(|patch| patch.expected.iter().any(|value| *value <= 0.0)) {
            return Err(Error::Numeric(format!("patch '{}' has no light to give", dark.name)));
        }
        let mut curves = (0..channels).map(|n| Curve::fit(patches, n)).collect::<Result<Vec<_>>>()?;
        let Some(reference) = curves.get(reference_channel) else {
            return Err(Error::Numeric("there is nothing to calibrate with".to_owned()));
        };
        let (exposure, relative_sd) = (reference.brightest.0 / reference.white(), reference.white_sd());
        curves.iter_mut().for_each(|curve| curve.exposure = exposure);
        let calibration = Self { curves, exposure, exposure_sd: exposure * relative_sd };
        let worst = calibration.residual_rms(patches).into_iter().fold(0.0, f64::max);
        if worst > LARGEST_RESIDUAL {
            return Err(Error::Numeric(format!(
                "the patches are off by {:.0} % in the mean from what they should be",
                100.0 * worst
            )));
        }
        Ok(calibration)
    }

    /// Value of a perfect white diffuser facing the sun in the strongest channel: what the scene's camera, at this exposure, would
    /// have shown the photograph's values.
    #[must_use]
    pub fn exposure(&self) -> f64 {
        self.exposure
    }

    /// Standard deviation of the exposure.
    #[must_use]
    pub fn exposure_sd(&self) -> f64 {
        self.exposure_sd
    }

    /// What the scene's camera would have shown at [`Calibration::exposure`] for a value of the photograph. Beyond the brightest
    /// patch the polynomial goes on as its tangent.
    #[must_use]
    pub fn value(&self, channel: usize, measured: f64) -> f64 {
        self.curves[channel].value(measured)
    }

    /// The same for a standard deviation about a value.
    #[must_use]
    pub fn sd(&self, channel: usize, measured: f64, sd: f64) -> f64 {
        self.curves[channel].slope(measured) * sd
    }

    /// The polynomial of a channel: constant, linear and quadratic coefficient.
    #[must_use]
    pub fn coefficients(&self, channel: usize) -> [f64; 3] {
        let Curve { terms, brightest: (measured, expected), exposure, .. } = &self.curves[channel];
        [0, 1, 2].map(|power| exposure * expected * terms[power] / measured.powi(power as i32))
    }

    /// How far a patch is from what it should be, a share of that per channel.
    #[must_use]
    pub fn residual(&self, patch: &Patch) -> Vec<f64> {
        let channel = |(channel, curve): (usize, &Curve)| {
            curve.value(patch.measured[channel]) / (self.exposure * patch.expected[channel]) - 1.0
        };
        self.curves.iter().enumerate().map(channel).collect()
    }

    /// Root mean square of the patches' residuals per channel.
    #[must_use]
    pub fn residual_rms(&self, patches: &[Patch]) -> Vec<f64> {
        let mut squares = vec![0.0; self.curves.len()];
        for patch in patches {
            self.residual(patch)
                .iter()
                .zip(&mut squares)
                .for_each(|(residual, sum)| *sum += residual.powi(2));
        }
        squares.into_iter().map(|sum| (sum / patches.len() as f64).sqrt()).collect()
    }
}

/// A channel's polynomial, between values as shares of the brightest patch's.
#[derive(Clone, Debug, PartialEq)]
struct Curve {
    terms: Vector3<f64>,
    covariance: Matrix3<f64>,
    /// The brightest patch, measured and expected.
    brightest: (f64, f64),
    exposure: f64,
}

/// A patch in one channel: what was measured, its standard error, what was expected.
type Datum = (f64, f64, f64);

impl Curve {
    fn fit(patches: &[Patch], channel: usize) -> Result<Self> {
        let data =
            patches.iter().map(|p| (p.measured[channel], p.standard_error[channel], p.expected[channel]));
        let brightest =
            data.clone().fold((0.0, 0.0), |(m, e): (f64, f64), datum| (m.max(datum.0), e.max(datum.2)));
        let falls =
            || Error::Numeric(format!("channel {channel} does not rise with what the patches should be"));
        if !(brightest.0 > 0.0 && brightest.1 > 0.0) {
            return Err(falls());
        }
        let shares: Vec<Datum> =
            data.map(|(m, sd, e)| (m / brightest.0, sd / brightest.0, e / brightest.1)).collect();
        let (terms, covariance) = posterior(&shares).ok_or_else(falls)?;
        let curve = Self { terms, covariance, brightest, exposure: 1.0 };
        // the slope is linear: positive at both ends, positive between
        if [0.0, brightest.0].iter().any(|end| curve.slope(*end) <= 0.0) { Err(falls()) } else { Ok(curve) }
    }

    /// Place on the curve up to the brightest patch, and how far beyond it.
    fn place(&self, measured: f64) -> (f64, f64) {
        let share = measured / self.brightest.0;
        (share.min(1.0), (share - 1.0).max(0.0))
    }

    fn value(&self, measured: f64) -> f64 {
        let (share, beyond) = self.place(measured);
        let value = self.terms.dot(&powers(share)) + beyond * self.terms.dot(&slopes(share));
        self.exposure * self.brightest.1 * value
    }

    fn slope(&self, measured: f64) -> f64 {
        let (share, _) = self.place(measured);
        self.exposure * self.brightest.1 / self.brightest.0 * self.terms.dot(&slopes(share))
    }

    /// Expected value of the brightest patch at exposure 1, and its relative standard deviation.
    fn white(&self) -> f64 {
        self.brightest.1 * self.terms.sum()
    }

    fn white_sd(&self) -> f64 {
        self.covariance.sum().max(0.0).sqrt() / self.terms.sum()
    }
}

fn powers(x: f64) -> Vector3<f64> {
    Vector3::new(1.0, x, x * x)
}

fn slopes(x: f64) -> Vector3<f64> {
    Vector3::new(0.0, 1.0, 2.0 * x)
}

/// Most probable polynomial and its covariance; the patches' relative error is found along with them.
fn posterior(data: &[Datum]) -> Option<(Vector3<f64>, Matrix3<f64>)> {
    let prior = Matrix3::from_diagonal(&Vector3::new(OFFSET_SD.powi(-2), 0.0, CURVATURE_SD.powi(-2)));
    let (mut relative, mut found) = (PATCH_SD, None);
    for _ in 0..ROUNDS {
        let variance = |(_, sd, expected): &Datum| (relative * expected).powi(2) + sd * sd;
        let (mut matrix, mut vector) = (prior, Vector3::zeros());
        for datum in data {
            let x = powers(datum.0);
            matrix += x * x.transpose() / variance(datum);
            vector += x * (datum.2 / variance(datum));
        }
        let covariance = matrix.try_inverse()?;
        let terms = covariance * vector;
        let residual = |datum: &Datum| terms.dot(&powers(datum.0)) - datum.2;
        let chi2: f64 = data.iter().map(|datum| residual(datum).powi(2) / variance(datum)).sum();
        let spare = (data.len() as f64 - 2.0).max(0.0);
        let square =
            (PATCH_SD_COUNT * PATCH_SD.powi(2) + relative * relative * chi2) / (PATCH_SD_COUNT + spare);
        relative = square.sqrt();
        found = Some((terms, covariance));
    }
    found.filter(|(terms, _)| terms.iter().all(|term| term.is_finite()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;

    /// NumPy 2, twenty rounds of `C = inv(A.T @ (A/v[:,None]) + P); t = C @ (A.T @ (y/v))` with A = [1, x, x²].
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
