//! The model of a scene with unknown parameters.

use std::borrow::Cow;

use nalgebra::DVector;

use super::fold::backing;
use super::photograph::eye;
use super::{FoldSetting, Setting};
use crate::error::{Error, Result};
use crate::estimate::photograph::conditions::Daylight;
use crate::estimate::photograph::priors::Priors;
use crate::estimate::unknowns::{EXPOSURE, FoldInLight, SceneModel, Unknown};
use crate::stream::{Optics, needs_fold};

impl Setting<'_> {
    /// The model of facet RGB with the parameters of `fit` unknown, as far as the scene leaves them open.
    ///
    /// # Errors
    /// As [`Setting::model`]; [`crate::Error::Field`] if they cannot be fitted in the scene.
    pub fn model_to_fit(&self, fit: &[&'static Unknown]) -> Result<SceneModel> {
        // The model is proportional to the exposure, whatever the surface.
        let model = if fit.iter().all(|unknown| **unknown == EXPOSURE) {
            SceneModel::known(self.model()?)
        } else {
            match self {
                Self::Fold(fold) => SceneModel::of_fold(&fold.in_light()?, fit)?,
                Self::Surface(surface) if surface.scene.fold_if_one()?.is_some() => {
                    let problem = "in light other than a sun and a uniform sky only the exposure \
                                   can be fitted; leave --fit out";
                    return Err(Error::field("light", problem));
                }
                Self::Surface(_) => return Err(needs_fold()),
            }
        };
        let (optics, backing) = match self {
            Self::Fold(fold) => (Cow::Borrowed(fold.optics()?), fold.backing),
            Self::Surface(surface) => (Cow::Owned(surface.scene.optics()?), backing(surface.scene)?),
        };
        // in several lights a sheet emits different amounts, and the camera's errors are shared
        Ok(match optics.illuminants.as_slice() {
            [one] => model
                .under(optics.grid.wavelengths_nm(), &one.power, backing)
                .seen_with(eye::relative_errors(&optics, &Priors::USUAL)),
            _ => model,
        })
    }
}

impl FoldSetting {
    /// The fold in its light.
    fn in_light(&self) -> Result<FoldInLight> {
        let Optics { grid, camera, illuminants, .. } = self.optics()?;
        let sun = DVector::from_column_slice(&illuminants[0].power);
        // pictures in several lights have several suns
        let daylight_vectors = eye::vectors(grid)?;
        let daylight = if illuminants.len() == 1 { Daylight::of(&daylight_vectors, &sun) } else { None };
        let stated = self.stated(&Priors::USUAL, camera.sensitivities.len(), daylight);
        Ok(FoldInLight {
            sun_power: sun,
            daylight_vectors,
            stated,
            fold: self.fold,
            response: self.response.clone(),
            tolerance: self.tolerance,
            lighting: self.lighting()?,
            card: self.card.clone(),
            grid: grid.clone(),
            sensitivities: camera.sensitivities.clone(),
        })
    }
}
