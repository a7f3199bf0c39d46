//! How the exposure of a picture enters.

use super::normal::Normal;
use super::photograph::priors::Priors;

/// How the exposure of the picture enters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// Known: a perfect white diffuser facing the sun has this value in its strongest channel.
    Known(f64),
    /// Unknown: the exposure that fits best, for every spectrum tried (variable projection, Golub and Pereyra
    /// 1973).
    Free,
    /// Unknown, and its logarithm normal before the picture is looked at: the one that is most probable, for
    /// every spectrum tried.
    Expected(Normal),
    /// Unknown: picture and model are divided by their sums, as the paper does (section 5D).
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

    /// The same where something is known of its logarithm, if it is.
    #[must_use]
    pub fn or_expected(self, known: Option<Normal>) -> Self {
        match (self, known) {
            (Self::Free, Some(known)) => Self::Expected(known),
            _ => self,
        }
    }

    /// The same of a photograph: of an exposure that nobody states something is known, as
    /// [people expose](Priors::exposure).
    #[must_use]
    pub fn of_photograph(self) -> Self {
        match self {
            Self::Free => Self::Expected(Priors::USUAL.exposure()),
            stated => stated,
        }
    }
}
