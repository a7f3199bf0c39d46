//! An unknown light, inferred by evidence.
//!
//! Residuals do not distinguish lights: some spectrum explains the facets in almost every one. The
//! probability of that spectrum does. Each light is therefore a hypothesis, weighed by its evidence under the
//! prior on reflectances, and the estimate is the mean over all of them, as over classes of spectra.

mod in_order;
mod known;
mod known_photograph;
mod photograph;
mod scenario;
mod stated;
mod stated_photograph;

use std::iter;

pub(super) use in_order::lights_in_order;
pub use known::{KnownSheet, Shown};
pub use known_photograph::ShownScenarios;
pub use photograph::estimate_photograph;
pub use stated::{Others, rival};
pub use stated_photograph::rival_in_photograph;

use crate::camera::CameraResponse;
use crate::error::Result;
use crate::estimate::data::FacetData;
use crate::estimate::unknowns::Normal;
use crate::spectrum::{CandidateLight, Outside, WavelengthGrid};

/// A candidate light, on the wavelengths of a scene.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Its name.
    pub name: String,
    /// Correlated colour temperature, K, if it is defined by one.
    pub cct_k: Option<f64>,
    /// Logarithm of its prior probability.
    pub ln_share: f64,
    /// Relative power, one number per waveband.
    pub power: Vec<f64>,
    /// The camera's response to it.
    pub camera: CameraResponse,
    /// True for a daylight, all of which a photograph treats as one light of unknown temperature.
    pub is_any_daylight: bool,
    /// True for a light between two similar ones that are not. It is tried only if the evidence tells those
    /// two apart, and then shares the probability of the one before it.
    pub is_between: bool,
    /// Logarithm of the exposure of a picture in it, if a known fold reveals it.
    pub exposure: Option<Normal>,
}

/// A candidate with its posterior probability.
#[derive(Clone, Debug, PartialEq)]
pub struct Weighed {
    /// Its name.
    pub name: String,
    /// Correlated colour temperature, K, if it is defined by one.
    pub cct_k: Option<f64>,
    /// Its probability.
    pub probability: f64,
}

/// An inferred light.
#[derive(Clone, Debug, PartialEq)]
pub struct InferredLight {
    /// Possible candidates, the most probable first; their probabilities add up to 1.
    pub candidates: Vec<Weighed>,
    /// The expected relative power, one number per waveband, with mean 1.
    pub power: Vec<f64>,
    /// Its standard deviation.
    pub power_sd: Vec<f64>,
}

impl Candidate {
    /// Candidates for a camera with these sensitivities, `[channel][waveband]`.
    ///
    /// # Errors
    /// [`crate::Error::Spectrum`] if a light does not cover the wavelengths, [`crate::Error::Numeric`] if a
    /// channel does not respond to it.
    pub fn all(
        lights: &[CandidateLight],
        grid: &WavelengthGrid,
        sensitivities: &[Vec<f64>],
    ) -> Result<Vec<Self>> {
        let candidate = |light: &CandidateLight| {
            let power = light.spectrum.on(grid, Outside::Refuse)?;
            Ok(Self {
                name: light.spectrum.name().to_owned(),
                cct_k: light.cct_k,
                ln_share: light.share.ln(),
                is_any_daylight: light.is_any_daylight,
                is_between: light.is_between,
                exposure: None,
                camera: CameraResponse::new(grid, sensitivities, &power)?,
                power,
            })
        };
        lights.iter().map(candidate).collect()
    }
}

impl Candidate {
    /// Facets in this light.
    pub(super) fn on<'a>(&self, data: &FacetData<'a>) -> FacetData<'a> {
        data.in_light(&self.camera).expecting(self.exposure)
    }

    pub(super) fn weighed(&self, probability: f64) -> Weighed {
        Weighed { name: self.name.clone(), cct_k: self.cct_k, probability }
    }
}

impl InferredLight {
    /// From lights with these powers, whose probabilities add up to 1; those with probability 0 are omitted.
    #[must_use]
    pub fn of<'p>(all: impl IntoIterator<Item = (Weighed, &'p [f64])>) -> Self {
        let (mut candidates, mut power, mut square) = (Vec::new(), Vec::new(), Vec::new());
        for (mut light, own) in all.into_iter().filter(|(light, _)| light.probability > 0.0) {
            // a sum of shares may exceed 1 by rounding
            light.probability = light.probability.min(1.0);
            power.resize(own.len(), 0.0);
            square.resize(own.len(), 0.0);
            let mean = own.iter().sum::<f64>() / own.len() as f64;
            for (band, own) in own.iter().enumerate() {
                power[band] += light.probability * own / mean;
                square[band] += light.probability * (own / mean).powi(2);
            }
            candidates.push(light);
        }
        candidates.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        let sd = |(square, mean): (&f64, &f64)| (square - mean * mean).max(0.0).sqrt();
        Self { candidates, power_sd: iter::zip(&square, &power).map(sd).collect(), power }
    }

    /// The most probable candidate, if it is among `all`.
    #[must_use]
    pub fn most_probable<'a>(&self, all: &'a [Candidate]) -> Option<&'a Candidate> {
        let first = self.candidates.first()?;
        all.iter().find(|light| light.name == first.name)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// The mean lies between the lights, and its standard deviation is no more than their difference.
        #[test]
        fn the_expected_light_lies_between_the_candidates(
            shares in prop::collection::vec(0.0_f64..1.0, 3),
            powers in prop::collection::vec(prop::collection::vec(0.1_f64..10.0, 5), 3),
        ) {
            let sum: f64 = shares.iter().sum();
            prop_assume!(sum > 0.01);
            let light = |share: &f64| Weighed { name: String::new(), cct_k: None, probability: share / sum };
            let lights = iter::zip(shares.iter().map(light), powers.iter().map(Vec::as_slice));
            let found = InferredLight::of(lights);
            let total: f64 = found.candidates.iter().map(|light| light.probability).sum();
            prop_assert!((total - 1.0).abs() < 1e-12);
            prop_assert!(found.candidates.is_sorted_by(|a, b| a.probability >= b.probability));
            prop_assert!((found.power.iter().sum::<f64>() / 5.0 - 1.0).abs() < 1e-12);
            for band in 0..5 {
                let own = powers.iter().map(|power| 5.0 * power[band] / power.iter().sum::<f64>());
                let (least, most) =
                    own.fold((f64::INFINITY, 0.0_f64), |(a, b), own| (a.min(own), b.max(own)));
                prop_assert!((least - 1e-12..=most + 1e-12).contains(&found.power[band]));
                prop_assert!(found.power_sd[band] <= most - least + 1e-6);
            }
        }
    }

    #[test]
    fn one_candidate_is_the_light() {
        let one = Weighed { name: "A".to_owned(), cct_k: Some(2856.0), probability: 1.0 };
        let found = InferredLight::of([(one.clone(), [2.0, 4.0].as_slice())]);
        assert_eq!((found.candidates, found.power_sd), (vec![one], vec![0.0; 2]));
    }
}
