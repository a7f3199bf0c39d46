//! The estimate of a sheet under a prior, as made by `vestimate`: the method that suits its facets, and a
//! verdict on the result.
//!
//! Computed facets are those of an ideal fold. A photograph is assumed to show a real sheet, unless the user
//! stated what to fit, or real sheets are not modelled in the scene.

use std::slice;
use std::sync::Arc;

use super::data::FacetData;
use super::fluorescence::Fluorescence;
use super::light::{self, Candidate, Others, Shown};
use super::measured::Measured;
use super::other_camera::{OtherCameras, rival_camera};
use super::photograph::day::Day;
use super::photograph::priors::Priors;
use super::photograph::{self, Parts, SheetEstimate, StatedScene, Unmodelled};
use super::prior::Prior;
use super::rival::Rival;
use super::shading::Shading;
use super::shadow::Shadow;
use super::taking::{Stated, doubts_of_taking};
use super::unknowns::{SceneModel, Unknown};
use super::verdict::{
    Doubt, EXPLAINED, Verdict, beyond_chance, ignored_findings, improbable, unusual_exposure,
    unusual_findings,
};
use super::{Estimate, Exposure, map};
use crate::error::{Error, Result};
use crate::geometry::FacetGrid;
use crate::image::Making;

/// Least relevant change of the facets, in standard deviations.
pub const CUTOFF: f64 = 1e-2;

/// Log Bayes factor of several sheets against one above which joined photographs are refused: ten thousand to
/// one. Users seldom join the wrong photographs, and errors in the stated light make one sheet look like two.
const LN_SEVERAL: f64 = 9.2;

/// A scene as stated, with everything that the estimates of its sheets have in common.
pub struct Inference {
    /// The scene, with the parameters to fit.
    pub model: SceneModel,
    /// Its wavelengths, nm.
    pub wavelengths_nm: Vec<f64>,
    /// The initial reflectance, if one is given: one number per wavelength.
    pub start: Option<Vec<f64>>,
    /// True if a photograph decides for itself what is fitted.
    pub is_auto: bool,
    /// The stated light and camera.
    pub stated: Stated,
    /// Candidates for an unknown light; empty if it is known.
    pub lights: Vec<Candidate>,
    /// Alternatives to the stated light; `None` if none was stated, or several.
    pub other_lights: Option<Arc<Others>>,
    /// Alternatives to the stated camera; `None` if there can be none.
    pub other_cameras: Option<OtherCameras>,
    /// Light and exposure inferred from a fold of a known sheet, if there is one.
    pub shown: Option<Shown>,
    /// The facet grid of a panel, if the surface is a fold.
    pub panel: Option<FacetGrid>,
}

/// A photograph, apart from the values of its facets.
#[derive(Clone, Debug)]
pub struct Photographed {
    /// How the picture was made.
    pub making: Making,
    /// Root mean square of the residuals of the chart or card by which its values were calibrated, relative
    /// to what they should be; `None` without one.
    pub chart_residual: Option<f64>,
    /// Shadows on its panels; facets in them are not measured.
    pub shadows: Vec<Shadow>,
    /// The ingredients of its facets, or why real sheets are not modelled there; `None` if it is assumed to
    /// show an ideal fold.
    pub parts: Option<std::result::Result<Parts, Unmodelled>>,
}

/// The facets of a sheet, measured or computed.
#[derive(Clone, Copy)]
pub struct Facets<'a> {
    /// Values and standard deviations.
    pub measured: &'a Measured<'a>,
    /// The role of the exposure.
    pub exposure: Exposure,
    /// The photograph; `None` for computed facets.
    pub photograph: Option<&'a Photographed>,
}

/// A spectrum with a verdict on it.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// Wavelengths of the spectrum, nm.
    pub wavelengths_nm: Vec<f64>,
    /// The spectrum, with everything estimated along with it.
    pub estimate: Estimate,
    /// The verdict.
    pub verdict: Verdict,
    /// Why a photograph that an ideal fold does not explain was still treated as one: its error bars lack the
    /// effects of a real sheet.
    pub unmodelled: Option<Unmodelled>,
}

