//! One channel's polynomial: the posterior mode and its covariance.

use nalgebra::{Matrix3, Vector3};

use super::patch::Patch;
use crate::error::{Error, Result};

/// Prior standard deviation of the polynomial's constant, relative to the brightest patch: stray light and
/// black level.
const OFFSET_SD: f64 = 5e-3;
/// Prior standard deviation of the quadratic term at the brightest patch, relative to it.
const CURVATURE_SD: f64 = 0.05;
/// Prior relative error of a patch, with the weight of this many patches: ageing, dirt, another batch.
const PATCH_SD: f64 = 0.01;
const PATCH_SD_COUNT: f64 = 2.0;
/// The relative error converges within a few rounds.
const ROUNDS: usize = 20;

/// A channel's polynomial between values relative to the brightest patch.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Polynomial {
    terms: Vector3<f64>,
    covariance: Matrix3<f64>,
    /// The brightest patch, measured and expected.
    brightest: (f64, f64),
    /// Factor of the polynomial's values; 1 until all channels are known.
    exposure: f64,
}

/// A patch in one channel: measured value, its standard error, expected value.
type Datum = (f64, f64, f64);

impl Polynomial {
    pub fn fit(patches: &[Patch], channel: usize) -> Result<Self> {
        let data =
            patches.iter().map(|p| (p.measured[channel], p.standard_error[channel], p.expected[channel]));
        let brightest =
            data.clone().fold((0.0, 0.0), |(m, e): (f64, f64), datum| (m.max(datum.0), e.max(datum.2)));
        let falls =
            || Error::Numeric(format!("channel {channel} does not rise with the patches' expected values"));
        if !(brightest.0 > 0.0 && brightest.1 > 0.0) {
            return Err(falls());
        }
        let shares: Vec<Datum> =
            data.map(|(m, sd, e)| (m / brightest.0, sd / brightest.0, e / brightest.1)).collect();
        let (terms, covariance) = posterior(&shares).ok_or_else(falls)?;
        let polynomial = Self { terms, covariance, brightest, exposure: 1.0 };
        // the slope is linear: if positive at both ends, it is positive between
        if [0.0, brightest.0].iter().any(|end| polynomial.slope(*end) <= 0.0) {
            Err(falls())
        } else {
            Ok(polynomial)
        }
    }

    /// Position on the curve up to the brightest patch, and distance beyond it.
    fn place(&self, measured: f64) -> (f64, f64) {
        let share = measured / self.brightest.0;
        (share.min(1.0), (share - 1.0).max(0.0))
    }

    pub fn value(&self, measured: f64) -> f64 {
        let (share, beyond) = self.place(measured);
        let value = self.terms.dot(&powers(share)) + beyond * self.terms.dot(&slopes(share));
        self.exposure * self.brightest.1 * value
    }

    pub fn slope(&self, measured: f64) -> f64 {
        let (share, _) = self.place(measured);
        self.exposure * self.brightest.1 / self.brightest.0 * self.terms.dot(&slopes(share))
    }

    /// Value in the photograph for an expected 1, at the brightest patch, and its standard deviation.
    pub fn gain(&self) -> (f64, f64) {
        let sum = self.terms.sum();
        let gain = self.brightest.0 / (self.brightest.1 * sum);
        (gain, gain * self.covariance.sum().max(0.0).sqrt() / sum)
    }

    pub fn at_exposure(self, exposure: f64) -> Self {
        Self { exposure, ..self }
    }

    /// Constant, linear and quadratic coefficient.
    pub fn coefficients(&self) -> [f64; 3] {
        let (measured, expected) = self.brightest;
        [0, 1, 2].map(|power| self.exposure * expected * self.terms[power] / measured.powi(power as i32))
    }
}

fn powers(x: f64) -> Vector3<f64> {
    Vector3::new(1.0, x, x * x)
}

fn slopes(x: f64) -> Vector3<f64> {
    Vector3::new(0.0, 1.0, 2.0 * x)
}

/// The most probable polynomial and its covariance; the patches' relative error is inferred with them.
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
