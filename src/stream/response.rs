//! The scene's response: poles and residues of the bounces.

use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::finite;
use crate::error::{Error, Result};
use crate::response::{ModeSet, Modes, Response, SurfaceResponse};

/// Of a fold with panels alike: one set of modes, residues for the facets of one panel. Otherwise a set for the light on each
/// panel, residues for the facets of both.
#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "needs poles and residues; make the scene again with vkernel")]
enum ResponseRecord {
    Shared(ModesRecord),
    Separate { panels: [ModesRecord; 2] },
}

/// Of any other surface: a set for every source, residues for all facets.
#[derive(Serialize, Deserialize)]
struct ResponsesRecord {
    sources: Vec<ModesRecord>,
}

#[derive(Serialize, Deserialize)]
struct ModesRecord {
    poles: Vec<f64>,
    residues: Vec<Vec<f64>>,
}

impl From<&ModeSet> for ModesRecord {
    fn from(set: &ModeSet) -> Self {
        let residues = set.residues.chunks(set.poles.len()).map(<[f64]>::to_vec).collect();
        Self { poles: set.poles.clone(), residues }
    }
}

impl ModesRecord {
    fn into_modes(self, facets: usize) -> Result<ModeSet> {
        let poles = self.poles.len();
        if self.residues.len() != facets || self.residues.iter().any(|row| row.len() != poles) {
            return Err(Error::field("response.residues", "needs one row a facet with one number a pole"));
        }
        Ok(ModeSet { poles: self.poles, residues: self.residues.concat() })
    }

    fn numbers(&self) -> impl Iterator<Item = &f64> {
        self.poles.iter().chain(self.residues.iter().flatten())
    }
}

impl Scene {
    /// Sets the poles and residues of the bounces.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub(super) fn set_response(&mut self, response: &Response) -> Result<()> {
        let record = match response.modes() {
            Modes::Shared(set) => ResponseRecord::Shared(set.into()),
            Modes::Separate(sets) => ResponseRecord::Separate { panels: sets.each_ref().map(Into::into) },
        };
        match &record {
            ResponseRecord::Shared(modes) => finite("response", modes.numbers())?,
            ResponseRecord::Separate { panels } => {
                finite("response", panels.iter().flat_map(ModesRecord::numbers))?;
            }
        }
        self.fields.set("response", record)
    }

    /// Poles and residues of the bounces.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or their shapes disagree.
    pub fn response(&self) -> Result<Response> {
        let record: ResponseRecord = self.fields.require("response", "make the scene with vkernel")?;
        let facets = self.fold()?.facets().len();
        Response::new(match record {
            ResponseRecord::Shared(modes) => Modes::Shared(modes.into_modes(facets)?),
            ResponseRecord::Separate { panels: [on_0, on_1] } => {
                Modes::Separate([on_0.into_modes(2 * facets)?, on_1.into_modes(2 * facets)?])
            }
        })
    }

    /// Sets the poles and residues of every source around a surface.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub(super) fn set_responses(&mut self, responses: &[SurfaceResponse]) -> Result<()> {
        let sources: Vec<ModesRecord> = responses.iter().map(|response| response.modes().into()).collect();
        finite("response", sources.iter().flat_map(ModesRecord::numbers))?;
        self.fields.set("response", ResponsesRecord { sources })
    }

    /// Poles and residues of every source around a surface that is no fold.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing, or do not fit facets and sources.
    pub fn responses(&self) -> Result<Vec<SurfaceResponse>> {
        let record: ResponsesRecord = self.fields.require("response", "make the scene with vkernel")?;
        let (facets, sources) = (self.facets()?, self.sources()?.len());
        if record.sources.len() != sources {
            let problem = format!("{} for {sources} sources of light", record.sources.len());
            return Err(Error::field("response.sources", problem));
        }
        let response = |modes: ModesRecord| SurfaceResponse::new(modes.into_modes(facets)?);
        record.sources.into_iter().map(response).collect()
    }
}
