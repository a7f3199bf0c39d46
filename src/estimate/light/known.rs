//! Infers the light from a fold of a known sheet.
//!
//! If the reflectance is known, the probability of the facets in a light depends on little but that light:
//! the evidence distinguishes lights that unknown sheets leave open, and determines the exposure as well. The
//! unknowns of the fold's own scene are integrated out, as for any other.

use std::iter;

use nalgebra::DVector;

use super::known_photograph::{LN_HOPELESS, daylight_of_known};
use super::{Candidate, Others, ShownScenarios};
use crate::error::{Error, Result};
use crate::estimate::data::FacetData;
use crate::estimate::facets::{Facets, Second};
use crate::estimate::family::SpectrumModel;
use crate::estimate::gaussian::Gaussian;
use crate::estimate::noise::deviations;
use crate::estimate::photograph::priors::Priors;
use crate::estimate::photograph::{KnownReflectance, Parts, ShownDaylight};
use crate::estimate::prior::Prior;
use crate::estimate::rival::Rival;
use crate::estimate::smooth_errors::smooth_errors;
use crate::estimate::unknowns::Normal;
use crate::estimate::verdict::{Doubt, EXPLAINED};
use crate::forward::FacetValues;
use crate::solve::ln_sum;
use crate::solve::posterior::{Model, Solution, find_mode, first_tempering};

/// Relative error of a reflectance from a bench instrument: instruments of one model agree to 0.4 ΔE*94 on
/// average on ceramic tiles (X-Rite, *i1Pro 2*, technical specification), which is 1 % of a white sheet's
/// light, and sheets differ from place to place.
const SD: f64 = 0.01;
/// A mode counts as found within this many standard deviations; a search ends after this many iterations.
const TOLERANCE: f64 = 1e-3;
const LIMIT: usize = 500;

/// A sheet whose reflectance is known as well as an instrument repeats.
#[derive(Clone, Debug)]
pub struct KnownSheet {
    gaussian: Gaussian,
    /// The same as data for photographs.
    reflectance: KnownReflectance,
}

/// What a fold of a known sheet reveals about pictures taken in its light by the same camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// Logarithm of the exposure of computed facets in the stated light.
    pub exposure: Option<Normal>,
    /// A light that is more probable than the stated one.
    pub rival: Option<Rival>,
    /// What a photograph of the sheet reveals about unknown lights.
    pub scenarios: Option<ShownScenarios>,
    /// What it reveals about stated daylight.
    pub daylight: Option<ShownDaylight>,
    /// Deviation of the known facets from the model in the best light, in units of their noise.
    pub rms: f64,
}

/// Facets of a known sheet in a light.
struct InLight {
    solution: Solution<Second>,
    exposure: Option<Normal>,
    rms: f64,
}

impl InLight {
    /// Uses noise as large as the residuals in the best light: if no light explains the facets, lights are
    /// distinguished with less certainty.
    fn ln_evidence(&self, least_rms: f64) -> Option<f64> {
        self.solution.ln_evidence(least_rms.max(1.0))
    }
}

impl KnownSheet {
    /// A sheet of this reflectance, one number per wavelength.
    ///
    /// # Errors
    /// [`Error::Numeric`] without wavelengths.
    ///
    /// # Example
    /// ```
    /// use vfold::estimate::light::KnownSheet;
    /// assert!(KnownSheet::new(&[400.0, 550.0, 700.0], &[0.2, 0.18, 0.19]).is_ok());
    /// assert!(KnownSheet::new(&[], &[]).is_err());
    /// ```
    pub fn new(wavelengths_nm: &[f64], reflectance: &[f64]) -> Result<Self> {
        let sd: Vec<f64> = reflectance.iter().map(|r| SD * r).collect();
        let none = || Error::Numeric("a known sheet needs wavelengths".to_owned());
        let errors = smooth_errors(wavelengths_nm, &sd).ok_or_else(none)?;
        let known = KnownReflectance::new(wavelengths_nm, reflectance, &sd).ok_or_else(none)?;
        Ok(Self { gaussian: Gaussian::centred_on(reflectance, &errors), reflectance: known })
    }

