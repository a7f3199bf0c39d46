//! The estimate in a sample.

use std::{fmt, iter};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fields::finite;
use super::fluorescence::{FluorescenceRecord, LightThroughRecord};
use super::inferred_light::InferredLightRecord;
use super::noise::NoiseRecord;
use super::quantities::Quantities;
use super::sample::{Sample, checked, checked_deviations, checked_radiance};
use super::scene::Scene;
use super::skipped::SkippedRecord;
use crate::colorimetry::ErrorBars;
use crate::error::{Error, Result};
use crate::estimate::emission::Origin;
use crate::estimate::noise::Noise;
use crate::estimate::photograph::Finding;
use crate::estimate::unknowns::Unknown;
use crate::estimate::verdict::{Level, Verdict};
use crate::estimate::{Estimate, Fitted, WRONG_CHI};
use crate::plot::spectra::Curve;
use crate::solve::Termination;
use crate::spectrum::formats::Measured;

/// The estimated spectrum of a sheet. An estimate made by another program needs only wavelengths and
/// reflectance.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct EstimateRecord {
    /// The method, as `vestimate --method` names it: interreflection, park or khan.
    #[serde(skip_deserializing)]
    method: String,
    /// The prior as `vestimate --prior` names it, or the basis of the components.
    #[serde(skip_deserializing)]
    prior: String,
    /// Wavelengths, nm, increasing: those of the scene.
    pub wavelengths_nm: Vec<f64>,
    /// Reflectance, one per wavelength.
    #[schemars(inner(range(min = 0, max = 1)))]
    pub reflectance: Vec<f64>,
    /// Exposure, stated or fitted: value of a perfect white diffuser that faces the sun.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exposure: Option<f64>,
    /// Root mean square of the residuals in units of their expected size: near 1 where the model is good.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub residual_rms: f64,
    /// Number of iterations.
    #[serde(skip_deserializing)]
    iterations: u32,
    /// Why the iterations ended.
    #[serde(skip_deserializing)]
    termination: Option<TerminationRecord>,
    /// Standard deviation of the reflectance, one per wavelength; absent if the method has no error bars.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0)))]
    pub reflectance_sd: Option<Vec<f64>>,
    /// Bihemispherical albedo, one number per wavelength, of a photographed sheet that is not taken to be
    /// Lambertian: the share of light from all directions that it reflects into all directions. `reflectance`
    /// is the 45°:0° reflectance factor.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0, max = 1)))]
    #[serde(alias = "total_reflectance")]
    pub bihemispherical_albedo: Option<Vec<f64>>,
    /// Total radiance factor, one number per wavelength, of a sheet that may well fluoresce: what it
    /// reflects and what it emits in the light of the scene, as an instrument with this light measures it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0)))]
    pub total_radiance_factor: Option<Vec<f64>>,
    /// Its standard deviation, one per wavelength.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0)))]
    pub total_radiance_factor_sd: Option<Vec<f64>>,
    /// The light that the sheet emits itself, if it may well fluoresce.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fluorescence: Option<FluorescenceRecord>,
    /// Light from behind that comes through the sheet, if there may well be any.
    #[serde(default, skip_serializing_if = "Option::is_none", skip_deserializing)]
    light_through: Option<LightThroughRecord>,
    /// Quantities of the scene that were fitted together with the reflectance.
    #[serde(skip_serializing_if = "Option::is_none")]
    fit: Option<Quantities<FittedRecord>>,
    /// The kind of day on which a photograph in daylight was taken.
    #[serde(default, skip_serializing_if = "Option::is_none", skip_deserializing)]
    day: Option<DayRecord>,
    /// The light, if it was not stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub light: Option<InferredLightRecord>,
    /// Ids of the photographs of one sheet from which spectrum and error bars were estimated together,
    /// including that of this sample; absent if it was estimated alone.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joined: Vec<String>,
    /// What is not ideal about the photograph, the most certain first. The estimate allows for it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<FindingRecord>,
    /// Whether the estimate can be trusted; absent if the method has no error bars.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verdict: Option<VerdictRecord>,
    /// Searches that were not made, and quantities that the facets of the photograph do not determine.
    #[serde(default, skip_serializing_if = "Vec::is_empty", skip_deserializing)]
    skipped: Vec<SkippedRecord>,
    /// Covariance of the reflectance, `[wavelength][wavelength]`; with
    /// `vestimate --save covariance=FILE.npy`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub covariance: Option<Vec<Vec<f64>>>,
    /// Assumed noise of the facets, if the method weights facets by it.
    #[serde(skip_serializing_if = "Option::is_none")]
    noise: Option<NoiseRecord>,
}

