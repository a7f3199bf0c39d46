//! Common context of the samples of one scene.

use std::sync::Arc;

use vfold::Result;
use vfold::estimate::light::{Candidate, Others, Shown};
use vfold::estimate::measurement::Inference;
use vfold::estimate::other_camera::OtherCameras;
use vfold::estimate::prior::Prior;
use vfold::estimate::taking::Stated;
use vfold::estimate::unknowns::{SceneModel, Unknown};
use vfold::scene::{FoldSetting, Setting, other_cameras, stated};
use vfold::spectrum::WavelengthGrid;
use vfold::stream::Scene;

use super::flat::FlatContext;
use super::settings::Smoothness;

/// A scene with everything needed to estimate its samples.
pub struct Context {
    pub grid: WavelengthGrid,
    /// The scene as stated, with the unknowns to be fitted.
    pub model: SceneModel,
    pub method: SceneMethod,
    /// The initial reflectance, if stated.
    pub start: Option<Vec<f64>>,
    /// The scene's fold, if it is one.
    pub fold: Option<Box<FoldSetting>>,
    /// Light and camera.
    pub stated: Stated,
    /// Candidates for the light; empty if it is known.
    pub lights: Vec<Candidate>,
    /// Alternatives to a stated light.
    pub other_lights: Option<Arc<Others>>,
    /// Alternatives to the stated camera.
    pub other_cameras: Option<OtherCameras>,
    /// Light and exposure inferred from a known fold.
    pub shown: Option<Shown>,
}

/// The method on the wavelengths of a scene.
pub enum SceneMethod {
    /// The prior, shared by scenes on the same wavelengths.
    Map(Arc<Prior>),
    Smooth(Smoothness),
    Flat(FlatContext),
}

impl Context {
    /// The context of a scene in which `fit` is unknown, and the light, if there are `lights`: the scene is
    /// in one of them; otherwise in the light that it states, or perhaps in one of the others.
    pub fn new(
        scene: &Scene,
        method: SceneMethod,
        start: Option<Vec<f64>>,
        fit: &[&'static Unknown],
        (lights, other_lights, shown): (Vec<Candidate>, Option<Arc<Others>>, Option<Shown>),
    ) -> Result<Self> {
        let optics = scene.optics()?;
        let stated = stated(&optics, scene.is_daylight_assumed()?);
        let setting = Setting::of(scene)?;
        Ok(Self {
            grid: scene.grid()?,
            model: setting.model_to_fit(fit)?,
            method,
            start,
            fold: match setting {
                Setting::Fold(fold) => Some(fold),
                Setting::Surface(_) => among_sources(scene)?.map(Box::new),
            },
            stated: if lights.is_empty() { stated } else { stated.but_light() },
            lights,
            other_lights,
            other_cameras: other_cameras(&optics),
            shown,
        })
    }

    /// The inference for its samples under a prior; `is_auto` if the photograph determines what is fitted.
    pub fn inference<'a>(&'a self, prior: &'a Prior, is_auto: bool) -> Inference<'a> {
        Inference {
            model: &self.model,
            wavelengths_nm: self.grid.wavelengths_nm(),
            prior,
            start: self.start.as_deref(),
            is_auto,
            stated: &self.stated,
            lights: &self.lights,
            other_lights: self.other_lights.as_deref(),
            other_cameras: self.other_cameras.as_ref(),
            shown: self.shown.as_ref(),
            panel: self.fold.as_ref().map(|fold| fold.fold.facets()),
        }
    }
}

/// The fold among sources other than sun and uniform sky, as modelled in photographs; none if the scene is no
/// fold, or a part of it is known.
fn among_sources(scene: &Scene) -> Result<Option<FoldSetting>> {
    let is_whole = scene.fold_if_one()?.is_some() && scene.materials()?.is_empty();
    if is_whole { FoldSetting::of(scene).map(Some) } else { Ok(None) }
}
