//! A fold in its light, as a model with sources whose amounts depend on unknowns.

use super::sources::{Factors, FoldInLight, Sources};
use super::{Expected, Factor, Role, SceneModel, Unknown};
use crate::error::Result;
use crate::forward::FacetModel;

impl SceneModel {
    /// The model of facet RGB on a fold, with those of `fit` unknown that the scene leaves open.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if they cannot be fitted in the scene.
    pub fn of_fold(scene: &FoldInLight, fit: &[&'static Unknown]) -> Result<Self> {
        let (mut sources, mut unknowns) = (Sources::of(scene), Vec::new());
        for unknown in fit {
            let (prior, enter) = match unknown.role {
                Role::Exposure | Role::Photograph => continue,
                Role::Sources { prior, enter } => (prior, enter),
            };
            if let Some(prior) = prior(scene)? {
                enter(scene, prior, &mut sources)?;
                unknowns.push(Expected { unknown, prior });
            }
        }
        let (lit, factors): (Vec<_>, Vec<_>) = sources.on_states(&scene.lighting.light)?.into_iter().unzip();
        let responses: Vec<_> = sources.states.iter().map(|state| state.response.clone()).collect();
        let facets = FacetModel::new(&responses, &lit, scene.card.clone());
        let factor = |factors: &Factors, expected: &Expected| {
            let of = factors.iter().find(|(unknown, _)| *unknown == expected.unknown.name);
            of.map_or(Factor::One, |(_, factor)| *factor)
        };
        let factors = factors.iter().map(|f| unknowns.iter().map(|u| factor(f, u)).collect()).collect();
        Ok(Self::new(facets, unknowns, factors))
    }
}
