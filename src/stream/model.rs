//! The model of a scene: its response, its lights and its camera, with a card of known reflectance if a fold has one.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scene;
use super::fields::finite;
use crate::camera::CameraResponse;
use crate::error::{Error, Result};
use crate::forward::{Card, FacetModel, Lighting};
use crate::geometry::{FacetGrid, Spacing};
use crate::kernel::mesh::{Mesh, respond};
use crate::response::Response;

/// Relative error of the light in a picture: below its noise.
const PICTURE_TOLERANCE: f64 = 1e-4;

/// A card of known reflectance in the place of one panel, on the scene's wavelengths.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema, PartialEq)]
pub struct ReferencePanel {
    /// The card's panel; the other is the sheet.
    #[serde(default = "panel_1")]
    #[schemars(range(min = 0, max = 1))]
    panel: usize,
    /// Built-in name or file.
    name: String,
    /// Reflectance, a number a waveband.
    #[schemars(inner(range(min = 0, max = 1)))]
    reflectance: Vec<f64>,
}

fn panel_1() -> usize {
    1
}

impl ReferencePanel {
    /// A card on `panel`, 0 or 1, with its reflectance a waveband.
    #[must_use]
    pub fn new(panel: usize, name: &str, reflectance: Vec<f64>) -> Self {
        Self { panel, name: name.to_owned(), reflectance }
    }
}

impl Scene {
    /// Says that a panel is a card of known reflectance.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_reference_panel(&mut self, card: &ReferencePanel) -> Result<()> {
        finite("reference_panel", &card.reflectance)?;
        self.fields.set("reference_panel", card)
    }

    /// The model of facet RGB: of one sheet, or of a sheet and what is known beside it.
    ///
    /// # Errors
    /// [`Error::Field`] if a part of the scene is missing or does not fit the others.
    pub fn model(&self) -> Result<FacetModel> {
        if self.is_fold()? {
            self.model_with(&self.response()?, &self.lighting()?)
        } else {
            self.surface_model()
        }
    }

    /// The same as one `eye` sees it in all lights.
    ///
    /// # Errors
    /// As [`Scene::model`].
    pub fn model_seen_by(&self, eye: &CameraResponse) -> Result<FacetModel> {
        if self.is_fold()? {
            let lighting = Lighting { light: self.light()?, sun: eye.clone(), sky: eye.clone() };
            self.model_with(&self.response()?, &lighting)
        } else {
            self.surface_model_seen_by(vec![eye.clone(); self.sources()?.len()])
        }
    }

    /// The same under `lighting` with other facets, finer than those of the scene, for pictures.
    ///
    /// # Errors
    /// As [`Scene::model`].
    pub fn fine_model(&self, grid: FacetGrid, lighting: &Lighting) -> Result<FacetModel> {
        let fold = self.fold()?.with_facets(grid)?.with_spacing(Spacing::Uniform);
        let (response, _) = respond(&fold, Mesh::Auto, PICTURE_TOLERANCE)?;
        self.model_with(&response, lighting)
    }

    fn model_with(&self, response: &Response, lighting: &Lighting) -> Result<FacetModel> {
        Ok(match self.card()? {
            None => FacetModel::one_sheet(response, lighting),
            Some(Card { panel, reflectance }) => {
                FacetModel::with_card(response, lighting, panel, reflectance)
            }
        })
    }

    /// The card, if a panel is one.
    pub(super) fn card(&self) -> Result<Option<Card>> {
        if !self.materials()?.is_empty() {
            let problem =
                "a fold has panels and no groups; say which is known with --panel-reflectance P=SPEC";
            return Err(Error::field("materials", problem));
        }
        let Some(card) = self.fields.get::<ReferencePanel>("reference_panel")? else { return Ok(None) };
        if card.panel > 1 {
            return Err(Error::field("reference_panel.panel", format!("{} is neither 0 nor 1", card.panel)));
        }
        if card.reflectance.len() != self.grid()?.len()
            || !card.reflectance.iter().all(|r| (0.0..=1.0).contains(r))
        {
            return Err(Error::field("reference_panel.reflectance", "needs a number from 0 to 1 a waveband"));
        }
        Ok(Some(Card { panel: card.panel, reflectance: card.reflectance }))
    }
}
