//! Lights that a photograph may have been taken in, where nobody says which: what evidence chooses from.

use super::{Spectrum, illuminant};
use crate::error::Result;

/// A light that may have been the one.
#[derive(Clone, Debug, PartialEq)]
pub struct CandidateLight {
    /// Its relative power.
    pub spectrum: Spectrum,
    /// How often it is the one, the shares of all adding up to 1.
    pub share: f64,
    /// Correlated colour temperature of daylight and black bodies, K.
    pub cct_k: Option<f64>,
    /// Whether it is one of all daylights, which a photograph takes as one light of unknown temperature.
    pub is_any_daylight: bool,
}

/// Lights of one kind.
struct Kind {
    share: f64,
    is_any_daylight: bool,
    /// With reciprocal temperatures so far apart, 1e-6/K.
    lights: fn(usize) -> Vec<(String, Option<f64>)>,
}

/// Reciprocal temperatures, 1e-6/K, are this far apart: lights between two of them are distinguished from
/// neither by facets of one part in a thousand.
const STEP_MIRED: usize = 10;
/// The same of a sheet that is known.
const FINE_STEP_MIRED: usize = 2;

/// Nothing is known of where people fold sheets but that it is by day as often as not: round shares, none of
/// them fitted.
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
/// and fluorescent lamps, neighbours next to each other.
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

/// The same nearer to each other than facets of a known sheet tell.
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

/// Lights of one's own, each as probable as any other.
#[must_use]
pub fn equal_candidates(spectra: Vec<Spectrum>) -> Vec<CandidateLight> {
    let share = 1.0 / spectra.len().max(1) as f64;
    let light = |spectrum| CandidateLight { spectrum, share, cct_k: None, is_any_daylight: false };
    spectra.into_iter().map(light).collect()
}
