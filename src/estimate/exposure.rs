//! The role of a picture's exposure.

use super::normal::Normal;
use super::photograph::priors::Priors;

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

    /// The same for a photograph: an unknown exposure gets the prior of [usual exposures](Priors::exposure).
    #[must_use]
    pub fn of_photograph(self) -> Self {
        match self {
            Self::Free => Self::Expected(Priors::USUAL.exposure()),
            stated => stated,
        }
    }
}
