//! The facet model of a fold: every mode of a panel's response contributes one or two terms, or three with a
//! card.

use nalgebra::{DMatrix, DVectorView};

use super::lighting::{Lighting, Lit};
use super::model::{FacetModel, Source};
use super::terms::{Card, Terms};
use crate::response::{Modes, Response};

impl FacetModel {
    /// A fold of one sheet.
    #[must_use]
    pub fn one_sheet(response: &Response, lighting: &Lighting) -> Self {
        Self::under(response, lighting, None)
    }

    /// A fold with a card of known `reflectance` (per waveband of the scene) as `panel` (0 or 1) and the
    /// sheet as the other.
    #[must_use]
    pub fn with_card(response: &Response, lighting: &Lighting, panel: usize, reflectance: Vec<f64>) -> Self {
        Self::under(response, lighting, Some(Card { panel, reflectance }))
    }

    fn under(response: &Response, lighting: &Lighting, card: Option<Card>) -> Self {
        let lights: Vec<Lit> =
            lighting.sources().map(|(light, camera)| Lit { response: 0, light, camera }).collect();
        Self::new(std::slice::from_ref(response), &lights, card)
    }

    /// A fold of one sheet, or of a sheet and a card, with one source per entry of `lights`. Several
    /// `responses` with equal numbers of facets describe the fold at several angles.
    #[must_use]
    pub fn new(responses: &[Response], lights: &[Lit], card: Option<Card>) -> Self {
        let poles = responses.iter().flat_map(Response::poles).collect();
        let odd = responses.iter().any(|response| matches!(response.modes(), Modes::Separate(_)))
            || lights.iter().any(|lit| lit.light.is_uneven());
        let terms = match card {
            None => Terms::One { poles, odd },
            Some(card) => Terms::Card { poles, card },
        };
        let first = |n: usize| responses[..n].iter().map(|response| response.poles().len()).sum();
        let sources = lights
            .iter()
            .map(|lit| source(&terms, &responses[lit.response], first(lit.response), lit))
            .collect();
        Self::of(terms, sources)
    }
}

/// A light on a fold, the poles of whose response begin at index `first`.
fn source(terms: &Terms, response: &Response, first: usize, lit: &Lit) -> Source {
    let mut facets = DMatrix::zeros(2 * response.facets(), terms.count());
    for panel in [0, 1] {
        let mut on_panel = facets.rows_mut(panel * response.facets(), response.facets());
        let mut set = |term, amount, residues: &DVectorView<f64>| {
            on_panel.column_mut(term).axpy(amount, residues, 0.0);
        };
        let (modes, residues) = (response.excitations(panel, lit.light), response.residues(panel));
        for ((k, mode), residues) in (first..).zip(modes).zip(residues.column_iter()) {
            match terms {
                Terms::Card { poles, card } => {
                    let own = if panel == card.panel { 2 } else { 0 };
                    set(own * poles.len() + k, mode.own, &residues);
                    set(poles.len() + k, mode.other, &residues);
                }
                Terms::One { poles, odd: true } => {
                    set(k, 0.5 * (mode.own + mode.other), &residues);
                    set(poles.len() + k, 0.5 * (mode.own - mode.other), &residues);
                }
                _ => set(k, 0.5 * (mode.own + mode.other), &residues),
            }
        }
    }
    Source { facets, camera: lit.camera.clone() }
}