    /// What a fold of it reveals in the stated light, which may be one of `others`.
    ///
    /// # Errors
    /// [`Error::Numeric`] if its facets are not finite.
    pub fn in_stated_light(&self, data: &FacetData, others: Option<&Others>) -> Result<Shown> {
        let stated = self.in_light(data).ok_or_else(not_finite)?;
        let others = others.map(Others::lights).unwrap_or_default();
        let in_others: Vec<_> =
            others.iter().map(|light| self.in_light(&data.in_light(&light.camera))).collect();
        let rms = least_rms(in_others.iter().flatten().chain([&stated]));
        let named = iter::zip(others, &in_others)
            .filter_map(|(light, one)| Some((light.name.clone(), one.as_ref()?.ln_evidence(rms)?)));
        let ln_stated = stated.ln_evidence(rms).ok_or_else(not_finite)?;
        let rival = Rival::of(named, ln_stated, Priors::USUAL.ln_odds_of_statement());
        Ok(Shown { rival, exposure: stated.exposure, scenarios: None, daylight: None, rms })
    }

    /// The `lights`, but for those between others, with their posterior probabilities given a fold of it,
    /// without those ruled out; and what else it reveals.
    ///
    /// # Errors
    /// [`Error::Numeric`] if its facets are not finite.
    pub fn weigh(&self, data: &FacetData, mut lights: Vec<Candidate>) -> Result<(Vec<Candidate>, Shown)> {
        lights.retain(|light| !light.is_between);
        let seen: Vec<_> = lights.iter().map(|light| self.in_light(&data.in_light(&light.camera))).collect();
        let rms = least_rms(seen.iter().flatten());
        let weighed = |(light, seen): (Candidate, Option<InLight>)| {
            let seen = seen?;
            let ln_share = light.ln_share + seen.ln_evidence(rms)?;
            Some(Candidate { ln_share, exposure: seen.exposure, ..light })
        };
        let lights = probable(iter::zip(lights, seen).filter_map(weighed).collect());
        if lights.is_empty() {
            return Err(not_finite());
        }
        Ok((lights, Shown { exposure: None, rival: None, scenarios: None, daylight: None, rms }))
    }

    /// What a photograph of it reveals: about `lights`, if the light is unknown, else about the stated
    /// daylight.
    ///
    /// # Arguments
    /// - `parts`: the ingredients of the photograph, in unstated daylight if the light is unknown.
    ///
    /// # Errors
    /// [`Error::Numeric`] if its facets are not finite.
    pub fn in_photograph(&self, parts: &Parts, lights: &[Candidate], prior: &Prior) -> Result<Shown> {
        let (scenarios, daylight) = if lights.is_empty() {
            (None, daylight_of_known(parts, &self.reflectance, prior))
        } else {
            (Some(ShownScenarios::of(parts, lights, &self.reflectance, prior)?), None)
        };
        let rms = scenarios.as_ref().map_or(0.0, |scenarios| scenarios.rms);
        Ok(Shown { exposure: None, rival: None, scenarios, daylight, rms })
    }

    /// Standard deviations of the facets `rgb` of its photograph if it lay flat: their brightness differs by
    /// the lens and the table alone, so that together they show one colour, to the accuracy of the camera's
    /// gains and sensitivities.
    ///
    /// # Example
    /// ```
    /// use vfold::estimate::light::KnownSheet;
    /// use vfold::forward::FacetValues;
    /// let rgb = nalgebra::DMatrix::from_fn(100, 3, |_, channel| [0.5, 0.4, 0.2][channel]);
    /// let rgb = FacetValues::from(&rgb);
    /// let sd = KnownSheet::flat_deviations(&rgb);
    /// let red = sd.facet(0).unwrap()[0] / 0.5;
    /// assert!((red - 0.25).abs() < 1e-9); // ten times that of their mean
    /// ```
    #[must_use]
    pub fn flat_deviations(rgb: &FacetValues) -> FacetValues {
        let Priors { gain_sd, sensitivity_sd, .. } = Priors::USUAL;
        let used = rgb.facets().flatten().count();
        deviations(rgb, |_| 0.0, gain_sd.hypot(sensitivity_sd) * (used as f64).sqrt())
    }

    fn in_light(&self, data: &FacetData) -> Option<InLight> {
        let model = Facets { data, gaussian: &self.gaussian };
        let start = DVector::zeros(model.unknowns());
        let first = first_tempering(&model, &start, 1.0);
        let solution = find_mode(&model, start, (first, 1.0), TOLERANCE, LIMIT);
        solution.ln_evidence(1.0).filter(|ln| ln.is_finite())?;
        let exposure = if data.fits_exposure() {
            let (value, spread) = (
                *model.values(&solution.w, &model.evaluate(&solution.w)).last()?,
                model.spread(&solution.w, &solution.at)?,
            );
            let sd = spread.column(spread.ncols() - 1).norm() / value;
            Some(Normal { mean: value.ln(), sd }).filter(|one| one.mean.is_finite() && one.sd.is_finite())
        } else {
            None
        };
        Some(InLight { rms: model.rms(&solution.at.residuals), solution, exposure })
    }
}

