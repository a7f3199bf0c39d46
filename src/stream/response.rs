//! The scene's response: poles and residues of the bounces.

use nalgebra::DMatrix;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::{BY_VKERNEL, finite};
use crate::error::{Error, Result, counted};
use crate::geometry::Fold;
use crate::response::{ModeSet, Modes, Response};
use crate::surfaces::SurfaceResponse;

/// The effect of all bounces of light.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "needs poles and residues; make the scene again with vkernel")]
pub(super) enum ResponseRecord {
    /// Of a fold with equal panels: light on either panel, with residues for the facets of one.
    Shared(ModesRecord),
    /// Of any other fold.
    Separate {
        /// Light on panel 0, then light on panel 1, each with residues for the facets of both.
        panels: [ModesRecord; 2],
    },
    /// Of any other surface, or of a fold among sources other than the sun and a uniform sky.
    Sources {
        /// One entry for each source, with residues for all facets.
        sources: Vec<ModesRecord>,
    },
}

/// Poles and residues of the bounces in one light.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct ModesRecord {
    /// Poles: the share of its light that a mode passes on in a bounce, if nothing is absorbed.
    #[schemars(inner(range(min = -1, max = 1)))]
    poles: Vec<f64>,
    /// Residues, `[facet][pole]`.
    residues: Vec<Vec<f64>>,
}

impl From<&ModeSet> for ModesRecord {
    fn from(set: &ModeSet) -> Self {
        let residues = set.residues.row_iter().map(|row| row.iter().copied().collect()).collect();
        Self { poles: set.poles.clone(), residues }
    }
}

impl ModesRecord {
    fn into_modes(self, facets: usize) -> Result<ModeSet> {
        let poles = self.poles.len();
        if self.residues.len() != facets || self.residues.iter().any(|row| row.len() != poles) {
            let problem = "needs one row per facet, with one number per pole";
            return Err(Error::field("response.residues", problem));
        }
        let residues = DMatrix::from_row_iterator(facets, poles, self.residues.into_iter().flatten());
        Ok(ModeSet { poles: self.poles, residues })
    }
}

impl ResponseRecord {
    fn numbers(&self) -> impl Iterator<Item = &f64> {
        let modes = match self {
            Self::Shared(modes) => std::slice::from_ref(modes),
            Self::Separate { panels } => panels,
            Self::Sources { sources } => sources,
        };
        modes.iter().flat_map(|modes| modes.poles.iter().chain(modes.residues.iter().flatten()))
    }

    /// Checks that all numbers are finite.
    ///
    /// # Errors
    /// [`Error::Field`] if one is not finite.
    pub(super) fn check(&self) -> Result<()> {
        finite("response", self.numbers())
    }
}

impl From<&Response> for ResponseRecord {
    fn from(response: &Response) -> Self {
        match response.modes() {
            Modes::Shared(set) => Self::Shared(set.into()),
            Modes::Separate(sets) => Self::Separate { panels: sets.each_ref().map(Into::into) },
        }
    }
}

impl From<&[SurfaceResponse]> for ResponseRecord {
    fn from(responses: &[SurfaceResponse]) -> Self {
        Self::Sources { sources: responses.iter().map(|response| response.modes().into()).collect() }
    }
}

impl Scene {
    fn response_record(&self) -> Result<ResponseRecord> {
        self.fields.require("response", BY_VKERNEL)
    }

    /// Poles and residues of the bounces.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or their shapes disagree.
    pub fn response(&self) -> Result<Response> {
        self.response_of(&self.fold()?)
    }

    /// The same for a known fold.
    ///
    /// # Errors
    /// As [`Scene::response`].
    pub fn response_of(&self, fold: &Fold) -> Result<Response> {
        let facets = fold.facets().len();
        Response::new(match self.response_record()? {
            ResponseRecord::Shared(modes) => Modes::Shared(modes.into_modes(facets)?),
            ResponseRecord::Separate { panels: [on_0, on_1] } => {
                Modes::Separate([on_0.into_modes(2 * facets)?, on_1.into_modes(2 * facets)?])
            }
            ResponseRecord::Sources { .. } => {
                return Err(Error::field(
                    "response",
                    "not that of a fold; make the scene again with vkernel",
                ));
            }
        })
    }

    /// Poles and residues for every source around a surface other than a fold.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing, or do not fit facets and sources.
    pub fn responses(&self) -> Result<Vec<SurfaceResponse>> {
        let ResponseRecord::Sources { sources: modes } = self.response_record()? else {
            return Err(Error::field("response", "that of a fold; make the scene again with vkernel"));
        };
        let (facets, sources) = (self.facet_count()?, self.sources()?.len());
        if modes.len() != sources {
            let problem = format!("{} for {} of light", modes.len(), counted(sources, "source"));
            return Err(Error::field("response.sources", problem));
        }
        let response = |modes: ModesRecord| SurfaceResponse::new(modes.into_modes(facets)?);
        modes.into_iter().map(response).collect()
    }
}
