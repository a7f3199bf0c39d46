//! The colour of the sun: daylight of unknown temperature.

use super::{
    Effect, Expectation, Factor, Flag, FoldInLight, Known, Lamp, Normal, Role, Scale, Sources, Symptom,
    Unknown, Whose,
};
use crate::camera::CameraResponse;
use crate::error::Result;
use crate::estimate::photograph::Told;
use crate::estimate::photograph::beliefs::Beliefs;
use crate::estimate::photograph::conditions::Daylight;

/// Correlated colour temperature of the sun, K. Facets tell little of it: what is known of direct sunlight takes the place of what was said.
pub static SUN_COLOUR: Unknown = Unknown {
    name: "sun_cct_k",
    about: "Correlated colour temperature of the sun",
    unit: Some("K"),
    flag: &Flag { value: "daylight", help: "Colour of the sun, where the illuminant is daylight" },
    range: 1e3..=1e5,
    scale: Scale::Reciprocal,
    role: Role::Sources { prior, enter },
    photograph: Some(Effect {
        whose: Whose::Light,
        known: |told| if told.is_daylight_assumed { Known::Usual } else { Known::Told },
        prior: of_photograph,
        set: |conditions, value| conditions.sun_mired = Some(1e6 / value),
        symptom: Some(Symptom {
            ideal: |told| 1e6 / told.daylight.map_or(told.beliefs.sun_mired, Daylight::mired),
            least: 400.0,
            words: |_, _| "the sun has another colour than was to be expected".to_owned(),
            remedy: "give vextract --illuminant sun:LAT,LON,TIME, or measure it",
        }),
    }),
};

fn prior(scene: &FoldInLight) -> Result<Option<Normal>> {
    Ok(scene.daylight.map(|said| of_daylight(said, &Beliefs::USUAL)))
}

fn of_photograph(told: &Told) -> Option<Expectation> {
    let shown = told.shown.and_then(|shown| shown.sun[told.day as usize]);
    told.daylight.map(|said| shown.unwrap_or_else(|| of_daylight(said, told.beliefs)).into())
}

fn of_daylight(said: Daylight, beliefs: &Beliefs) -> Normal {
    let mean = match said {
        Daylight::Cie { .. } => beliefs.sun_mired,
        Daylight::OfSun { mired } => mired,
    };
    Normal { mean, sd: beliefs.sun_mired_sd }
}

/// Every sun becomes three of other colours.
fn enter(scene: &FoldInLight, Normal { mean, sd }: Normal, sources: &mut Sources) -> Result<()> {
    let Some(said) = scene.daylight else { return Ok(()) };
    let nodes = [mean - 2.0 * sd, mean, mean + 2.0 * sd];
    let suns: Vec<_> = nodes.iter().map(|mired| sun(scene, said, *mired)).collect::<Result<_>>()?;
    sources.replace(|source| match source.lamp {
        Lamp::Sky { .. } => vec![source],
        Lamp::Sun | Lamp::EvenSun | Lamp::OddSun => {
            let of = |(at, sun): (usize, &CameraResponse)| {
                source.seen_by(sun.clone()).with(SUN_COLOUR.name, Factor::Node { nodes, at })
            };
            suns.iter().enumerate().map(of).collect()
        }
    });
    Ok(())
}

/// The camera's response to the sun, as much redder or bluer than it was said to be as daylight of this reciprocal temperature is.
fn sun(scene: &FoldInLight, said: Daylight, mired: f64) -> Result<CameraResponse> {
    let [now, said] = [mired, said.mired()].map(|mired| Daylight::power(&scene.daylight_vectors, mired));
    let power = scene.sun_power.component_mul(&now.component_div(&said));
    scene.lighting.sun.to_other_light(&scene.grid, &scene.sensitivities, power.as_slice())
}
