//! A fold in its light, as a model with sources whose amounts depend on unknowns.

use super::sources::{Factors, FoldInLight, Sources};
use super::{Expected, Factor, Flag, Role, SceneModel, Unknown};
use crate::error::{Error, Result};
use crate::forward::FacetModel;

impl SceneModel {
    /// The model of facet RGB on a fold, with those of `fit` unknown that the scene leaves open.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if they cannot be fitted in the scene.
    pub fn of_fold(scene: &FoldInLight, fit: &[&'static Unknown]) -> Result<Self> {
        let (mut sources, mut unknowns) = (Sources::of(scene), Vec::new());
        for unknown in fit {
            let (Role::Sources { enter }, Some(effect)) = (&unknown.role, &unknown.photograph) else {
                continue;
            };
            if let Some(prior) = (effect.prior)(&scene.stated) {
                let tail = (effect.known)(&scene.stated).tail(scene.stated.priors);
                enter(scene, prior.normal, &mut sources)?;
                unknowns.push(Expected { unknown, prior: prior.with_tail(tail) });
            }
        }
        let is_fitted = |flag: &Flag| unknowns.iter().any(|one| one.unknown.flag == flag);
        let asked = fit.iter().filter(|unknown| matches!(unknown.role, Role::Sources { .. }));
        if let Some(Unknown { flag, .. }) = asked.into_iter().find(|unknown| !is_fitted(unknown.flag)) {
            let problem =
                format!("--fit {} needs one daylight; leave it out, or state --illuminant", flag.value);
            return Err(Error::field("illuminants", problem));
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
