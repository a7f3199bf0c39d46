//! A fold under sun and sky: its response, lights and camera, and a card of known reflectance if it has one.

use super::camera::{illuminant_responses, sky_response};
use super::stated_light::{StatedLight, StatedSky};
use crate::camera::CameraResponse;
use crate::error::{Error, Result};
use crate::estimate::emission::Backing;
use crate::estimate::photograph::StatedScene;
use crate::estimate::photograph::conditions::{Daylight, SkyKind};
use crate::estimate::photograph::day::Day;
use crate::estimate::photograph::priors::Priors;
use crate::forward::{Card, FacetModel, Lighting};
use crate::geometry::{FacetGrid, Fold, Light, Spacing};
use crate::kernel::mesh::{Mesh, respond};
use crate::kernel::panels::is_of_fold;
use crate::response::Response;
use crate::stream::{Optics, Scene};

/// Relative error of the light in a picture, below its noise.
const PICTURE_TOLERANCE: f64 = 1e-4;

/// A fold under sun and sky, and in front of a camera once there is one.
#[derive(Clone, Debug)]
pub struct FoldSetting {
    /// The fold and its facets.
    pub fold: Fold,
    /// Standard deviation of the fold's angle, degrees, if it is known.
    pub angle_sd_deg: Option<f64>,
    /// Sun and sky.
    pub light: Light,
    /// The stated sky, if it is not uniform.
    pub sky: Option<StatedSky>,
    /// True if lights other than one sun and one sky were stated.
    pub is_lit_otherwise: bool,
    /// Response to light, all bounces included.
    pub response: Response,
    /// Camera and illuminants, if there is a camera and the light is known.
    pub optics: Option<Optics>,
    /// True if the illuminant is assumed to be daylight, because none was stated.
    pub is_daylight_assumed: bool,
    /// What is behind the sheet.
    pub backing: Backing,
    /// The card that a panel is, if it is one.
    pub card: Option<Card>,
    /// Relative error to which folds of other angles are solved; `None` if they are to be divided like this
    /// one.
    pub tolerance: Option<f64>,
}

/// What is behind a scene's sheet.
pub(super) fn backing(scene: &Scene) -> Result<Backing> {
    Ok(if scene.is_backed()? { Backing::Black } else { Backing::Unknown })
}

/// The response in a scene's record.
///
/// # Errors
/// As [`Scene::response_of`]; [`Error::Field`] if it is exact, but of another fold.
fn response_of(scene: &Scene, fold: &Fold) -> Result<Response> {
    let response = scene.response_of(fold)?;
    if scene.has_exact_form_factors()? && !is_of_fold(&response, fold) {
        let problem = "not that of this geometry; make the scene again with vkernel";
        return Err(Error::field("response", problem));
    }
    Ok(response)
}

impl FoldSetting {
    /// From a scene's record; a fold among light sources is simplified to what photographs of it assume.
    ///
    /// # Errors
    /// [`Error::Field`] if the record is not that of a fold, or a part of it is missing or impossible.
    pub fn of(scene: &Scene) -> Result<Self> {
        Self::with_fold(scene, scene.fold()?)
    }

    pub(super) fn with_fold(scene: &Scene, fold: Fold) -> Result<Self> {
        // a fold without a camera or a known light still has panels
        let is_lit = scene.has_camera() && !scene.is_light_unknown()?;
        let is_fine = scene.has_accuracy() && scene.mesh()? == Mesh::Auto.to_string();
        let (StatedLight { light, sky, is_other }, response) = if scene.has_sources() {
            let (response, _) = respond(&fold, PICTURE_TOLERANCE)?;
            (StatedLight::of(&scene.sources()?, &fold)?, response)
        } else {
            (scene.light_on(&fold)?.into(), response_of(scene, &fold)?)
        };
        Ok(Self {
            angle_sd_deg: scene.angle_sd_deg()?,
            light,
            sky,
            is_lit_otherwise: is_other,
            response,
            optics: if is_lit { Some(scene.optics()?) } else { None },
            is_daylight_assumed: scene.is_daylight_assumed()?,
            backing: backing(scene)?,
            card: if is_lit && !scene.has_sources() { card(scene)? } else { None },
            tolerance: if is_fine { Some(scene.tolerance()?) } else { None },
            fold,
        })
    }

