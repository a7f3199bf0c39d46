//! How far a photograph is from one of an ideal fold.

/// What a photograph may be: how much of all that an ideal fold lacks there is, and whether what was stated is exactly so.
///
/// None is chosen: estimates are made under each that the facets leave possible, and weighed by evidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Imperfection {
    /// Size of crease, bow, sky, ground, vignetting and glare, and of what sets the sheet apart from a matt one; 0: nothing, 1: as in photographs
    /// that people take.
    pub scale: f64,
    /// Size of what angle, tilt and exposure are off from those that were stated; 0: nothing, 1: as people measure.
    pub stated: f64,
    /// Size of what camera and light are off from those that were told; 0: nothing, 1: as two of a kind differ.
    pub told: f64,
    /// How much no unknown explains.
    pub discrepancy: Discrepancy,
    /// How often it is so.
    share: f64,
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
    /// Those that photographs may have: as people take them, then ideal folds. Of the latter, one that was computed has curves and light as
    /// told, one that was measured with care an angle as stated, a test of both.
    pub const ALL: [Self; 4] = [
        Self { scale: 1.0, stated: 1.0, told: 1.0, discrepancy: Discrepancy::Usual, share: 0.88 },
        Self { scale: 0.0, stated: 1.0, told: 0.0, discrepancy: Discrepancy::None, share: 0.04 },
        Self { scale: 0.0, stated: 0.0, told: 1.0, discrepancy: Discrepancy::None, share: 0.04 },
        Self { scale: 0.0, stated: 0.0, told: 0.0, discrepancy: Discrepancy::None, share: 0.04 },
    ];

    /// Logarithm of how often it is so.
    #[must_use]
    pub fn ln_share(&self) -> f64 {
        self.share.ln()
    }

    /// Whether the fold is an ideal one, of a sheet that is perfectly matt.
    #[must_use]
    pub fn is_ideal(&self) -> bool {
        self.scale <= 0.0
    }

    /// Whether this is another with less unknown.
    #[must_use]
    pub fn is_case_of(&self, other: &Self) -> bool {
        self.scale <= other.scale
            && self.stated <= other.stated
            && self.told <= other.told
            && self.discrepancy == other.discrepancy
    }

    /// The same where unknowns explain nearly all.
    #[must_use]
    pub fn with_less_discrepancy(self) -> [Self; 2] {
        [Discrepancy::Small, Discrepancy::Tiny].map(|discrepancy| Self { discrepancy, ..self })
    }
}
