//! Candidate lights for photographs whose light is not stated; the evidence chooses among them.

use super::{Spectrum, illuminant};
use crate::error::Result;

/// A light under which a photograph may have been taken.
#[derive(Clone, Debug, PartialEq)]
pub struct CandidateLight {
    /// Relative spectral power.
    pub spectrum: Spectrum,
    /// Prior probability; those of all candidates add up to 1.
    pub share: f64,
    /// Correlated colour temperature of daylight and black bodies, K.
    pub cct_k: Option<f64>,
    /// True for a daylight, all of which a photograph treats as one light of unknown temperature.
    pub is_any_daylight: bool,
}

/// A kind of light.
struct Kind {
    share: f64,
    is_any_daylight: bool,
    /// The lights, with reciprocal temperatures at this spacing, 1e-6/K.
    lights: fn(usize) -> Vec<(String, Option<f64>)>,
}

/// Spacing of reciprocal temperatures, 1e-6/K: facets accurate to one part in a thousand distinguish lights
/// between two of them from neither.
const STEP_MIRED: usize = 10;
/// The same for a known sheet.
const FINE_STEP_MIRED: usize = 2;

/// All that is known of where people fold sheets is that it is by day as often as not: the probabilities are
/// round numbers, none of them fitted.
const SOURCES: [Kind; 5] = [
    Kind {
        share: 0.4,
        is_any_daylight: true,
        lights: |step_mired| {
            of_temperatures((80..=250).step_by(step_mired), |cct_k| format!("daylight:{cct_k}"))
        },
    },
    Kind {
        share: 0.1,
        is_any_daylight: true,
        lights: |_| without_temperature(["sun:30deg", "sun:55deg", "sun:70deg", "sun:80deg"]),
    },
    Kind {
        share: 0.15,
        is_any_daylight: false,
        lights: |step_mired| of_temperatures((250..=400).step_by(step_mired), |cct_k| format!("{cct_k}K")),
    },
    Kind {
        share: 0.2,
        is_any_daylight: false,
        lights: |_| {
            let bulbs = ["B1", "B2", "B3", "B4", "B5", "BH1", "RGB1", "V1", "V2"];
            without_temperature(bulbs.map(|name| format!("LED-{name}")))
        },
    },
    Kind {
        share: 0.15,
        is_any_daylight: false,
        lights: |_| without_temperature((1..=12).map(|n| format!("FL{n}"))),
    },
];

fn of_temperatures(
    mired: impl Iterator<Item = usize>,
    name: impl Fn(f64) -> String,
) -> Vec<(String, Option<f64>)> {
    let light = |mired: usize| {
        let cct_k = (1e6 / mired as f64).round();
        (name(cct_k), Some(cct_k))
    };
    mired.map(light).collect()
}

fn without_temperature(names: impl IntoIterator<Item = impl Into<String>>) -> Vec<(String, Option<f64>)> {
    names.into_iter().map(|name| (name.into(), None)).collect()
}

/// Daylight of 4000 to 12 500 K, the sun at four heights, black bodies of 2500 to 4000 K, CIE's white LEDs
/// and fluorescent lamps, ordered so that similar lights are adjacent.
///
/// # Errors
/// Only if the embedded tables are damaged.
///
/// # Example
/// ```
/// use vfold::spectrum::candidate_lights;
/// let lights = candidate_lights()?;
/// assert!(lights.iter().any(|light| light.spectrum.name() == "FL11"));
/// assert!((lights.iter().map(|light| light.share).sum::<f64>() - 1.0).abs() < 1e-9);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn candidate_lights() -> Result<Vec<CandidateLight>> {
    lights_apart(STEP_MIRED)
}

/// The same lights, spaced more closely than the facets of a known sheet can distinguish.
///
/// # Errors
/// As [`candidate_lights`].
pub fn fine_candidate_lights() -> Result<Vec<CandidateLight>> {
    lights_apart(FINE_STEP_MIRED)
}

fn lights_apart(step_mired: usize) -> Result<Vec<CandidateLight>> {
    let of_kind = |kind: &Kind| {
        let lights = (kind.lights)(step_mired);
        let share = kind.share / lights.len() as f64;
        let is_any_daylight = kind.is_any_daylight;
        let light = move |(name, cct_k): (String, Option<f64>)| {
            Ok(CandidateLight { spectrum: illuminant(&name)?, share, cct_k, is_any_daylight })
        };
        lights.into_iter().map(light)
    };
    SOURCES.iter().flat_map(of_kind).collect()
}

/// The user's own lights, all equally probable.
#[must_use]
pub fn equal_candidates(spectra: Vec<Spectrum>) -> Vec<CandidateLight> {
    let share = 1.0 / spectra.len().max(1) as f64;
    let light = |spectrum| CandidateLight { spectrum, share, cct_k: None, is_any_daylight: false };
    spectra.into_iter().map(light).collect()
}
