//! What the samples of one scene need.

use std::sync::Arc;

use vfold::Result;
use vfold::estimate::light::{Candidate, Others, Shown};
use vfold::estimate::measurement::Inference;
use vfold::estimate::prior::Prior;
use vfold::estimate::taking::Stated;
use vfold::estimate::unknowns::{SceneModel, Unknown};
use vfold::scene::{FoldSetting, Setting, stated};
use vfold::spectrum::WavelengthGrid;
use vfold::stream::Scene;

use super::flat::FlatContext;
use super::settings::Smoothness;

/// A scene with what its samples are estimated by.
pub struct Context {
    pub grid: WavelengthGrid,
    /// The scene as it was stated, with what is to be fitted.
    pub model: SceneModel,
    pub method: SceneMethod,
    /// The reflectance to set out from, if one was given.
    pub start: Option<Vec<f64>>,
    /// The scene's fold, if it is one.
    pub fold: Option<Box<FoldSetting>>,
    /// Light and camera.
    pub stated: Stated,
    /// What the light may be; none if it is known.
    pub lights: Vec<Candidate>,
    /// What else a light that was stated may be.
    pub other_lights: Option<Arc<Others>>,
    /// What a known fold shows of light and exposure.
    pub shown: Option<Shown>,
}

/// The method on the wavelengths of a scene.
pub enum SceneMethod {
    /// The prior, which scenes on the same wavelengths share.
    Map(Arc<Prior>),
    Smooth(Smoothness),
    Flat(FlatContext),
}

impl Context {
    /// That of a scene of which `fit` is unknown, and the light, if there are `lights`: the scene is in one
    /// of them; if not, in the light that it states, or perhaps in one of the others.
    pub fn new(
        scene: &Scene,
        method: SceneMethod,
        start: Option<Vec<f64>>,
        fit: &[&'static Unknown],
        (lights, other_lights, shown): (Vec<Candidate>, Option<Arc<Others>>, Option<Shown>),
    ) -> Result<Self> {
        let stated = stated(&scene.optics()?, scene.is_daylight_assumed()?);
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
            shown,
        })
    }

    /// How its samples are estimated under a prior, `is_auto` if what is fitted is up to the photograph.
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
            shown: self.shown.as_ref(),
            panel: self.fold.as_ref().map(|fold| fold.fold.facets()),
        }
    }
}

/// The fold among sources other than sun and uniform sky, as photographs of it are modelled; none if the
/// scene is no fold, or a part of it is known.
fn among_sources(scene: &Scene) -> Result<Option<FoldSetting>> {
    let is_whole = scene.fold_if_one()?.is_some() && scene.materials()?.is_empty();
    if is_whole { FoldSetting::of(scene).map(Some) } else { Ok(None) }
}
