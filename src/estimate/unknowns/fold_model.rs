//! A fold in its light, as a model with sources whose amounts depend on unknowns.

use super::sources::{Factors, FoldInLight, Sources};
use super::{Expected, Factor, Flag, Role, SceneModel, Unknown};
use crate::error::{Error, Result};
use crate::forward::FacetModel;

impl SceneModel {
    /// The model of facet RGB on a fold, with those of `fit` unknown that the scene leaves open.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if they cannot be fitted in the scene, or it leaves open none of those that
    /// are fitted together.
    pub fn of_fold(scene: &FoldInLight, fit: &[&'static Unknown]) -> Result<Self> {
        let asked = || fit.iter().filter(|unknown| matches!(unknown.role, Role::Sources { .. }));
        let expected = |unknown: &&'static Unknown| {
            let tail = (unknown.known)(&scene.stated).tail(scene.stated.priors);
            Some(Expected { unknown, prior: (unknown.prior)(&scene.stated)?.with_tail(tail) })
        };
        let unknowns: Vec<Expected> = asked().filter_map(expected).collect();
        let is_open = |flag: &Flag| unknowns.iter().any(|one| one.unknown.flag == flag);
        if let Some(Unknown { flag, .. }) = asked().find(|unknown| !is_open(unknown.flag)) {
            let light = "in light that is not one daylight";
            let problem = format!("{light} --fit {} has nothing to fit; leave it out", flag.value);
            return Err(Error::field("illuminants", problem));
        }
        let mut sources = Sources::of(scene);
        for Expected { unknown, prior } in &unknowns {
            if let Role::Sources { enter, .. } = unknown.role {
                enter(scene, prior.normal, &mut sources)?;
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
