//! The same facets under several alternatives: one family of models, with each alternative a hypothesis.

use std::cell::LazyCell;

use super::data::FacetData;
use super::facets::{Facets, Second};
use super::family::Family;
use super::gaussian::Gaussian;
use super::prior::Prior;

/// The facets as data under each alternative, at least one, computed on first use. Their weights of the terms
/// are the same in all.
pub struct Alternatives<'s, 'a>(Vec<LazyCell<FacetData<'a>, Computed<'s, 'a>>>);

/// What computes the facets under an alternative.
type Computed<'s, 'a> = Box<dyn FnOnce() -> FacetData<'a> + 's>;

impl<'s, 'a> Alternatives<'s, 'a> {
    /// Alternatives computed by these functions.
    pub fn of<C: FnOnce() -> FacetData<'a> + 's>(all: impl IntoIterator<Item = C>) -> Self {
        Self(all.into_iter().map(|one| LazyCell::new(Box::new(one) as Computed)).collect())
    }

    /// The facets under an alternative.
    pub fn get(&self, alternative: usize) -> &FacetData<'a> {
        &self.0[alternative]
    }
}

impl Family for Alternatives<'_, '_> {
    type Hypothesis = usize;
    type Second = Second;
    type Model<'m>
        = Facets<'m>
    where
        Self: 'm;

    fn model<'m>(&'m self, alternative: usize, gaussian: &'m Gaussian) -> Option<Facets<'m>> {
        Some(Facets { data: self.get(alternative), gaussian })
    }

    fn ln_class_shares(&self, alternative: usize, prior: &Prior) -> Vec<f64> {
        self.get(alternative).ln_class_shares((), prior)
    }

    fn channels(&self) -> usize {
        self.get(0).channels()
    }

    fn peak(&self) -> f64 {
        self.get(0).peak()
    }

    fn tolerance(&self) -> f64 {
        self.get(0).tolerance()
    }

    /// A single alternative is none.
    fn has_many_hypotheses(&self) -> bool {
        self.0.len() > 1
    }
}
