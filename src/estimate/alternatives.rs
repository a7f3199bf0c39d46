//! The same facets under several alternatives: one family of models, with each alternative a hypothesis.

use super::data::FacetData;
use super::facets::{Facets, Second};
use super::family::Family;
use super::gaussian::Gaussian;
use super::prior::Prior;

/// The facets as data under each alternative, at least one. Their weights of the terms are the same in all.
pub struct Alternatives<'a>(pub Vec<FacetData<'a>>);

impl Family for Alternatives<'_> {
    type Hypothesis = usize;
    type Second = Second;
    type Model<'m>
        = Facets<'m>
    where
        Self: 'm;

    fn model<'m>(&'m self, alternative: usize, gaussian: &'m Gaussian) -> Option<Facets<'m>> {
        self.0.get(alternative).map(|data| Facets { data, gaussian })
    }

    fn ln_class_shares(&self, alternative: usize, prior: &Prior) -> Vec<f64> {
        self.0[alternative].ln_class_shares((), prior)
    }

    fn tells_classes(&self) -> bool {
        self.0[0].tells_classes()
    }

    fn peak(&self) -> f64 {
        self.0[0].peak()
    }

    fn tolerance(&self) -> f64 {
        self.0[0].tolerance()
    }

    /// A single alternative is none.
    fn has_many_hypotheses(&self) -> bool {
        self.0.len() > 1
    }
}
