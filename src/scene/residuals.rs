//! Residuals of an estimate's facets, computed from the records: scene, estimate and the assumed noise.

use nalgebra::DMatrix;

use super::Setting;
use crate::error::{Error, Result, counted};
use crate::estimate::measured::check_shape;
use crate::estimate::unknowns::Unknown;
use crate::forward::{FacetModel, FacetValues};
use crate::stream::{EstimateRecord, Sample, Scene};

/// Measured minus estimated facets in units of their standard deviations; `None` if the sheet was not assumed
/// to be ideal.
///
/// # Errors
/// [`Error::Field`] if estimate or facets do not fit the scene.
pub fn residuals(sample: &Sample, estimate: &EstimateRecord, scene: &Scene) -> Result<Option<FacetValues>> {
    let fit: Vec<_> = estimate.fitted().map(|(unknown, _)| unknown).collect();
    // Residuals of a real sheet are judged against a correlated error: facet by facet they say little.
    if fit.iter().any(|unknown| unknown.is_of_photographs()) {
        return Ok(None);
    }
    let lit = estimate.lit(scene)?;
    let scene = lit.as_ref().unwrap_or(scene);
    let (model, measured) = (Setting::of(scene)?.model_to_fit(&fit)?, sample.facet_rgb()?);
    let sd = sample.noise_of(estimate)?.deviations(model.facets(), &measured)?;
    let found =
        |wanted: &Unknown| estimate.fitted().find(|(unknown, _)| *unknown == wanted).map(|(_, value)| value);
    let fitted = facets(estimate, &model.with_fitted(found))?;
    check_shape("facet_rgb", &measured, [fitted.nrows(), fitted.ncols()])?;
    Ok(Some(measured.map(|[facet, channel], value| {
        let sd = sd.get(facet, channel).unwrap_or_default().max(f64::MIN_POSITIVE);
        (value - fitted[(facet, channel)]) / sd
    })))
}

/// The estimated facets, facet by channel.
fn facets(estimate: &EstimateRecord, model: &FacetModel) -> Result<DMatrix<f64>> {
    if estimate.reflectance.len() != model.bands() {
        let values = counted(estimate.reflectance.len(), "value");
        let problem = format!("{values} for {} wavebands", model.bands());
        return Err(Error::field("estimate.reflectance", problem));
    }
    let missing = || Error::field("estimate.exposure", "missing; estimate the sample again");
    let exposure = estimate.exposure.ok_or_else(missing)?;
    Ok(exposure * model.facet_rgb(&estimate.reflectance))
}
