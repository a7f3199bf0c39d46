//! What the samples of one scene need.

use std::sync::Arc;

use vfold::Result;
use vfold::estimate::prior::Prior;
use vfold::estimate::unknowns::{SceneModel, Unknown};
use vfold::scene::Setting;
use vfold::spectrum::{WavelengthGrid, have_one_peak};
use vfold::stream::Scene;

use super::flat::FlatContext;
use super::settings::Smoothness;

/// A scene with what its samples are estimated by.
pub struct Context {
    pub grid: WavelengthGrid,
    /// The scene as it was told, with what is to be fitted.
    pub told: SceneModel,
    pub method: SceneMethod,
    /// The reflectance to set out from, if one was given.
    pub start: Option<Vec<f64>>,
    /// The scene's record, if it is that of a fold.
    pub record: Option<Scene>,
    /// What no facet shows, in words.
    pub untold: String,
}

/// The method on the wavelengths of a scene.
pub enum SceneMethod {
    /// The prior, which scenes on the same wavelengths share.
    Map(Arc<Prior>),
    Smooth(Smoothness),
    Flat(FlatContext),
}

impl Context {
    /// That of a scene of which `fit` is unknown.
    pub fn new(
        scene: &Scene,
        method: SceneMethod,
        start: Option<Vec<f64>>,
        fit: &[&'static Unknown],
    ) -> Result<Self> {
        let record = scene.fold_if_one()?.map(|_| scene.clone());
        Ok(Self {
            grid: scene.grid()?,
            told: Setting::of(scene)?.model_to_fit(fit)?,
            method,
            start,
            record,
            untold: untold(scene)?,
        })
    }
}

/// Light and camera as the scene has them: no facet shows that they are others.
fn untold(scene: &Scene) -> Result<String> {
    let lights = scene.illuminants()?;
    let names: Vec<_> = lights.iter().map(|light| light.name.as_str()).collect();
    let whose = if scene.is_daylight_assumed()? { ", which nobody told," } else { "" };
    let camera = scene.camera()?;
    let scaled = if have_one_peak(camera.sensitivities.iter().map(Vec::as_slice)) {
        ", whose channels are each scaled to the same peak,"
    } else {
        ""
    };
    Ok(format!("the light {}{whose} and the camera {}{scaled}", names.join(", "), camera.name))
}
