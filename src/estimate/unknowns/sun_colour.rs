//! The colour of the sun: daylight of unknown temperature.

use super::{
    Expectation, Flag, FoldInLight, Known, Lamp, Normal, Role, Scale, Sources, Symptom, Unknown, Whose,
};
use crate::camera::CameraResponse;
use crate::error::Result;
use crate::estimate::photograph::StatedScene;
use crate::estimate::photograph::conditions::Daylight;

/// Correlated colour temperature of the sun, K. As facets reveal little about it, the prior of direct
/// sunlight replaces the stated value.
pub static SUN_COLOUR: Unknown = Unknown {
    name: "sun_cct_k",
    description: "Correlated colour temperature of the sun",
    unit: Some("K"),
    flag: &Flag { value: "daylight", help: "Colour of the sun, where the illuminant is daylight" },
    scale: Scale::Reciprocal,
    role: Role::Sources { range: 1e3..=1e5, enter },
    whose: Whose::Light,
    known: |stated| if stated.is_daylight_assumed { Known::Usual } else { Known::Nominal },
    prior,
    set: |conditions, value| conditions.sun_mired = Some(1e6 / value),
    symptom: Some(Symptom {
        ideal: |stated| stated.daylight.map(|daylight| 1e6 / daylight.mired),
        least: 400.0,
        words: |_, _| "the fitted colour of the sunlight is not as expected".to_owned(),
        remedy: "give vextract --illuminant sun:LAT,LON,TIME, or measure it",
    }),
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    let shown = stated.shown.and_then(|shown| shown.sun[stated.day as usize]);
    let usual = |nominal: Daylight| {
        let mean = if nominal.is_cie { stated.priors.sun_mired } else { nominal.mired };
        Normal { mean, sd: stated.priors.sun_mired_sd }
    };
    stated.daylight.map(|nominal| shown.unwrap_or_else(|| usual(nominal)).into())
}

/// Every sun becomes three of different colours.
fn enter(scene: &FoldInLight, Normal { mean, sd }: Normal, sources: &mut Sources) -> Result<()> {
    let Some(nominal) = scene.stated.daylight else { return Ok(()) };
    let nodes = [mean - 2.0 * sd, mean, mean + 2.0 * sd];
    let suns: Vec<_> = nodes.iter().map(|mired| sun(scene, nominal, *mired)).collect::<Result<_>>()?;
    sources.replace(|source| match source.lamp {
        Lamp::Sky { .. } => vec![source],
        Lamp::Sun | Lamp::EvenSun | Lamp::OddSun => source.in_colours(SUN_COLOUR.name, nodes, &suns),
    });
    Ok(())
}

/// The camera's response to the sun, made redder or bluer than stated by the ratio of daylight at this
/// reciprocal temperature to the nominal one.
fn sun(scene: &FoldInLight, nominal: Daylight, mired: f64) -> Result<CameraResponse> {
    let [now, nominal] = [mired, nominal.mired].map(|mired| Daylight::power(&scene.daylight_vectors, mired));
    let power = scene.sun_power.component_mul(&now.component_div(&nominal));
    scene.lighting.sun.to_other_light(&scene.grid, &scene.sensitivities, power.as_slice())
}