impl Shown {
    /// The doubt that the known fold casts on an estimate in light that was `stated`, if any was.
    #[must_use]
    pub fn doubt(&self, stated: Option<&str>) -> Option<Doubt> {
        if let (Some(rival), Some(stated)) = (&self.rival, stated) {
            let Doubt { because, remedy, .. } = rival.doubt_of_light(stated);
            return Some(Doubt::new(format!("by the known fold, {because}"), remedy));
        }
        (self.rms >= EXPLAINED).then(|| {
            Doubt::new(
                format!(
                    "the known fold's facets differ from the model by {:.1} times the expected error \
                     in every light",
                    self.rms
                ),
                "check its reflectance, angle and corners, and that the same camera took both",
            )
        })
    }
}

fn not_finite() -> Error {
    Error::Numeric("the facets of the known fold are not finite".to_owned())
}

fn least_rms<'a>(all: impl Iterator<Item = &'a InLight>) -> f64 {
    all.map(|one| one.rms).fold(f64::INFINITY, f64::min)
}

/// Candidates that remain possible, with probabilities that add up to 1.
fn probable(mut lights: Vec<Candidate>) -> Vec<Candidate> {
    let most = lights.iter().map(|light| light.ln_share).fold(f64::NEG_INFINITY, f64::max);
    lights.retain(|light| light.ln_share >= most + LN_HOPELESS);
    let ln_all = ln_sum(&lights.iter().map(|light| light.ln_share).collect::<Vec<_>>());
    lights.iter_mut().for_each(|light| light.ln_share -= ln_all);
    lights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::CameraResponse;
    use crate::estimate::Exposure;
    use crate::estimate::measured::Measured;
    use crate::estimate::unknowns::SceneModel;
    use crate::forward::{FacetModel, Lighting};
    use crate::geometry::{FacetGrid, Fold, Light};
    use crate::kernel::mesh::respond;
    use crate::spectrum::{Outside, WavelengthGrid, camera, equal_candidates, illuminant};

    const LIGHTS: [&str; 4] = ["D65", "A", "FL11", "LED-B3"];

    /// Lights weighed by a grey fold in the first of them with facet noise `noise_sd`, and the prior
    /// probability of each.
    fn weighed(noise_sd: f64) -> (Vec<Candidate>, f64) {
        let grid = WavelengthGrid::uniform(400.0, 700.0, 10.0).unwrap();
        let curves = camera("canon-5d-mark-ii").unwrap().channels;
        let curves: Vec<_> = curves.iter().map(|curve| curve.on(&grid, Outside::Zero).unwrap()).collect();
        let spectra = LIGHTS.map(|name| illuminant(name).unwrap());
        let eye =
            CameraResponse::new(&grid, &curves, &spectra[0].on(&grid, Outside::Refuse).unwrap()).unwrap();
        let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 4, cols: 2 }).unwrap();
        let (response, _) = respond(&fold, 1e-4).unwrap();
        let light = Light::new(&fold, 0.0, 0.0, 0.0).unwrap();
        let lighting = Lighting { light, sun: eye.clone(), sky: eye };
        let scene = SceneModel::known(FacetModel::one_sheet(&response, &lighting));
        let grey = vec![0.4; grid.len()];
        let rgb = FacetValues::from(&scene.facets().facet_rgb(&grey));
        let sd = deviations(&rgb, |_| noise_sd, 0.0);
        let data = FacetData::new(&scene, &Measured { rgb: &rgb, sd: &sd }, Exposure::Free, 1e-2).unwrap();
        let lights = Candidate::all(&equal_candidates(spectra.to_vec()), &grid, &curves).unwrap();
        let ln_share = lights[0].ln_share;
        let sheet = KnownSheet::new(grid.wavelengths_nm(), &grey).unwrap();
        (sheet.weigh(&data, lights).unwrap().0, ln_share)
    }

    #[test]
    fn facets_that_say_nothing_leave_lights_as_they_were() {
        let (lights, before) = weighed(1e4);
        assert_eq!(lights.len(), LIGHTS.len());
        assert!(lights.iter().all(|light| (light.ln_share - before).abs() < 1e-3), "{lights:?}");
    }

    #[test]
    fn precise_facets_tell_light_and_exposure() {
        let (lights, _) = weighed(1e-3);
        let most = lights.iter().max_by(|a, b| a.ln_share.total_cmp(&b.ln_share)).unwrap();
        assert!(most.name.contains("D65") && most.ln_share > 0.99_f64.ln(), "{lights:?}");
        let Normal { mean, sd } = most.exposure.unwrap();
        assert!(mean.abs() < 3.0 * sd && sd < 0.05, "{mean} {sd}");
    }
}
