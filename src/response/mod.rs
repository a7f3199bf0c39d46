//! Interreflections for all reflectances at once.
//!
//! With one reflectance r, eq. (16) is `L = (r/π)(I − rK)⁻¹E₀`. Lanczos on K from E₀ turns it into a few
//! poles and residues, `L = (r/π) Σ A_k/(1 − r g_k)`, the same for every wavelength: eqs. (26) to (28)
//! without the modes that the light does not excite. A [`Response`] holds those of any light on a fold.

mod fold;
mod lanczos;
mod orthogonality;
mod panel;

pub use fold::{Excitation, ModeLight, Modes, Response};
pub(crate) use lanczos::{Excited, orthogonalise};
pub use panel::PanelOperator;

use nalgebra::DMatrix;

use crate::error::{Error, Result};

/// Poles and residues: facet i receives `Σ_k residue_ik / (1 − r·pole_k)`.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeSet {
    /// Poles g in (−1, 1): the share of its light that a mode passes on.
    pub poles: Vec<f64>,
    /// Facet by pole.
    pub residues: DMatrix<f64>,
}

impl ModeSet {
    /// The modes of a light that does not reach the surface.
    #[must_use]
    pub fn none(facets: usize) -> Self {
        Self { poles: Vec::new(), residues: DMatrix::zeros(facets, 0) }
    }

    /// Rejects inconsistent shapes, and poles for which the bounces would diverge.
    pub(crate) fn check(&self) -> Result<()> {
        if self.residues.is_empty() || self.residues.ncols() != self.poles.len() {
            let problem = "needs one row per facet, with one number per pole";
            return Err(Error::field("response.residues", problem));
        }
        if self.poles.iter().all(|pole| pole.abs() < 1.0) {
            Ok(())
        } else {
            let problem = "a pole outside (-1, 1): bounces would not end; make the scene again with vkernel";
            Err(Error::field("response.poles", problem))
        }
    }

    /// Poles with their residues at a facet.
    pub(crate) fn of_facet(&self, facet: usize) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.poles.iter().enumerate().map(move |(k, pole)| (*pole, self.residues[(facet, k)]))
    }
}
