//! Folds of which sheets that are not ideal are not modelled.

use std::fmt;

/// Why a sheet is taken for an ideal one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unmodelled {
    /// A panel is a card.
    Card,
    /// One panel is deeper than the other.
    UnequalPanels,
    /// There is more than one picture of the sheet.
    SeveralLights,
    /// Lamps light it, or several suns, or one that leaves a panel in the shade.
    OtherLight,
    /// The corners are not given, or no camera sees the panels so.
    NoPose,
    /// No facet has any light.
    NoFacets,
}

impl fmt::Display for Unmodelled {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Card => "one panel is a card",
            Self::UnequalPanels => "one panel is deeper than the other",
            Self::SeveralLights => "there are pictures under several lights",
            Self::OtherLight => "other lights than one sun and one sky were stated",
            Self::NoPose => "the corners do not fix where the camera stood",
            Self::NoFacets => "no facet has any light",
        })
    }
}
