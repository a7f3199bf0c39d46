//! Deviation of a photograph from that of an ideal fold.

use super::priors::Priors;

/// Common amount of all effects that an ideal fold lacks: crease, bow, sky, ground, vignetting and glare,
/// the sheet's differences from a matte one, errors in the stated angle, tilt, exposure, light and camera,
/// and the model error.
///
/// Estimates are made under [`Ideal`](Self::Ideal) and [`Usual`](Self::Usual), as far as facets permit, and
/// weighed by evidence. Those between decide only how much a real sheet's evidence counts against an ideal
/// fold's: residuals of a picture taken with care are far smaller than the usual model error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Imperfection {
    /// Nothing: an ideal fold of a perfectly matte sheet in a scene exactly as stated, a computed one. If
    /// effects smaller than usual were weighed as well, facets would be explained wrongly but confidently
    /// (docs/design-notes.md).
    Ideal,
    /// As in usual photographs, but with a sixteenth of their model error: simulated pictures.
    Simulated,
    /// The same with a quarter of it: pictures taken with care.
    Careful,
    /// As in usual photographs.
    Usual,
}

impl Imperfection {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Ideal, Self::Simulated, Self::Careful, Self::Usual];

    /// Size of the model error, relative to usual photographs.
    #[must_use]
    pub fn discrepancy(self) -> f64 {
        match self {
            Self::Ideal => 0.0,
            Self::Simulated => 0.0625,
            Self::Careful => 0.25,
            Self::Usual => 1.0,
        }
    }

    /// Logarithm of its probability.
    #[must_use]
    pub fn ln_share(self, priors: &Priors) -> f64 {
        if self.is_ideal() { priors.ideal_share.ln() } else { (1.0 - priors.ideal_share).ln() }
    }

    /// True for an ideal fold of a perfectly matte sheet.
    #[must_use]
    pub fn is_ideal(self) -> bool {
        self == Self::Ideal
    }
}
