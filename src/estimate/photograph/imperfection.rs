//! How far a photograph is from one of an ideal fold.

use super::priors::Priors;

/// How much there is of all that an ideal fold lacks at once.
///
/// None is chosen: estimates are made under each that the facets leave possible, and weighed by evidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Imperfection {
    /// Size of crease, bow, sky, ground, vignetting and glare, of what sets the sheet apart from a matt one,
    /// and of what angle, tilt, exposure, light and camera are off from those that were stated; 0: nothing,
    /// 1: as in photographs that people take.
    pub scale: f64,
    /// How much no unknown explains.
    pub discrepancy: Discrepancy,
}

/// How much no unknown explains, that of photographs as people take them being 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Discrepancy {
    /// Nothing.
    None,
    /// A sixteenth, in a simulated picture.
    Tiny,
    /// A quarter, in a picture that was taken with care.
    Small,
    /// As in people's photographs.
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
    /// A photograph as people take them.
    pub const USUAL: Self = Self { scale: 1.0, discrepancy: Discrepancy::Usual };
    /// That of an ideal fold, of a perfectly matt sheet, in a scene that is exactly as it was stated: one
    /// that was computed. With what is between the two weighed as well, facets are explained wrongly and
    /// surely (docs/design-notes.md).
    pub const IDEAL: Self = Self { scale: 0.0, discrepancy: Discrepancy::None };

    /// Logarithm of how often it is so.
    #[must_use]
    pub fn ln_share(&self, priors: &Priors) -> f64 {
        if self.is_ideal() { priors.ideal_share.ln() } else { (1.0 - priors.ideal_share).ln() }
    }

    /// Whether the fold is an ideal one, of a sheet that is perfectly matt.
    #[must_use]
    pub fn is_ideal(&self) -> bool {
        self.scale <= 0.0
    }

    /// The same where unknowns explain nearly all.
    #[must_use]
    pub fn with_less_discrepancy(self) -> [Self; 2] {
        [Discrepancy::Small, Discrepancy::Tiny].map(|discrepancy| Self { discrepancy, ..self })
    }
}
