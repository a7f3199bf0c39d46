//! The estimate of a sheet under a prior, as `vestimate` makes it: which method its facets ask for, and how
//! far what comes of it can be assumed.
//!
//! Computed facets are those of an ideal fold. A photograph is taken for one of a real sheet, unless somebody
//! said what is to be fitted, or the scene is one in which real sheets are not modelled.

use std::slice;

use super::data::FacetData;
use super::fluorescence::Fluorescence;
use super::light::{self, Candidate, Others, RivalLight, Shown};
use super::measured::Measured;
use super::photograph::day::Day;
use super::photograph::{self, Parts, SheetEstimate, StatedScene, Unmodelled};
use super::prior::Prior;
use super::shading::Shading;
use super::shadow::Shadow;
use super::taking::{Stated, doubts_of_taking};
use super::unknowns::{SceneModel, Unknown};
use super::verdict::{
    Doubt, EXPLAINED, Verdict, beyond_chance, other_angle, other_exposure, unusual_exposure, unusual_findings,
};
use super::{Estimate, Exposure, map};
use crate::error::{Error, Result};
use crate::geometry::FacetGrid;
use crate::image::Making;

/// Least change of facets that counts, in standard deviations.
pub const CUTOFF: f64 = 1e-2;

/// How much more probable facets must be as those of several sheets than as those of one, as a logarithm, for
/// one to be refused: ten thousand times. Who joins photographs seldom errs, and lights that are off from
/// what was stated make one sheet look like two.
const LN_SEVERAL: f64 = 9.2;

/// A scene, and what is known of the sheets in it.
#[derive(Clone, Copy)]
pub struct Inference<'a> {
    /// The scene as it was stated, with what is to be fitted in it.
    pub model: &'a SceneModel,
    /// Its wavelengths, nm.
    pub wavelengths_nm: &'a [f64],
    /// What is known of reflectances beforehand.
    pub prior: &'a Prior,
    /// The reflectance to set out from, if one is given: one number per wavelength.
    pub start: Option<&'a [f64]>,
    /// Whether what is fitted of a photograph is up to it.
    pub is_auto: bool,
    /// Light and camera as they were stated.
    pub stated: &'a Stated,
    /// What the light may be; none if it is known.
    pub lights: &'a [Candidate],
    /// What else the light that was stated may be; none if nobody stated one, or several.
    pub other_lights: Option<&'a Others>,
    /// What a fold of a known sheet shows of light and exposure, if there is one.
    pub shown: Option<&'a Shown>,
    /// The facets of a panel, if the surface is a fold.
    pub panel: Option<FacetGrid>,
}

/// A photograph, beside the values of its facets.
#[derive(Clone, Debug)]
pub struct Photographed {
    /// How it was made.
    pub making: Making,
    /// Whether a chart or a card in it calibrated its numbers.
    pub by_chart: bool,
    /// Shadows on its panels, facets in which are not measured.
    pub shadows: Vec<Shadow>,
    /// What its facets are made of, or why real sheets are not modelled there; none if it is taken for one of
    /// an ideal fold.
    pub parts: Option<std::result::Result<Parts, Unmodelled>>,
}

/// The facets of a sheet, as they were measured or computed.
#[derive(Clone, Copy)]
pub struct Facets<'a> {
    /// Values, and how far each may be off.
    pub measured: &'a Measured<'a>,
    /// How the exposure enters.
    pub exposure: Exposure,
    /// The photograph; none of facets that were computed.
    pub photograph: Option<&'a Photographed>,
}

/// A spectrum, and what is thought of it.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// Wavelengths of the spectrum, nm.
    pub wavelengths_nm: Vec<f64>,
    /// The spectrum, with what was found along with it.
    pub estimate: Estimate,
    /// How far it can be trusted.
    pub verdict: Verdict,
    /// Why a photograph that an ideal fold does not explain was taken for one all the same: its error bars
    /// lack what that changes.
    pub unmodelled: Option<Unmodelled>,
}

