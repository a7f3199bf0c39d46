//! Folds of which sheets that are not ideal are not modelled.

use super::FoldSetting;
use crate::error::{Error, Result};
use crate::estimate::photograph::Unmodelled;

impl Unmodelled {
    /// The field of the scene or sample that says so.
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

    /// The error of a scene that asks for such a sheet all the same.
    pub(super) fn refused(self) -> Error {
        Error::field(
            self.field(),
            format!("{self}; a sheet that is not perfectly matt is not computed there"),
        )
    }
}

impl FoldSetting {
    /// What of the scene keeps its sheet an ideal one, if anything does.
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
