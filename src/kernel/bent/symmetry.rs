//! Light on a sheet that is symmetric about the plane that halves the crease, as a sum of two parts.

/// What reflection about that plane does to light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Symmetry {
    /// It stays the same.
    Even,
    /// It changes its sign.
    Odd,
}

impl Symmetry {
    /// Both, in the order of their numbers.
    pub const BOTH: [Self; 2] = [Self::Even, Self::Odd];

    /// The mirror image of light as a multiple of itself.
    pub fn sign(self) -> f64 {
        match self {
            Self::Even => 1.0,
            Self::Odd => -1.0,
        }
    }
}
