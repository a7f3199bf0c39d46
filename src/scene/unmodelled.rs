//! Folds of which sheets that are not ideal are not modelled.

use std::fmt;

use super::FoldSetting;
use crate::error::{Error, Result};

/// Why a sheet is taken for an ideal one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unmodelled {
    /// A panel is a card.
    Card,
    /// One panel is deeper than the other.
    UnequalPanels,
    /// There is more than one picture of the sheet.
    SeveralLights,
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
            Self::NoPose => "the corners do not tell where the camera stood",
            Self::NoFacets => "no facet has any light",
        })
    }
}

impl Unmodelled {
    /// The field of the scene or sample that says so.
    fn field(self) -> &'static str {
        match self {
            Self::Card => "reference_panel",
            Self::UnequalPanels => "geometry",
            Self::SeveralLights => "illuminants",
            Self::NoPose => "regions",
            Self::NoFacets => "facet_rgb",
        }
    }

    /// The error of a scene that asks for such a sheet all the same.
    pub(super) fn refused(self) -> Error {
        Error::field(
            self.field(),
            format!("{self}; a sheet that is not perfectly matt is not computed there"),
        )
    }
}

impl FoldSetting<'_> {
    /// What of the scene keeps its sheet an ideal one, if anything does.
    pub(super) fn unmodelled(&self) -> Result<Option<Unmodelled>> {
        let all = [
            (self.card()?.is_some(), Unmodelled::Card),
            (!self.fold().is_symmetric(), Unmodelled::UnequalPanels),
            (self.pictures()? != 1, Unmodelled::SeveralLights),
        ];
        Ok(all.into_iter().find(|(is_so, _)| *is_so).map(|(_, why)| why))
    }
}
