//! Common context of the samples of one scene.

use std::sync::Arc;

use vfold::Result;
use vfold::estimate::measurement::Inference;
use vfold::estimate::prior::Prior;
use vfold::scene::{FoldSetting, Setting};
use vfold::stream::Scene;

use super::flat::FlatContext;
use super::settings::Smoothness;

/// A scene with everything needed to estimate its samples.
pub struct Context {
    pub inference: Inference,
    pub method: SceneMethod,
    /// The scene's fold, if it is one.
    pub fold: Option<Box<FoldSetting>>,
}

/// The method on the wavelengths of a scene.
pub enum SceneMethod {
    /// The prior, shared by scenes on the same wavelengths.
    Map(Arc<Prior>),
    Smooth(Smoothness),
    Flat(FlatContext),
}

/// The fold of a scene; one among sources other than sun and uniform sky as modelled in photographs. None if
/// the scene is no fold, or a part of it is known.
pub fn fold_of(scene: &Scene, setting: Setting) -> Result<Option<Box<FoldSetting>>> {
    match setting {
        Setting::Fold(fold) => Ok(Some(fold)),
        Setting::Surface(_) if scene.fold_if_one()?.is_some() && scene.materials()?.is_empty() => {
            FoldSetting::of(scene).map(|fold| Some(Box::new(fold)))
        }
        Setting::Surface(_) => Ok(None),
    }
}