impl Inference {
    /// The facets of a sheet as data of the scene.
    ///
    /// # Errors
    /// As [`FacetData::new`].
    pub fn data(
        &self,
        measured: &Measured,
        exposure: Exposure,
        is_photograph: bool,
    ) -> Result<FacetData<'_>> {
        let expected = match is_photograph {
            true => Some(Priors::USUAL.exposure()),
            false => self.shown.as_ref().and_then(|shown| shown.exposure),
        };
        let data = FacetData::new(&self.model, measured, exposure.or_expected(expected), CUTOFF)?;
        // other effects in a photograph look like fluorescence
        Ok(if is_photograph { data.without_fluorescence() } else { data })
    }

    /// The spectrum of a sheet under a prior, by the method that suits its facets, and a verdict.
    ///
    /// # Arguments
    /// - `data`: the same facets, as returned by [`Inference::data`].
    ///
    /// # Errors
    /// [`Error::Numeric`] if the facets are not finite.
    pub fn measure(&self, facets: &Facets, data: &FacetData, prior: &Prior) -> Result<Measurement> {
        let start = self.start.as_deref();
        let ideal = || Ok(map::estimate_in((data, &self.lights), prior, start, None)?.0);
        let Some(photograph) = facets.photograph else {
            return self.of_computed(facets, data, prior);
        };
        let mut doubts: Vec<Doubt> = self.doubt_of_known().into_iter().collect();
        doubts.extend(self.doubts_of_taking(photograph));
        let parts = match &photograph.parts {
            Some(Ok(parts)) if self.lights.is_empty() => parts,
            Some(Ok(parts)) if self.is_auto => {
                let estimate = light::estimate_photograph(
                    parts,
                    &self.lights,
                    self.shown.as_ref().and_then(|shown| shown.scenarios.as_ref()),
                    prior,
                )?;
                return Ok(self.judged(facets, estimate, doubts));
            }
            Some(Err(why)) if self.is_auto => {
                let estimate = ideal()?;
                let unmodelled = (estimate.residual_rms >= EXPLAINED).then_some(*why);
                return Ok(Measurement { unmodelled, ..self.judged(facets, estimate, doubts) });
            }
            Some(_) | None => return Ok(self.judged(facets, ideal()?, doubts)),
        };
        let shown = self.shown.as_ref().and_then(|shown| shown.daylight);
        let lit = shown.map(|shown| Parts {
            stated: StatedScene { shown: Some(shown), ..parts.stated },
            ..parts.clone()
        });
        let weighed = photograph::weigh(slice::from_ref(lit.as_ref().unwrap_or(parts)), prior)?;
        let is_named = photograph.making.taken_by != Default::default();
        let cameras = self.other_cameras.as_ref().filter(|_| !is_named || parts.eye.is_stand_in);
        // three searches that all start from there
        let (sheet, (light, camera)) = rayon::join(
            || weighed.estimate(prior),
            || {
                rayon::join(
                    || light::rival_in_photograph(parts, &weighed, self.other_lights.as_deref()?, prior),
                    || rival_camera(parts, &weighed, cameras?, prior),
                )
            },
        );
        let real = sheet?.photographs.pop();
        let real = real.ok_or_else(|| Error::Numeric("no photograph".to_owned()))?;
        doubts.splice(0..0, self.doubt_of_light(light));
        doubts.extend(camera.map(|camera| camera.doubt_of_camera(&self.stated.camera)));
        if self.is_auto {
            return Ok(self.judged(facets, real, doubts));
        }
        let fit = self.model.unknowns().iter().map(|expected| expected.unknown);
        doubts.extend(ignored_findings(&real.findings, fit));
        let estimate = Estimate { without_bounces: real.without_bounces, ..ideal()? };
        Ok(self.judged(facets, estimate, doubts))
    }

    /// The spectrum of a sheet from computed facets.
    fn of_computed(&self, facets: &Facets, data: &FacetData, prior: &Prior) -> Result<Measurement> {
        let start = self.start.as_deref();
        let others = self.other_lights.as_deref().filter(|_| self.lights.is_empty());
        let (estimate, rival) = map::estimate_in((data, &self.lights), prior, start, others)?;
        let doubts = self.doubt_of_known().or_else(|| self.doubt_of_light(rival)).into_iter();
        let of_facets = beyond_chance(&estimate, data.size().1).or_else(|| improbable(&estimate));
        let doubts = doubts.chain(of_facets).collect();
        Ok(self.judged(facets, estimate, doubts))
    }

    /// One photograph's part of an estimate from several of the sheet, as made by [`of_one_sheet`], and a
    /// verdict.
    #[must_use]
    pub fn share(&self, facets: &Facets, estimate: Estimate) -> Measurement {
        let doubts = facets.photograph.map(|photograph| self.doubts_of_taking(photograph));
        self.judged(facets, estimate, doubts.unwrap_or_default())
    }

    /// Doubts that arise from how the photograph was taken; for surfaces other than a fold only those of
    /// shadows.
    fn doubts_of_taking(&self, photograph: &Photographed) -> Vec<Doubt> {
        let of_shadows = photograph.shadows.iter().map(Shadow::doubt);
        let of_taking =
            self.panel.map(|_| doubts_of_taking(&self.stated, &photograph.making, photograph.chart_residual));
        of_shadows.chain(of_taking.into_iter().flatten()).collect()
    }

    /// The doubt that a known fold casts on the stated light.
    fn doubt_of_known(&self) -> Option<Doubt> {
        self.shown.as_ref()?.doubt(self.stated.lights.first().map(String::as_str))
    }

    /// The doubt that a more probable light casts on the stated one.
    fn doubt_of_light(&self, rival: Option<Rival>) -> Option<Doubt> {
        Some(rival?.doubt_of_light(self.stated.lights.first()?))
    }

    /// An estimate with the verdict on it; `doubts` are those already known.
    fn judged(&self, facets: &Facets, mut estimate: Estimate, mut doubts: Vec<Doubt>) -> Measurement {
        if let Some(photograph) = facets.photograph {
            doubts.extend(self.doubts_of_facets(facets, photograph, &estimate));
            estimate = estimate.in_stated_light(&self.wavelengths_nm);
            estimate.findings.retain(|finding| !finding.is_unusual);
        }
        doubts.extend(estimate.fluorescence.as_ref().and_then(Fluorescence::doubt));
        let mut verdict = Verdict::of(&estimate, doubts, &self.stated.to_string());
        let sentence = estimate.fluorescence.as_ref().and_then(Fluorescence::words);
        if let Some(sentence) = sentence.filter(|sentence| !verdict.because.contains(sentence)) {
            verdict.because = format!("{}; {sentence}", verdict.because);
        }
        Measurement { wavelengths_nm: self.wavelengths_nm.clone(), estimate, verdict, unmodelled: None }
    }

    /// Doubts that the facets of a photograph cast on its estimate.
    fn doubts_of_facets(
        &self,
        facets: &Facets,
        photograph: &Photographed,
        estimate: &Estimate,
    ) -> Vec<Doubt> {
        let Measured { rgb, sd } = facets.measured;
        let mut doubts = unusual_findings(estimate);
        if let Some(panel) = self.panel {
            let found = |unknown: &Unknown| {
                let one = estimate.fitted.iter().find(|one| one.unknown == unknown);
                one.map(|one| one.value)
            };
            let model = self.model.with_fitted(found);
            let light = estimate.light.as_ref().and_then(|light| light.most_probable(&self.lights));
            let ideal = match light {
                Some(light) => model.in_light(&light.camera).facet_rgb(&estimate.reflectance),
                None => model.facet_rgb(&estimate.reflectance),
            };
            let shading = Shading::new(panel, rgb, sd, &ideal);
            let is_sunlit = estimate.day.is_none_or(|found| found.day == Day::Clear);
            doubts.extend(shading.into_iter().flat_map(|shading| shading.doubts(is_sunlit)));
        }
        if photograph.chart_residual.is_none() {
            doubts.extend(unusual_exposure(estimate, facets.exposure.known()));
        }
        doubts
    }
}

/// The estimate from photographs of one sheet.
///
/// # Arguments
/// - `photographs`: the ingredients of each, at least one; `names`: their names, for errors.
///
/// # Errors
/// [`Error::Field`] if they show several sheets, [`Error::Numeric`] if facets are not finite.
pub fn of_one_sheet(photographs: &[Parts], names: &[String], prior: &Prior) -> Result<SheetEstimate> {
    let together = photograph::estimate_usual(photographs, prior)?;
    let mut apart = 0.0;
    for one in photographs {
        apart += photograph::estimate_usual(slice::from_ref(one), prior)?.ln_evidence;
    }
    let more = apart - together.ln_evidence;
    if more > LN_SEVERAL {
        let problem = format!(
            "{} are not photographs of one sheet: the evidence favours separate sheets (log Bayes factor \
             {more:.0}); join only photographs of one sheet",
            names.join(", ")
        );
        return Err(Error::field("id", problem));
    }
    Ok(together)
}
