//! Folds for which only ideal sheets are modelled.

use std::fmt;

/// Why a sheet is assumed to be ideal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unmodelled {
    /// A panel is a card.
    Card,
    /// One panel is deeper than the other.
    UnequalPanels,
    /// There is more than one picture of the sheet.
    SeveralLights,
    /// It is lit by lamps, by several suns, or by one that leaves a panel in shade.
    OtherLight,
    /// The corners are missing, or no camera position explains them.
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
            Self::OtherLight => "lights other than one sun and one sky were stated",
            Self::NoPose => "the corners do not fix where the camera stood",
            Self::NoFacets => "no facet has any light",
        })
    }
}