/// An estimate for [`Sample::set_estimate`].
#[derive(Clone, Copy)]
pub struct NewEstimate<'a> {
    /// In the terms of `vestimate --method`.
    pub method: &'a str,
    /// The prior in the terms of `vestimate --prior`, or the basis of the components.
    pub prior: &'a str,
    /// Wavelengths of the scene.
    pub wavelengths_nm: &'a [f64],
    /// The estimate.
    pub estimate: &'a Estimate,
    /// Assumed noise of the facets, for a method that weights them.
    pub noise: Option<&'a Noise>,
    /// Ids of all samples used, if several.
    pub joined: &'a [String],
    /// Whether it can be trusted, for a method that estimates its errors.
    pub verdict: Option<&'a Verdict>,
    /// Whether to record the covariance, waveband by waveband.
    pub with_covariance: bool,
}

/// Why a solver stopped.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(tag = "reason", rename_all_fields = "snake_case")]
enum TerminationRecord {
    /// The optimality conditions hold.
    #[serde(rename = "converged")]
    Converged {
        /// By how much they are missed; 0 at the exact minimum.
        gradient_norm: f64,
    },
    /// The limit on iterations was reached before.
    #[serde(rename = "iteration limit")]
    IterationLimit,
    /// No step improves the estimate any more, because of rounding.
    #[serde(rename = "no progress")]
    NoProgress {
        /// Norm of the gradient that is left; 0 at the exact minimum.
        gradient_norm: f64,
    },
}

/// A fitted quantity of the scene, in the unit that its name states.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct FittedRecord {
    /// Value.
    pub value: f64,
    /// Standard deviation.
    #[schemars(range(min = 0))]
    pub sd: f64,
    /// Whether the facets determine it better than its prior does.
    pub supported: bool,
}

/// The kind of day on which a photograph was taken.
#[derive(Clone, Debug, Serialize, JsonSchema)]
struct DayRecord {
    /// Clear, hazy (or under thin cloud), overcast, or shade under a blue sky.
    kind: String,
    /// Probability of that kind of day.
    #[schemars(range(min = 0, max = 1))]
    probability: f64,
}

/// Something that is not ideal about a photograph.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct FindingRecord {
    /// What is wrong.
    pub what: String,
    /// What to do about it.
    pub remedy: String,
}

/// Whether an estimate can be trusted.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct VerdictRecord {
    /// How far: good, doubtful or wrong.
    pub level: LevelRecord,
    /// Why.
    pub because: String,
    /// What to do; absent if it is good.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub remedy: Option<String>,
}

/// How far an estimate can be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LevelRecord {
    /// Nothing speaks against it.
    Good,
    /// It may be further off than its error bars.
    Doubtful,
    /// It means nothing.
    Wrong,
}

impl From<Level> for LevelRecord {
    fn from(level: Level) -> Self {
        match level {
            Level::Good => Self::Good,
            Level::Doubtful => Self::Doubtful,
            Level::Wrong => Self::Wrong,
        }
    }
}

impl From<LevelRecord> for Level {
    fn from(level: LevelRecord) -> Self {
        match level {
            LevelRecord::Good => Self::Good,
            LevelRecord::Doubtful => Self::Doubtful,
            LevelRecord::Wrong => Self::Wrong,
        }
    }
}

