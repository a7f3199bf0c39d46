//! Expected accuracy of estimates, before any photograph is taken.

use crate::estimate::Estimate;
use crate::estimate::unknowns::Unknown;

/// Standard deviations of several estimates.
#[derive(Clone, Debug, Default)]
pub struct ExpectedError {
    /// Root mean square over the wavelengths, one per estimate.
    reflectance: Vec<f64>,
    /// Sums of squares for the fitted parameters.
    fitted: Vec<(&'static Unknown, f64)>,
}

impl ExpectedError {
    /// Adds the standard deviations of an estimate.
    pub fn add(&mut self, estimate: &Estimate) {
        let sd = estimate.reflectance_sd().unwrap_or_default();
        let square = sd.iter().map(|sd| sd * sd).sum::<f64>() / sd.len().max(1) as f64;
        self.reflectance.push(square.sqrt());
        for fitted in &estimate.fitted {
            match self.fitted.iter_mut().find(|(unknown, _)| *unknown == fitted.unknown) {
                Some((_, sum)) => *sum += fitted.sd * fitted.sd,
                None => self.fitted.push((fitted.unknown, fitted.sd * fitted.sd)),
            }
        }
    }

    /// Expected root mean square error over the wavelengths, one per estimate.
    #[must_use]
    pub fn rmse(&self) -> &[f64] {
        &self.reflectance
    }

    /// Root mean square of the standard deviations of the fitted parameters.
    #[must_use]
    pub fn fitted_sd(&self) -> Vec<(&'static Unknown, f64)> {
        let count = self.reflectance.len().max(1) as f64;
        self.fitted.iter().map(|(unknown, squares)| (*unknown, (squares / count).sqrt())).collect()
    }
}
