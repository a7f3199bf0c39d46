//! Which model of a photograph is believed: the fold as it was told, the same with another angle, or a real sheet.

use nalgebra::DMatrix;
use vfold::cli;
use vfold::estimate::data::FacetData;
use vfold::estimate::measured::Measured;
use vfold::estimate::noise::Noise;
use vfold::estimate::photograph::Parts;
use vfold::estimate::photograph::error::ModelError;
use vfold::estimate::prior::Prior;
use vfold::estimate::shading::Shading;
use vfold::estimate::unknowns::{ANGLE, SceneModel};
use vfold::estimate::verdict::{
    Doubt, EXPLAINED, Level, beyond_chance, is_loose, other_exposure, unusual_exposure, unusual_findings,
};
use vfold::estimate::{Estimate, Exposure, Fitted, map, photograph};
use vfold::forward::FacetValues;
use vfold::image::Processing;
use vfold::scene::{FoldSetting, PhotographedFold, Unmodelled};
use vfold::stream::{Sample, Scene};
use vfold::{Error, Result};

use super::context::{Believed, Context};
use super::estimator::{CUTOFF, Estimator};
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
        let told = self.of_fold(context, sample, given, prior, doubts)?;
        if given.exposure.known().is_some() && !sample.fields.has("calibration") {
            let exposure = Exposure::Free.of_photograph();
            let free = FacetData::new(&given.believed.model, given.measured, exposure, CUTOFF)?;
            let (told, free) = (map::glance(given.data, prior), map::glance(&free, prior));
            doubts.extend(free.and_then(|free| other_exposure(given.exposure, told.as_ref(), &free)));
        }
        Ok(told)
    }

    /// The estimate of a photographed fold: as it was told, with another angle, or of a real sheet.
    fn of_fold(
        &self,
        context: &Context,
        sample: &Sample,
        given: &Given,
        prior: &Prior,
        doubts: &mut Vec<Doubt>,
    ) -> Result<Estimate> {
        let ideal = || map::estimate(given.data, prior, context.start.as_deref());
        let Some(record) = &context.record else { return Ok(ideal()) };
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

    /// What the facets of a photograph show to speak against its estimate.
    pub fn doubts_of_facets(
        &self,
        context: &Context,
        sample: &Sample,
        (rgb, noise): (&FacetValues, &Noise),
        estimate: &Estimate,
    ) -> Result<Vec<Doubt>> {
        let is_stated = self.exposure_of(sample)?.known().is_some();
        let is_by_chart = sample.fields.has("calibration");
        let mut doubts = unusual_findings(estimate);
        if !is_by_chart {
            doubts.extend(unusual_exposure(estimate, is_stated));
        }
        if let Some(record) = &context.record {
            let model = &context.told.model;
            let sd = noise.deviations(model.facets(), rgb)?;
            let ideal = ideal_facets(model, &estimate.reflectance);
            let grid = FoldSetting::of(record)?.fold().facets();
            let is_loose = estimate.total.is_some() && !is_stated && !is_by_chart;
            let shading = Shading::new(grid, rgb, &sd);
            doubts.extend(shading.into_iter().flat_map(|shading| shading.doubts(&ideal, is_loose)));
        }
        Ok(doubts)
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

/// The facets of an ideal fold, or another surface, of this reflectance, all that is unknown of the scene being as expected.
fn ideal_facets(model: &SceneModel, reflectance: &[f64]) -> DMatrix<f64> {
    let expected: Vec<f64> = model.unknowns().iter().map(|one| one.at(0.0).0).collect();
    model.with_values(&expected).facet_rgb(reflectance)
}

/// What speaks against an estimate from how the photograph was taken.
pub fn doubts_of_taking(record: &Scene, sample: &Sample) -> Result<Vec<Doubt>> {
    let developed = sample.is_developed()?.then(|| Doubt {
        level: Level::Wrong,
        because: "this picture was developed for the eye, and neither white balance nor matrix was undone"
            .to_owned(),
        remedy:
            "take the RAW file, or give vextract --undo, or --transfer if its numbers are the camera's own"
                .to_owned(),
    });
    let processed = sample.processing()?.map(|processing| Doubt {
        level: Level::Wrong,
        because: match processing {
            Processing::Curve => "noise falls as brightness rises: the picture's numbers have a curve such as sRGB's",
            Processing::Matrix => "the noise of the channels goes opposite ways: a matrix mixed them, as programs do that develop RAW files",
        }
        .to_owned(),
        remedy: "take the RAW file, or a linear TIFF in the camera's own colours".to_owned(),
    });
    let black = sample.unsubtracted_black()?.map(|part| {
        let percent = 100.0 * part;
        Doubt::new(
            format!(
                "the darkest pixels are {percent:.2} % of white in all channels alike: black was not subtracted, it seems"
            ),
            "give vextract --black-level auto, or the camera's black level",
        )
    });
    let open_sides = sample.open_sides()?;
    let open = (!open_sides.is_empty()).then(|| {
        Doubt::new(
            format!(
                "no edge of the sheet lies along {}: it goes on beyond the corners, or does not reach them",
                open_sides.join(", ")
            ),
            "mark the corners of the whole panels, as vextract --overlay shows them",
        )
    });
    let stand_in = record.camera()?.stands_in.map(|one| {
        Doubt::new(
            format!("nobody measured the curves of {}: another camera's stand in for them", one.camera),
            "make them of a photograph of a colour chart (vextract --save-camera)",
        )
    });
    Ok(developed.into_iter().chain(processed).chain(black).chain(open).chain(stand_in).collect())
}
