//! The model of a scene of which not all is known.

use super::Scene;
use crate::error::Result;
use crate::estimate::unknowns::{EXPOSURE, FoldInLight, SceneModel, Unknown};
use crate::kernel::mesh::Mesh;

impl Scene {
    /// The model of facet RGB with the numbers of `fit` unknown, as far as the scene leaves them open.
    ///
    /// # Errors
    /// As [`Scene::model`]; [`crate::Error::Field`] if the scene is not one in which they can be fitted.
    pub fn model_to_fit(&self, fit: &[&'static Unknown]) -> Result<SceneModel> {
        // The model is proportional to the exposure, whatever the surface.
        if fit.iter().all(|unknown| **unknown == EXPOSURE) {
            return Ok(SceneModel::known(self.model()?));
        }
        SceneModel::of_fold(&self.fold_in_light()?, fit)
    }

    /// The fold in its light.
    fn fold_in_light(&self) -> Result<FoldInLight> {
        let is_fine = self.has_accuracy() && self.mesh()? == Mesh::Auto.to_string();
        Ok(FoldInLight {
            fold: self.fold()?,
            response: self.response()?,
            tolerance: if is_fine { Some(self.tolerance()?) } else { None },
            lighting: self.lighting()?,
            has_sky_illuminant: self.has_sky_illuminant(),
            card: self.card()?,
            grid: self.grid()?,
            sensitivities: self.camera()?.sensitivities,
        })
    }
}
