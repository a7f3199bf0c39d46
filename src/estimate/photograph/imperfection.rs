//! Deviation of a photograph from that of an ideal fold.

use super::priors::Priors;

/// Common amount of all effects that an ideal fold lacks.
///
/// No value is chosen: estimates are made under each one that the facets permit, and weighed by evidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Imperfection {
    /// Size of crease, bow, sky, ground, vignetting and glare, of the sheet's differences from a matte one,
    /// and of errors in the stated angle, tilt, exposure, light and camera; 0: nothing, 1: as in usual
    /// photographs.
    pub scale: f64,
    /// Size of the model error.
    pub discrepancy: Discrepancy,
}

/// Size of the model error, relative to usual photographs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Discrepancy {
    /// Nothing.
    None,
    /// A sixteenth, for simulated pictures.
    Tiny,
    /// A quarter, for pictures taken with care.
    Small,
    /// As in usual photographs.
    Usual,
}

impl Discrepancy {
    /// Its size.
    #[must_use]
    pub fn size(self) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Tiny => 0.0625,
            Self::Small => 0.25,
            Self::Usual => 1.0,
        }
    }
}

impl Imperfection {
    /// A usual photograph.
    pub const USUAL: Self = Self { scale: 1.0, discrepancy: Discrepancy::Usual };
    /// An ideal fold of a perfectly matte sheet in a scene exactly as stated: a computed one. If intermediate
    /// values were weighed as well, facets would be explained wrongly but confidently (docs/design-notes.md).
    pub const IDEAL: Self = Self { scale: 0.0, discrepancy: Discrepancy::None };

    /// Logarithm of its probability.
    #[must_use]
    pub fn ln_share(&self, priors: &Priors) -> f64 {
        if self.is_ideal() { priors.ideal_share.ln() } else { (1.0 - priors.ideal_share).ln() }
    }

    /// True for an ideal fold of a perfectly matte sheet.
    #[must_use]
    pub fn is_ideal(&self) -> bool {
        self.scale <= 0.0
    }

    /// The same with smaller model errors, where unknowns explain almost everything.
    #[must_use]
    pub fn with_less_discrepancy(self) -> [Self; 2] {
        [Discrepancy::Small, Discrepancy::Tiny].map(|discrepancy| Self { discrepancy, ..self })
    }
}
