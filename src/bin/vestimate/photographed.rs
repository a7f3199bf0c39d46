//! Which model of a photograph is believed: the fold as it was told, the same with another angle, or a real sheet.

use vfold::cli;
use vfold::estimate::data::FacetData;
use vfold::estimate::measured::Measured;
use vfold::estimate::photograph::Parts;
use vfold::estimate::photograph::error::ModelError;
use vfold::estimate::prior::Prior;
use vfold::estimate::unknowns::ANGLE;
use vfold::estimate::verdict::{Doubt, EXPLAINED, beyond_chance, is_loose};
use vfold::estimate::{Estimate, Exposure, Fitted, map, photograph};
use vfold::scene::{FoldSetting, PhotographedFold, Unmodelled};
use vfold::stream::{Sample, Scene};
use vfold::{Error, Result, spectrum};

use super::context::{Believed, Context};
use super::estimator::Estimator;
use super::said::Deviations;

/// Misfit of a fold as it was told up to which another angle is tried at once: what sets real sheets apart from ideal ones mostly makes more.
const NEAR: f64 = 8.0;
/// Where it makes more, another angle is tried if that of a real sheet is further than that from the one that was told, degrees.
const PULLED_DEG: f64 = 2.4;

/// The facets of a sample.
pub struct Given<'a> {
    /// As they were measured.
    pub measured: &'a Measured<'a>,
    /// How the exposure enters.
    pub exposure: Exposure,
    /// As data of the scene.
    pub data: &'a FacetData<'a>,
    /// The scene.
    pub believed: &'a Believed,
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
        let other_angle = |misfit: f64| {
            let Believed { fit, other_angle, .. } = given.believed;
            other_angle.better(misfit, record, fit, (given.measured, given.exposure), prior)
        };
        if !self.is_auto() {
            let ideal = ideal();
            doubts.extend(other_angle(ideal.residual_rms)?.map(|turned| turned.doubt_if_kept()));
            return Ok(ideal);
        }
        let stands_in = record.camera()?.stands_in.map(|one| one.camera);
        // A little gloss taken for bounces leaves little of the facets and no spectrum.
        let is_loose = |estimate: &Estimate| is_loose(estimate, given.data.size().1);
        let mut misfit = map::least_misfit(given.data, prior);
        let told = (misfit < map::CAUTION * EXPLAINED).then(ideal);
        misfit = told.as_ref().map_or(misfit, |told| told.residual_rms);
        if misfit < NEAR
            && stands_in.is_none()
            && let Some(turned) = other_angle(misfit)?
            && !is_loose(&turned.estimate)
        {
            return Ok(turned.into_estimate(doubts));
        }
        let is_ideal = misfit < EXPLAINED && stands_in.is_none() && !told.as_ref().is_some_and(is_loose);
        let told = || told.unwrap_or_else(ideal);
        if is_ideal || given.exposure == Exposure::Sum {
            return Ok(told());
        }
        match self.parts(record, sample, given.measured)? {
            Ok(parts) => {
                let told_deg = parts.told.angle_deg;
                let found = photograph::estimate(&[parts], prior, ModelError::OF_PHOTOGRAPHS)?;
                let real = found.photographs.into_iter().next().unwrap_or_else(told);
                let is_pulled =
                    |one: &Fitted| one.unknown == &ANGLE && (one.value - told_deg).abs() > PULLED_DEG;
                if misfit >= NEAR
                    && real.fitted.iter().any(is_pulled)
                    && let Some(turned) = other_angle(misfit)?
                {
                    return Ok(turned.into_estimate(doubts));
                }
                Ok(real)
            }
            Err(why) => {
                if !self.args().common.quiet {
                    let what = match stands_in {
                        Some(camera) if misfit < EXPLAINED => {
                            format!("the curves of {camera} are another camera's")
                        }
                        _ => format!("misfit {misfit:.1}: this is no ideal fold"),
                    };
                    let text = format!(
                        "{}: {what}, and as {why}, what that changes is not estimated; expect errors beyond the bars",
                        sample.id()
                    );
                    cli::say("vestimate", &text);
                }
                Ok(told())
            }
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
        let deviations = Deviations::of(&noise, context.believed(sample).model.facets(), &rgb)?;
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

/// What speaks against an estimate from how the photograph was taken.
pub fn doubts_of_taking(record: &Scene, sample: &Sample) -> Result<Vec<Doubt>> {
    let developed = sample.is_developed()?.then(|| {
        Doubt::new(
            "a camera developed this picture, and neither its white balance nor its matrix was undone",
            "take the RAW file, or give vextract --undo",
        )
    });
    let camera = record.camera()?;
    let (make, model) = sample.taken_by()?;
    let another = match &camera.stands_in {
        Some(one) => Some(Doubt::new(
            format!("nobody measured the curves of {}: another camera's stand in for them", one.camera),
            "make them of a photograph of a colour chart (vextract --save-camera)",
        )),
        None if spectrum::is_other_camera(&camera.name, &make, &model) => Some(Doubt::new(
            format!(
                "EXIF says that {} took the picture, not {}",
                format!("{make} {model}").trim(),
                camera.name
            ),
            "give the camera that took it (vextract --camera)",
        )),
        None => None,
    };
    Ok(developed.into_iter().chain(another).collect())
}