impl From<&Verdict> for VerdictRecord {
    fn from(Verdict { level, because, remedy }: &Verdict) -> Self {
        Self { level: (*level).into(), because: because.clone(), remedy: remedy.clone() }
    }
}

impl fmt::Display for VerdictRecord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { level, because, remedy } = self.clone();
        Verdict { level: level.into(), because, remedy }.fmt(f)
    }
}

impl From<&Finding> for FindingRecord {
    fn from(Finding { what, remedy, .. }: &Finding) -> Self {
        Self { what: what.clone(), remedy: (*remedy).to_owned() }
    }
}

impl fmt::Display for FindingRecord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.what, self.remedy)
    }
}

impl From<&Termination> for TerminationRecord {
    fn from(termination: &Termination) -> Self {
        match *termination {
            Termination::Converged { gradient_norm } => Self::Converged { gradient_norm },
            Termination::IterationLimit => Self::IterationLimit,
            Termination::NoProgress { gradient_norm } => Self::NoProgress { gradient_norm },
        }
    }
}

impl From<&Fitted> for FittedRecord {
    fn from(&Fitted { value, sd, supported, .. }: &Fitted) -> Self {
        Self { value, sd, supported }
    }
}

impl EstimateRecord {
    /// Whether there are as many values as wavelengths, at least two.
    fn is_spectrum(&self) -> bool {
        let count = self.wavelengths_nm.len();
        let rows = self.covariance.iter().flatten();
        let totals = self.total_radiance_factor.iter().chain(&self.total_radiance_factor_sd);
        let lists = [&self.reflectance].into_iter().chain(&self.reflectance_sd).chain(totals).chain(rows);
        let mut counts = lists.map(Vec::len).chain(self.covariance.iter().map(Vec::len));
        count > 1 && counts.all(|other| other == count)
    }

    /// Refuses negative standard deviations, which would be drawn, written and converted like others.
    fn check_deviations(&self) -> Result<()> {
        let sent = self.fluorescence.iter().map(|found| &found.size_sd);
        checked_deviations("estimate.reflectance_sd", self.reflectance_sd.iter().flatten())?;
        checked_deviations(
            "estimate.total_radiance_factor_sd",
            self.total_radiance_factor_sd.iter().flatten(),
        )?;
        checked_deviations("estimate.fluorescence.size_sd", sent)?;
        checked_deviations("estimate.light.power_sd", self.light.iter().flat_map(|light| &light.power_sd))?;
        checked_deviations("estimate.fit", self.fits().map(|(_, fitted)| &fitted.sd))
    }

