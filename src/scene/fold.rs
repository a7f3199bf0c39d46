//! A fold under sun and sky: its response, its lights and its camera, with a card of known reflectance if it has one.

use super::camera::{illuminant_responses, sky_response};
use crate::camera::CameraResponse;
use crate::error::{Error, Result};
use crate::forward::{Card, FacetModel, Lighting};
use crate::geometry::{FacetGrid, Fold, Light, Spacing};
use crate::kernel::mesh::{Mesh, respond};
use crate::response::Response;
use crate::stream::Scene;

/// Relative error of the light in a picture: below its noise.
const PICTURE_TOLERANCE: f64 = 1e-4;

/// A fold under sun and sky before a camera.
pub struct FoldSetting<'a> {
    pub(super) scene: &'a Scene,
    fold: Fold,
}

impl<'a> FoldSetting<'a> {
    pub(super) fn new(scene: &'a Scene, fold: Fold) -> Self {
        Self { scene, fold }
    }

    /// That of a scene's record.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not that of a fold.
    pub fn of(scene: &'a Scene) -> Result<Self> {
        Ok(Self::new(scene, scene.fold()?))
    }

    /// The record of the scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        self.scene
    }

    /// Whether the colour of the sky is given.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a spectrum.
    pub fn has_sky_illuminant(&self) -> Result<bool> {
        Ok(self.scene.sky_illuminant()?.is_some())
    }

    /// Whether its light is daylight that was assumed, as nobody told it.
    ///
    /// # Errors
    /// [`Error::Field`] if that is neither true nor false.
    pub fn is_daylight_assumed(&self) -> Result<bool> {
        self.scene.is_daylight_assumed()
    }

    /// The fold and its facets.
    #[must_use]
    pub fn fold(&self) -> &Fold {
        &self.fold
    }

    /// Sun and sky.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing or leave a panel unlit.
    pub fn light(&self) -> Result<Light> {
        self.scene.light_on(&self.fold)
    }

    /// What all bounces make of light.
    ///
    /// # Errors
    /// [`Error::Field`] if it is missing or does not fit the facets.
    pub fn response(&self) -> Result<Response> {
        self.scene.response_of(&self.fold)
    }

    /// Sun and sky as the camera responds to them.
    ///
    /// # Errors
    /// [`Error::Field`] if camera or illuminants are missing or not on the scene's wavelengths.
    pub fn lighting(&self) -> Result<Lighting> {
        let light = self.light()?;
        let sun = CameraResponse::of_pictures(illuminant_responses(self.scene)?);
        let sky = sky_response(self.scene, &sun)?;
        Ok(Lighting { light, sun, sky })
    }

    pub(super) fn pictures(&self) -> Result<usize> {
        Ok(self.scene.illuminants()?.len())
    }

    pub(super) fn model(&self) -> Result<FacetModel> {
        self.model_with(&self.response()?, &self.lighting()?)
    }

    pub(super) fn model_seen_by(&self, eye: &CameraResponse) -> Result<FacetModel> {
        let lighting = Lighting { light: self.light()?, sun: eye.clone(), sky: eye.clone() };
        self.model_with(&self.response()?, &lighting)
    }

    /// The model under `lighting` with other facets, finer than those of the scene, for pictures.
    ///
    /// # Errors
    /// As [`Setting::model`](super::Setting::model).
    pub fn fine_model(&self, grid: FacetGrid, lighting: &Lighting) -> Result<FacetModel> {
        let fold = self.fold.with_facets(grid)?.with_spacing(Spacing::Uniform);
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
        if !self.scene.materials()?.is_empty() {
            let problem =
                "a fold has panels and no groups; say which is known with --panel-reflectance P=SPEC";
            return Err(Error::field("materials", problem));
        }
        let card = self.scene.reference_panel()?;
        Ok(card.map(|card| Card { panel: card.panel, reflectance: card.reflectance }))
    }
}
