//! Candidate lights for photographs whose light is not stated; the evidence chooses among them.

use std::sync::OnceLock;

use super::{Spectrum, illuminant};
use crate::error::Result;

/// A light under which a photograph may have been taken.
#[derive(Clone, Debug, PartialEq)]
pub struct CandidateLight {
    /// Relative spectral power.
    pub spectrum: Spectrum,
    /// Prior probability. Those of all lights that are not between others add up to 1; one between others
    /// has its part of that of the light before it.
    pub share: f64,
    /// Correlated colour temperature of daylight and black bodies, K.
    pub cct_k: Option<f64>,
    /// True for a daylight, all of which a photograph treats as one light of unknown temperature.
    pub is_any_daylight: bool,
    /// True for a light between two similar ones that are not. It is tried only if the evidence tells those
    /// two apart, and then shares the probability of the one before it.
    pub is_between: bool,
}

/// A kind of light.
struct Kind {
    share: f64,
    is_any_daylight: bool,
    lights: fn() -> Vec<(String, Option<f64>)>,
}

/// Spacing of reciprocal temperatures, 1e-6/K: facets accurate to one part in a hundred hardly distinguish
/// neighbours.
const STEP_MIRED: usize = 10;
/// The same with lights between them, which facets of a known sheet do not distinguish.
const FINE_STEP_MIRED: usize = 2;

/// All that is known of where people fold sheets is that it is by day as often as not: the probabilities are
/// round numbers, none of them fitted.
const SOURCES: [Kind; 5] = [
    Kind {
        share: 0.4,
        is_any_daylight: true,
        lights: || of_temperatures((80..=250).step_by(FINE_STEP_MIRED), |cct_k| format!("daylight:{cct_k}")),
    },
    Kind {
        share: 0.1,
        is_any_daylight: true,
        lights: || without_temperature(["sun:30deg", "sun:55deg", "sun:70deg", "sun:80deg"]),
    },
    Kind {
        share: 0.15,
        is_any_daylight: false,
        lights: || of_temperatures((250..=400).step_by(FINE_STEP_MIRED), |cct_k| format!("{cct_k}K")),
    },
    Kind {
        share: 0.2,
        is_any_daylight: false,
        lights: || {
            let bulbs = ["B1", "B2", "B3", "B4", "B5", "BH1", "RGB1", "V1", "V2"];
            without_temperature(bulbs.map(|name| format!("LED-{name}")))
        },
    },
    Kind {
        share: 0.15,
        is_any_daylight: false,
        lights: || without_temperature((1..=12).map(|n| format!("FL{n}"))),
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
pub fn candidate_lights() -> Result<&'static [CandidateLight]> {
    // every photograph asks for them
    static LIGHTS: OnceLock<Vec<CandidateLight>> = OnceLock::new();
    if let Some(lights) = LIGHTS.get() {
        return Ok(lights);
    }
    let lights = spaced(STEP_MIRED / FINE_STEP_MIRED, false)?;
    Ok(LIGHTS.get_or_init(|| lights))
}

/// The same lights, and those [between](CandidateLight::is_between) them.
///
/// # Errors
/// As [`candidate_lights`].
pub fn candidate_lights_and_between() -> Result<Vec<CandidateLight>> {
    spaced(STEP_MIRED / FINE_STEP_MIRED, true)
}

/// The same lights, all of them as close as those between others.
///
/// # Errors
/// As [`candidate_lights`].
pub fn fine_candidate_lights() -> Result<Vec<CandidateLight>> {
    spaced(1, true)
}

/// One light in `steps` of each series of temperatures, and those between them if `with_between`.
fn spaced(steps: usize, with_between: bool) -> Result<Vec<CandidateLight>> {
    let of_kind = |kind: &Kind| {
        let lights = (kind.lights)();
        let is_between = |(n, (_, cct_k)): (usize, &(String, Option<f64>))| cct_k.is_some() && n % steps > 0;
        let between: Vec<bool> = lights.iter().enumerate().map(is_between).collect();
        let share = kind.share / between.iter().filter(|is_between| !**is_between).count() as f64;
        let is_any_daylight = kind.is_any_daylight;
        let light = move |((name, cct_k), is_between): ((String, Option<f64>), bool)| {
            let share = if is_between { share / steps as f64 } else { share };
            Ok(CandidateLight { spectrum: illuminant(&name)?, share, cct_k, is_any_daylight, is_between })
        };
        lights.into_iter().zip(between).filter(move |(_, is_between)| with_between || !is_between).map(light)
    };
    SOURCES.iter().flat_map(of_kind).collect()
}

/// The user's own lights, all equally probable.
#[must_use]
pub fn equal_candidates(spectra: Vec<Spectrum>) -> Vec<CandidateLight> {
    let share = 1.0 / spectra.len().max(1) as f64;
    let light = |spectrum| {
        let (is_any_daylight, is_between) = (false, false);
        CandidateLight { spectrum, share, cct_k: None, is_any_daylight, is_between }
    };
    spectra.into_iter().map(light).collect()
}
