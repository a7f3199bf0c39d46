//! Estimates of photographs, and what their facets say of what was told.

use std::slice;

use vfold::cli;
use vfold::estimate::data::FacetData;
use vfold::estimate::measured::Measured;
use vfold::estimate::photograph::Parts;
use vfold::estimate::photograph::error::ModelError;
use vfold::estimate::prior::Prior;
use vfold::estimate::verdict::{Doubt, EXPLAINED, beyond_chance, other_angle, other_exposure};
use vfold::estimate::{Estimate, Exposure, map, photograph};
use vfold::scene::{FoldSetting, PhotographedFold, Unmodelled};
use vfold::stream::{Sample, Scene};
use vfold::{Error, Result};

use super::context::Context;
use super::doubts::doubts_of_taking;
use super::estimator::Estimator;
use super::said::Deviations;

/// The facets of a sample.
pub struct Given<'a> {
    /// As they were measured.
    pub measured: &'a Measured<'a>,
    /// How the exposure enters.
    pub exposure: Exposure,
    /// As data of the scene.
    pub data: &'a FacetData<'a>,
}

impl Estimator<'_> {
    /// The estimate under a prior; what speaks against it goes to `doubts`.
    pub fn by_prior(
        &self,
        context: &Context,
        sample: &Sample,
        given: &Given,
        prior: &Prior,
        doubts: &mut Vec<Doubt>,
    ) -> Result<Estimate> {
        let ideal = || map::estimate(given.data, prior, context.start.as_deref());
        if !sample.is_photograph() {
            let ideal = ideal();
            doubts.extend(beyond_chance(&ideal, given.data.size().1));
            return Ok(ideal);
        }
        let Some(record) = &context.record else { return Ok(ideal()) };
        doubts.extend(doubts_of_taking(record, sample)?);
        // estimates by sums are those of ideal folds
        let is_by_sum = given.exposure == Exposure::Sum;
        let parts = if is_by_sum { None } else { Some(self.parts(record, sample, given.measured)?) };
        let real = match &parts {
            Some(Ok(parts)) => {
                photograph::estimate(slice::from_ref(parts), prior, ModelError::OF_PHOTOGRAPHS)?
                    .photographs
                    .pop()
            }
            Some(Err(_)) | None => None,
        };
        if let Some(found) = &real
            && !sample.fields.has("calibration")
        {
            doubts.extend(other_exposure(given.exposure, found));
        }
        match (real, parts) {
            (Some(real), _) if self.is_auto() => Ok(real),
            (Some(real), Some(Ok(parts))) => {
                doubts.extend(other_angle(&real, parts.told.angle_deg));
                Ok(Estimate { without_bounces: real.without_bounces, ..ideal() })
            }
            (_, Some(Err(why))) if self.is_auto() => {
                let ideal = ideal();
                self.say_unmodelled(sample, &ideal, why);
                Ok(ideal)
            }
            _ => Ok(ideal()),
        }
    }

    /// Says that a photograph whose facets an ideal fold does not explain is taken for one all the same.
    fn say_unmodelled(&self, sample: &Sample, ideal: &Estimate, why: Unmodelled) {
        let misfit = ideal.residual_rms;
        if misfit >= EXPLAINED && !self.args().common.quiet {
            let text = format!(
                "{}: misfit {misfit:.1}: this is no ideal fold, and as {why}, what that changes is not estimated; expect errors beyond the bars",
                sample.id()
            );
            cli::say("vestimate", &text);
        }
    }

    /// What a photograph that is estimated with others is made of.
    ///
    /// # Errors
    /// [`Error::Field`] if the sample is no photograph of a fold.
    pub fn photograph(&self, context: &Context, sample: &Sample) -> Result<Parts> {
        let alone = |why: String| {
            let problem = format!("{}: {why}; only photographs of folds are estimated together", sample.id());
            Error::field("id", problem)
        };
        let Some(record) = &context.record else { return Err(alone("the scene is no fold".to_owned())) };
        let (rgb, noise) = (sample.facet_rgb()?, self.noise(sample)?);
        let deviations = Deviations::of(&noise, context.told.facets(), &rgb)?;
        let measured = Measured { rgb: &rgb, sd: &deviations.sd };
        self.parts(record, sample, &measured)?.map_err(|why| alone(why.to_string()))
    }

    /// What a photograph of the scene of `record` is made of, or why that is not modelled.
    fn parts(
        &self,
        record: &Scene,
        sample: &Sample,
        measured: &Measured,
    ) -> Result<std::result::Result<Parts, Unmodelled>> {
        let exposure = self.exposure_of(sample)?.known();
        PhotographedFold::of(&FoldSetting::of(record)?).parts(sample, measured, exposure)
    }
}