    /// Camera and illuminants.
    ///
    /// # Errors
    /// [`Error::Field`] if there is no camera, or the light is unknown.
    pub fn optics(&self) -> Result<&Optics> {
        let missing = || {
            Error::field(
                "camera",
                "camera or light is missing; give --camera and --illuminant to vforward or vextract",
            )
        };
        self.optics.as_ref().ok_or_else(missing)
    }

    /// Everything stated about the fold and its light, with an unknown exposure.
    pub(super) fn stated(
        &self,
        priors: &'static Priors,
        channels: usize,
        daylight: Option<Daylight>,
    ) -> StatedScene {
        let Self { fold, light, .. } = self;
        let sun = light.towards();
        StatedScene {
            priors,
            exposure: None,
            metered: None,
            by_paper: None,
            by_chart: false,
            channels,
            angle_deg: fold.angle_deg(),
            angle_sd_deg: self.angle_sd_deg.unwrap_or(priors.angle_sd_deg),
            tilt_deg: light.tilt_deg(),
            daylight,
            is_daylight_assumed: self.is_daylight_assumed,
            sky: Some(light.sky()).filter(|sky| *sky > 0.0),
            sky_kind: self.sky.as_ref().map(|sky| SkyKind {
                is_overcast: sky.is_overcast,
                elevation_deg: sky.zenith.dot(&sun).clamp(-1.0, 1.0).asin().to_degrees(),
                is_zenith_stated: sky.is_zenith_stated(),
            }),
            sun: light.sun(),
            has_sky_illuminant: self.optics.as_ref().is_some_and(|optics| optics.sky.is_some()),
            backing: self.backing,
            day: Day::Clear,
            shown: None,
        }
    }

    /// Sun and sky as the camera responds to them.
    ///
    /// # Errors
    /// [`Error::Field`] if there is no camera, or camera and illuminants are not on the same wavelengths.
    pub fn lighting(&self) -> Result<Lighting> {
        let optics = self.optics()?;
        let sun = CameraResponse::of_pictures(illuminant_responses(optics)?);
        let sky = sky_response(optics, &sun)?;
        Ok(Lighting { light: self.light, sun, sky })
    }

    pub(super) fn pictures(&self) -> Result<usize> {
        Ok(self.optics()?.illuminants.len())
    }

    /// The model of facet RGB.
    ///
    /// # Errors
    /// As [`FoldSetting::lighting`].
    pub fn model(&self) -> Result<FacetModel> {
        Ok(self.model_with(&self.response, &self.lighting()?))
    }

    pub(super) fn model_seen_by(&self, eye: &CameraResponse) -> FacetModel {
        let lighting = Lighting { light: self.light, sun: eye.clone(), sky: eye.clone() };
        self.model_with(&self.response, &lighting)
    }

    /// The model under `lighting` with other facets, finer than the scene's, for pictures.
    ///
    /// # Errors
    /// As [`respond`].
    pub fn fine_model(&self, grid: FacetGrid, lighting: &Lighting) -> Result<FacetModel> {
        let fold = self.fold.with_facets(grid)?.with_spacing(Spacing::Uniform);
        let (response, _) = respond(&fold, PICTURE_TOLERANCE)?;
        Ok(self.model_with(&response, lighting))
    }

    fn model_with(&self, response: &Response, lighting: &Lighting) -> FacetModel {
        match &self.card {
            None => FacetModel::one_sheet(response, lighting),
            Some(Card { panel, reflectance }) => {
                FacetModel::with_card(response, lighting, *panel, reflectance.clone())
            }
        }
    }
}

/// The card in place of a panel, if there is one.
fn card(scene: &Scene) -> Result<Option<Card>> {
    if !scene.materials()?.is_empty() {
        let problem = "a fold has panels, not groups; state known ones with --panel-reflectance P=SPEC";
        return Err(Error::field("materials", problem));
    }
    let card = scene.reference_panel()?;
    Ok(card.map(|card| Card { panel: card.panel, reflectance: card.reflectance }))
}
