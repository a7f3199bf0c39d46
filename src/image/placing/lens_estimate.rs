//! A lens, and how well its distortion is known.

use super::distortion::Lens;

/// A lens, and how well its distortion is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensEstimate {
    /// The most probable lens.
    pub lens: Lens,
    /// Standard deviation of its k1.
    pub k1_sd: f64,
}

/// Accuracy of a stated distortion.
const STATED_SD: f64 = 1e-4;

impl LensEstimate {
    /// A lens of which nothing is known: at the middle of the picture's longer sides most distort by less
    /// than 2 %.
    pub const UNKNOWN: Self = Self { lens: Lens::STRAIGHT, k1_sd: 0.02 };

    /// A lens stated by the user.
    #[must_use]
    pub const fn stated(lens: Lens) -> Self {
        Self { lens, k1_sd: STATED_SD }
    }

    /// Whether the picture may tell more about it.
    pub(in crate::image) fn is_uncertain(&self) -> bool {
        self.k1_sd > STATED_SD
    }
}
