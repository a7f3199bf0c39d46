//! What an estimate leaves of the facets, computed from the records: scene, estimate and what facets were taken to be worth.

use super::estimate::EstimateRecord;
use super::fit::Fit;
use super::noise::NoiseRecord;
use super::{Colours, Sample, Scene};
use crate::error::{Error, Result};
use crate::estimate::unknowns::{Expected, SceneModel, Unknown};
use crate::forward::FacetModel;

impl Sample {
    /// Measured minus estimated facets in units of their standard deviations: facet by channel, none for a facet that was not
    /// measured; none at all without an estimate.
    ///
    /// # Errors
    /// [`Error::Field`] if estimate and facets do not fit the scene.
    pub fn residuals(&self, scene: &Scene) -> Result<Option<Colours>> {
        let Some(estimate) = self.estimate()? else { return Ok(None) };
        let (model, measured) = (estimate.scene_model(scene)?, self.facet_rgb()?);
        let (given, model_error) = match &estimate.noise {
            Some(NoiseRecord { sd, model_error, .. }) => (*sd, Some(*model_error)),
            None => (None, None),
        };
        let sd = self.noise(given, model_error)?.deviations(model.facets(), &measured)?;
        let fitted = estimate.facets(&estimate.at_fit(&model))?;
        if fitted.len() != measured.len() {
            let problem = format!("{} facets for a scene of {}", measured.len(), fitted.len());
            return Err(Error::field("facet_rgb", problem));
        }
        let residuals = measured.iter().zip(&sd).zip(&fitted).map(|((rgb, sd), fitted)| {
            let of =
                |((value, sd), fitted): ((&f64, &f64), &f64)| (value - fitted) / sd.max(f64::MIN_POSITIVE);
            Some(rgb.as_ref()?.iter().zip(sd.as_ref()?).zip(fitted).map(of).collect())
        });
        Ok(Some(residuals.collect()))
    }
}

impl EstimateRecord {
    /// The model that the estimate was made with.
    fn scene_model(&self, scene: &Scene) -> Result<SceneModel> {
        let fitted: Vec<_> = self.fit.iter().flat_map(Fit::iter).map(|(unknown, _)| unknown).collect();
        scene.model_to_fit(&fitted)
    }

    /// The model where the estimate is.
    fn at_fit(&self, model: &SceneModel) -> FacetModel {
        let found = |unknown: &Unknown| self.fit.iter().flat_map(Fit::iter).find(|(one, _)| *one == unknown);
        let value = |expected: &Expected| {
            found(expected.unknown).map_or(expected.at(0.0).0, |(_, fitted)| fitted.value)
        };
        model.with_values(&model.unknowns().iter().map(value).collect::<Vec<f64>>())
    }

    fn facets(&self, model: &FacetModel) -> Result<Vec<Vec<f64>>> {
        if self.reflectance.len() != model.bands() {
            let problem = format!("{} values for {} wavebands", self.reflectance.len(), model.bands());
            return Err(Error::field("estimate.reflectance", problem));
        }
        let exposure = self
            .exposure
            .ok_or_else(|| Error::field("estimate.exposure", "missing; estimate the sample again"))?;
        let rgb = model.facet_rgb(&self.reflectance);
        Ok(rgb.row_iter().map(|row| row.iter().map(|value| exposure * value).collect()).collect())
    }
}
