//! The role of a picture's exposure.

use nalgebra::DVector;

use super::normal::Normal;

/// Maximum number of steps to the most probable exposure, and the relative change at convergence: from the
/// second on, each step gains two digits.
const STEPS: usize = 20;
const TOLERANCE: f64 = 1e-12;

/// The role of a picture's exposure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// Known: a perfect white diffuser facing the sun has this value in its strongest channel.
    Known(f64),
    /// Unknown: the best-fitting exposure for every spectrum tried (variable projection, Golub and
    /// Pereyra 1973).
    Free,
    /// Unknown, with a normal prior on its logarithm: the most probable exposure for every spectrum tried.
    Expected(Normal),
    /// Unknown: picture and model are normalised by their sums, as in the paper (section 5D).
    Sum,
}

impl Exposure {
    /// Its value, if it is known.
    #[must_use]
    pub fn known(self) -> Option<f64> {
        match self {
            Self::Known(exposure) => Some(exposure),
            Self::Free | Self::Expected(_) | Self::Sum => None,
        }
    }

    /// The same with this prior on its logarithm, if the exposure is entirely unknown.
    #[must_use]
    pub fn or_expected(self, known: Option<Normal>) -> Self {
        match (self, known) {
            (Self::Free, Some(known)) => Self::Expected(known),
            _ => self,
        }
    }

    /// The exposure of `data` if the model is `values` at exposure 1, given the ratio of the sums of
    /// both over all facets.
    pub(super) fn fitted(
        self,
        data: &DVector<f64>,
        values: &DVector<f64>,
        by_sums: impl FnOnce() -> f64,
    ) -> f64 {
        let best = || values.dot(data) / values.norm_squared().max(f64::MIN_POSITIVE);
        match self {
            Self::Known(exposure) => exposure,
            Self::Free => best(),
            Self::Expected(prior) => most_probable(data, values, best(), prior),
            Self::Sum => by_sums(),
        }
    }

    /// Distance of an exposure from the expected one in standard deviations; `None` if none was expected.
    pub(super) fn off(self, exposure: f64) -> Option<f64> {
        match self {
            Self::Expected(Normal { mean, sd }) => Some((exposure.ln() - mean) / sd),
            Self::Known(_) | Self::Free | Self::Sum => None,
        }
    }
}

/// The exposure that fits the data and its prior together, by Gauss-Newton steps in its logarithm from the
/// `best` for the data alone.
fn most_probable(data: &DVector<f64>, values: &DVector<f64>, best: f64, Normal { mean, sd }: Normal) -> f64 {
    let (square, product) = (values.norm_squared(), values.dot(data));
    let mut ln_exposure = if best > 0.0 { best.ln() } else { mean };
    for _ in 0..STEPS {
        let exposure = ln_exposure.exp();
        let gradient = exposure * (product - exposure * square) - (ln_exposure - mean) / (sd * sd);
        let step = gradient / (exposure * exposure * square + (sd * sd).recip());
        ln_exposure += step.clamp(-1.0, 1.0);
        if step.abs() < TOLERANCE {
            break;
        }
    }
    ln_exposure.exp()
}