    /// Error bars of the reflectance; none if the method does not provide them.
    #[must_use]
    pub fn error_bars(&self) -> Option<ErrorBars<'_>> {
        match (&self.covariance, &self.reflectance_sd) {
            (Some(rows), _) => Some(ErrorBars::Covariance(rows)),
            (None, Some(sd)) => Some(ErrorBars::Deviations(sd)),
            (None, None) => None,
        }
    }

    /// The scene in the inferred light; none if the scene states its own.
    ///
    /// # Errors
    /// As [`Scene::in_light`].
    pub fn lit(&self, scene: &Scene) -> Result<Option<Scene>> {
        match &self.light {
            Some(light) if scene.is_light_unknown()? => scene.in_light(light.spectrum()).map(Some),
            Some(_) | None => Ok(None),
        }
    }

    /// The total radiance factor: the reflectance, unless the sheet was found to fluoresce.
    #[must_use]
    pub fn total_radiance_factor(&self) -> &[f64] {
        self.total_radiance_factor.as_ref().unwrap_or(&self.reflectance)
    }

    /// In the form of a file of spectra, under this name; for a fluorescent sheet also its total radiance
    /// factor, as `NAME total`.
    pub fn measured(&self, name: String) -> impl Iterator<Item = Measured> {
        let wavelengths_nm = self.wavelengths_nm.clone();
        let total = self.total_radiance_factor.as_ref().map(|total| Measured {
            name: format!("{name} total"),
            wavelengths_nm: wavelengths_nm.clone(),
            reflectance: total.clone(),
            reflectance_sd: self.total_radiance_factor_sd.clone(),
        });
        let (reflectance, reflectance_sd) = (self.reflectance.clone(), self.reflectance_sd.clone());
        iter::once(Measured { name, wavelengths_nm, reflectance, reflectance_sd }).chain(total)
    }

    /// The fitted unknowns with their values.
    pub fn fitted(&self) -> impl Iterator<Item = (&'static Unknown, f64)> {
        self.fit.iter().flat_map(Quantities::iter).map(|(unknown, fitted)| (unknown, fitted.value))
    }

    /// The fitted unknowns with their records.
    pub fn fits(&self) -> impl Iterator<Item = (&'static Unknown, &FittedRecord)> {
        self.fit.iter().flat_map(Quantities::iter)
    }

    /// Reasons why the estimate may be meaningless: facets far from the model, unknowns that the facets do
    /// not determine.
    #[must_use]
    pub fn doubts(&self) -> Vec<String> {
        let warning = Some(self.residual_rms).filter(|rms| *rms > WRONG_CHI).map(|rms| {
            format!(
                "the facets differ from the model by {rms:.0} times the expected error; \
                 check angle, corners, light, camera and exposure"
            )
        });
        // For a real sheet many unknowns are fitted by default, which remain at their priors unless the
        // facets determine them.
        let is_real =
            self.fit.iter().flat_map(Quantities::iter).any(|(unknown, _)| unknown.is_of_photographs());
        let assumed = self.fit.iter().flat_map(Quantities::iter);
        let assumed = assumed.filter(|(_, one)| !is_real && !one.supported);
        let assumed = assumed.map(|(unknown, _)| {
            format!("the facets hardly constrain {}: its value is mostly the prior's", unknown.name)
        });
        warning.into_iter().chain(assumed).collect()
    }
}

