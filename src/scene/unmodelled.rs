//! Folds for which only ideal sheets are modelled.

use super::FoldSetting;
use crate::error::{Error, Result};
use crate::estimate::photograph::Unmodelled;

impl Unmodelled {
    /// The field of the scene or sample responsible.
    fn field(self) -> &'static str {
        match self {
            Self::Card => "reference_panel",
            Self::UnequalPanels => "geometry",
            Self::SeveralLights => "illuminants",
            Self::OtherLight => "light",
            Self::NoPose => "regions",
            Self::NoFacets => "facet_rgb",
        }
    }

    /// The error for a scene that requests another sheet all the same.
    pub(super) fn refused(self) -> Error {
        Error::field(self.field(), format!("{self}; only perfectly matte sheets are computed there"))
    }
}

impl FoldSetting {
    /// The property of the scene that allows only ideal sheets, if there is one.
    pub(super) fn unmodelled(&self) -> Result<Option<Unmodelled>> {
        let all = [
            (self.card.is_some(), Unmodelled::Card),
            (!self.fold.is_symmetric(), Unmodelled::UnequalPanels),
            (self.pictures()? != 1, Unmodelled::SeveralLights),
            (self.is_lit_otherwise, Unmodelled::OtherLight),
        ];
        Ok(all.into_iter().find(|(is_so, _)| *is_so).map(|(_, why)| why))
    }
}
