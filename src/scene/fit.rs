//! The model of a scene of which not all is known.

use nalgebra::DVector;

use super::photograph::eye;
use super::{FoldSetting, Setting};
use crate::error::Result;
use crate::estimate::unknowns::{EXPOSURE, FoldInLight, SceneModel, Unknown};
use crate::kernel::mesh::Mesh;
use crate::stream::needs_fold;

impl Setting<'_> {
    /// The model of facet RGB with the numbers of `fit` unknown, as far as the scene leaves them open.
    ///
    /// # Errors
    /// As [`Setting::model`]; [`crate::Error::Field`] if the scene is not one in which they can be fitted.
    pub fn model_to_fit(&self, fit: &[&'static Unknown]) -> Result<SceneModel> {
        // The model is proportional to the exposure, whatever the surface.
        if fit.iter().all(|unknown| **unknown == EXPOSURE) {
            return Ok(SceneModel::known(self.model()?));
        }
        match self {
            Self::Fold(fold) => SceneModel::of_fold(&fold.in_light()?, fit),
            Self::Surface(_) => Err(needs_fold()),
        }
    }
}

impl FoldSetting<'_> {
    /// The fold in its light.
    fn in_light(&self) -> Result<FoldInLight> {
        let is_fine = self.scene.has_accuracy() && self.scene.mesh()? == Mesh::Auto.to_string();
        let (grid, mut illuminants) = (self.scene.grid()?, self.scene.illuminants()?);
        let sun = DVector::from_vec(illuminants.swap_remove(0).power);
        // pictures in other lights have a sun each
        let daylight = if illuminants.is_empty() { eye::daylight(&eye::vectors(&grid)?, &sun) } else { None };
        Ok(FoldInLight {
            sun_power: sun.data.into(),
            daylight,
            fold: *self.fold(),
            response: self.response()?,
            tolerance: if is_fine { Some(self.scene.tolerance()?) } else { None },
            lighting: self.lighting()?,
            has_sky_illuminant: self.scene.sky_illuminant()?.is_some(),
            card: self.card()?,
            grid,
            sensitivities: self.scene.camera()?.sensitivities,
        })
    }
}