impl<'a> Inference<'a> {
    /// The facets of a sheet as data of the scene.
    ///
    /// # Errors
    /// As [`FacetData::new`].
    pub fn data(
        &self,
        measured: &Measured,
        exposure: Exposure,
        is_photograph: bool,
    ) -> Result<FacetData<'a>> {
        let exposure = if is_photograph {
            exposure.of_photograph()
        } else {
            exposure.or_expected(self.shown.and_then(|shown| shown.exposure))
        };
        let data = FacetData::new(self.model, measured, exposure, CUTOFF)?;
        // what a photograph has beyond an ideal fold's facets looks like fluorescence
        Ok(if is_photograph { data.without_fluorescence() } else { data })
    }

    /// The spectrum of a sheet, by the method that its facets ask for, and how far it can be trusted.
    ///
    /// # Arguments
    /// - `data`: the same facets, as [`Inference::data`] has them.
    ///
    /// # Errors
    /// [`Error::Numeric`] if the facets are not finite.
    pub fn measure(&self, facets: &Facets, data: &FacetData) -> Result<Measurement> {
        let ideal = || match self.lights {
            [] => map::estimate(data, self.prior, self.start),
            lights => light::estimate(data, lights, self.prior, self.start),
        };
        let Some(photograph) = facets.photograph else {
            return self.of_computed(facets, data);
        };
        let mut doubts: Vec<Doubt> = self.doubt_of_known().into_iter().collect();
        doubts.extend(self.doubts_of_taking(photograph));
        let parts = match &photograph.parts {
            Some(Ok(parts)) if !self.lights.is_empty() => {
                let estimate = light::estimate_photograph(
                    parts,
                    self.lights,
                    self.shown.and_then(|shown| shown.scenarios.as_ref()),
                    self.prior,
                )?;
                return Ok(self.judged(facets, estimate, doubts));
            }
            Some(Ok(parts)) => parts,
            Some(Err(why)) if self.is_auto => {
                let estimate = ideal()?;
                let unmodelled = (estimate.residual_rms >= EXPLAINED).then_some(*why);
                return Ok(Measurement { unmodelled, ..self.judged(facets, estimate, doubts) });
            }
            Some(Err(_)) | None => return Ok(self.judged(facets, ideal()?, doubts)),
        };
        let shown = self.shown.and_then(|shown| shown.daylight);
        let lit = shown.map(|shown| Parts {
            stated: StatedScene { shown: Some(shown), ..parts.stated },
            ..parts.clone()
        });
        let mut real = photograph::estimate(slice::from_ref(lit.as_ref().unwrap_or(parts)), self.prior)?;
        let real = real.photographs.pop().ok_or_else(|| Error::Numeric("no photograph".to_owned()))?;
        let day = real.day.map(|found| found.day);
        let rival =
            self.other_lights.and_then(|others| light::rival_in_photograph(parts, day, others, self.prior));
        doubts.splice(0..0, self.doubt_of_light(rival));
        if !photograph.by_chart {
            doubts.extend(other_exposure(facets.exposure, &real));
        }
        if self.is_auto {
            return Ok(self.judged(facets, real, doubts));
        }
        doubts.extend(other_angle(&real, parts.stated.angle_deg));
        let estimate = Estimate { without_bounces: real.without_bounces, ..ideal()? };
        Ok(self.judged(facets, estimate, doubts))
    }

    /// The spectrum of a sheet from facets that were computed.
    fn of_computed(&self, facets: &Facets, data: &FacetData) -> Result<Measurement> {
        let (estimate, rival) = match self.lights {
            [] => map::estimate_in_stated_light(data, self.prior, self.start, self.other_lights)?,
            lights => (light::estimate(data, lights, self.prior, self.start)?, None),
        };
        let doubts = self.doubt_of_known().or_else(|| self.doubt_of_light(rival)).into_iter();
        let doubts = doubts.chain(beyond_chance(&estimate, data.size().1)).collect();
        Ok(self.judged(facets, estimate, doubts))
    }

    /// A photograph's share of an estimate from several of the sheet, as [`of_one_sheet`] makes it, and how
    /// far it can be trusted.
    #[must_use]
    pub fn share(&self, facets: &Facets, estimate: Estimate) -> Measurement {
        let doubts = facets.photograph.map(|photograph| self.doubts_of_taking(photograph));
        self.judged(facets, estimate, doubts.unwrap_or_default())
    }

    /// What speaks against an estimate from how the photograph was taken; of other surfaces than a fold
    /// nothing is asked.
    fn doubts_of_taking(&self, photograph: &Photographed) -> Vec<Doubt> {
        let of_shadows = photograph.shadows.iter().map(Shadow::doubt);
        let of_taking = self.panel.map(|_| doubts_of_taking(self.stated, &photograph.making));
        of_shadows.chain(of_taking.into_iter().flatten()).collect()
    }

    /// What a known fold says against the light that was stated.
    fn doubt_of_known(&self) -> Option<Doubt> {
        self.shown?.doubt(self.stated.lights.first().map(String::as_str))
    }

    /// What another light that is more probable says against the one that was stated.
    fn doubt_of_light(&self, rival: Option<RivalLight>) -> Option<Doubt> {
        Some(rival?.doubt(self.stated.lights.first()?))
    }

    /// An estimate with the verdict on it, `doubts` being known already.
    fn judged(&self, facets: &Facets, mut estimate: Estimate, mut doubts: Vec<Doubt>) -> Measurement {
        if let Some(photograph) = facets.photograph {
            doubts.extend(self.doubts_of_facets(facets, photograph, &estimate));
            estimate = estimate.in_stated_light(self.wavelengths_nm);
            estimate.findings.retain(|finding| !finding.is_unusual);
        }
        doubts.extend(estimate.fluorescence.as_ref().and_then(Fluorescence::doubt));
        let mut verdict = Verdict::of(&estimate, doubts, &self.stated.to_string());
        if let Some(sentence) = estimate.fluorescence.as_ref().and_then(Fluorescence::words) {
            verdict.because = format!("{}; {sentence}", verdict.because);
        }
        Measurement { wavelengths_nm: self.wavelengths_nm.to_vec(), estimate, verdict, unmodelled: None }
    }

    /// What the facets of a photograph show to speak against its estimate.
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
            let light = estimate.light.as_ref().and_then(|light| light.most_probable(self.lights));
            let ideal = match light {
                Some(light) => model.in_light(&light.camera).facet_rgb(&estimate.reflectance),
                None => model.facet_rgb(&estimate.reflectance),
            };
            let shading = Shading::new(panel, rgb, sd, &ideal);
            let is_sunlit = estimate.day.is_none_or(|found| found.day == Day::Clear);
            doubts.extend(shading.into_iter().flat_map(|shading| shading.doubts(is_sunlit)));
        }
        if !photograph.by_chart {
            doubts.extend(unusual_exposure(estimate, facets.exposure.known()));
        }
        doubts
    }
}

/// The estimate from photographs of one sheet.
///
/// # Arguments
/// - `photographs`: what each is made of, at least one; `names`: what each is called, for errors.
///
/// # Errors
/// [`Error::Field`] if they are those of several sheets, [`Error::Numeric`] if facets are not finite.
pub fn of_one_sheet(photographs: &[Parts], names: &[String], prior: &Prior) -> Result<SheetEstimate> {
    let estimate = |all: &[Parts]| photograph::estimate_usual(all, prior);
    let together = estimate(photographs)?;
    let mut apart = 0.0;
    for one in photographs {
        apart += estimate(slice::from_ref(one))?.ln_evidence;
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