impl Sample {
    /// Adds an estimate and returns its record.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_estimate(&mut self, new: &NewEstimate) -> Result<EstimateRecord> {
        let NewEstimate { method, prior, wavelengths_nm, estimate, noise, joined, verdict, with_covariance } =
            *new;
        let reflectance_sd = estimate.reflectance_sd();
        finite("estimate.reflectance", &estimate.reflectance)?;
        finite("estimate.reflectance_sd", reflectance_sd.iter().flatten())?;
        finite("estimate.bihemispherical_albedo", estimate.albedo.iter().flatten())?;
        let sent = estimate.fluorescence.as_ref();
        let of = |is_behind: bool| sent.filter(|found| (found.origin == Origin::Behind) == is_behind);
        let (fluorescence, through) = (of(false), of(true));
        finite(
            "estimate.total_radiance_factor",
            fluorescence
                .into_iter()
                .flat_map(|found| found.total_radiance_factor.iter().chain(&found.total_radiance_factor_sd)),
        )?;
        finite("estimate", [&estimate.exposure, &estimate.residual_rms])?;
        finite("estimate.fit", estimate.fitted.iter().flat_map(|fitted| [&fitted.value, &fitted.sd]))?;
        let covariance = estimate.covariance().filter(|_| with_covariance);
        let rows = |matrix: nalgebra::DMatrix<f64>| {
            matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
        };
        let record = EstimateRecord {
            method: method.to_owned(),
            prior: prior.to_owned(),
            wavelengths_nm: wavelengths_nm.to_vec(),
            reflectance: estimate.reflectance.clone(),
            exposure: Some(estimate.exposure),
            residual_rms: estimate.residual_rms,
            iterations: estimate.iterations,
            termination: Some((&estimate.termination).into()),
            reflectance_sd,
            bihemispherical_albedo: estimate.albedo.clone(),
            total_radiance_factor: fluorescence.map(|found| found.total_radiance_factor.clone()),
            total_radiance_factor_sd: fluorescence.map(|found| found.total_radiance_factor_sd.clone()),
            fluorescence: fluorescence.map(FluorescenceRecord::of).transpose()?,
            light_through: through.map(LightThroughRecord::of).transpose()?,
            fit: Quantities::of(estimate.fitted.iter().map(|fitted| (fitted.unknown, fitted.into()))),
            joined: joined.to_vec(),
            day: estimate
                .day
                .map(|found| DayRecord { kind: found.day.name().to_owned(), probability: found.probability }),
            light: estimate.light.as_ref().map(InferredLightRecord::of).transpose()?,
            findings: estimate.findings.iter().map(FindingRecord::from).collect(),
            verdict: verdict.map(VerdictRecord::from),
            skipped: estimate.skipped.iter().map(SkippedRecord::from).collect(),
            covariance: covariance.map(rows),
            noise: noise.map(NoiseRecord::of).transpose()?,
        };
        self.fields.set("estimate", &record)?;
        Ok(record)
    }

    /// The noise of the facets assumed by an estimate of this sample.
    ///
    /// # Errors
    /// As [`Sample::noise`].
    pub fn noise_of(&self, estimate: &EstimateRecord) -> Result<Noise> {
        match &estimate.noise {
            Some(NoiseRecord { sd, model_error, .. }) => self.noise(*sd, Some(*model_error)),
            None => self.noise(None, None),
        }
    }

    /// The estimate; none if the sample has none, or carries an error.
    ///
    /// # Errors
    /// [`Error::Field`] unless it is a spectrum with as many values as wavelengths, each from 0 to 1, and
    /// standard deviations from 0.
    pub fn estimate(&self) -> Result<Option<EstimateRecord>> {
        match self.made::<EstimateRecord>("estimate")? {
            Some(estimate) if !estimate.is_spectrum() => {
                let problem = "needs as many values as wavelengths, two or more; estimate it again";
                Err(Error::field("estimate", problem))
            }
            Some(estimate) => {
                checked("estimate", &estimate.reflectance)?;
                let total = estimate.total_radiance_factor.iter().flatten();
                checked_radiance("estimate.total_radiance_factor", total)?;
                estimate.check_deviations()?;
                Ok(Some(estimate))
            }
            None => Ok(None),
        }
    }

    /// Whether this is the result of an estimate, successful or not, of `measured`.
    #[must_use]
    pub fn is_estimate_of(&self, measured: &Self) -> bool {
        let same = |name: &&str| self.fields.text(name) == measured.fields.text(name);
        let is_done = ["estimate", "error"].iter().any(|name| self.fields.text(name).is_some());
        is_done && ["id", "scene", "facet_rgb", "facet_sd", "exposure"].iter().all(same)
    }

    /// An estimate of this sample as a curve to draw.
    #[must_use]
    pub fn curve(&self, estimate: &EstimateRecord) -> Curve {
        // vscore checks the truth; what is not a spectrum cannot be drawn
        let truth = self.truth().ok().flatten().map(|truth| (truth.wavelengths_nm, truth.reflectance));
        let light = estimate.light.as_ref().map(InferredLightRecord::curve);
        Curve {
            name: self.id(),
            wavelengths_nm: estimate.wavelengths_nm.clone(),
            reflectance: estimate.reflectance.clone(),
            reflectance_sd: estimate.reflectance_sd.clone(),
            total: estimate.total_radiance_factor.clone(),
            truth,
            light,
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use serde_json::json;

    use super::*;

    #[test]
    fn other_programs_need_no_more_than_a_spectrum() {
        let read = |reflectance: &[f64]| {
            let mut sample = Sample::new("fold", "sheet").unwrap();
            sample
                .fields
                .set("estimate", json!({ "wavelengths_nm": [400, 410], "reflectance": reflectance }))
                .unwrap();
            sample.estimate()
        };
        assert_eq!(read(&[0.5, 0.6]).unwrap().unwrap().reflectance, [0.5, 0.6]);
        assert!(read(&[0.5]).unwrap_err().to_string().contains("as many values as wavelengths"));
    }
}
