//! What the samples of one scene need.

use std::sync::Arc;

use vfold::Result;
use vfold::estimate::prior::Prior;
use vfold::estimate::unknowns::{SUN_COLOUR, SceneModel, Unknown};
use vfold::scene::Setting;
use vfold::spectrum::{WavelengthGrid, have_one_peak};
use vfold::stream::{Sample, Scene};

use super::flat::FlatContext;
use super::other_angle::OtherAngle;
use super::settings::Smoothness;

/// A scene with what its samples are estimated by.
pub struct Context {
    pub grid: WavelengthGrid,
    pub told: Believed,
    /// In daylight of a colour that nobody said, if it is so.
    in_any_daylight: Option<Believed>,
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

/// A scene with what is unknown of it.
pub struct Believed {
    pub model: SceneModel,
    pub fit: Vec<&'static Unknown>,
    /// The same with its angle unknown, too.
    pub other_angle: OtherAngle,
}

impl Believed {
    fn new(scene: &Scene, fit: &[&'static Unknown]) -> Result<Self> {
        let model = Setting::of(scene)?.model_to_fit(fit)?;
        Ok(Self { model, fit: fit.to_vec(), other_angle: OtherAngle::default() })
    }
}

impl Context {
    /// That of a scene of which `fit` is unknown, and, where `is_auto`, the colour of daylight that was assumed.
    pub fn new(
        scene: &Scene,
        method: SceneMethod,
        start: Option<Vec<f64>>,
        (fit, is_auto): (&[&'static Unknown], bool),
    ) -> Result<Self> {
        let record = scene.fold_if_one()?.map(|_| scene.clone());
        let is_assumed = is_auto
            && record.is_some()
            && matches!(method, SceneMethod::Map(_))
            && scene.is_daylight_assumed()?;
        Ok(Self {
            grid: scene.grid()?,
            told: Believed::new(scene, fit)?,
            in_any_daylight: is_assumed.then(|| Believed::new(scene, &[&SUN_COLOUR])).transpose()?,
            method,
            start,
            record,
            untold: untold(scene)?,
        })
    }

    /// The scene as a sample is estimated in it: a chart or a card has made its channels those of the light that was assumed.
    pub fn believed(&self, sample: &Sample) -> &Believed {
        match &self.in_any_daylight {
            Some(believed) if !sample.fields.has("calibration") => believed,
            _ => &self.told,
        }
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
