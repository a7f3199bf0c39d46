//! The colour of the sky: daylight of unknown temperature.

use super::{Expectation, FoldInLight, Known, Lamp, Normal, Role, SKY, Scale, Sources, Unknown, Whose};
use crate::camera::CameraResponse;
use crate::error::Result;
use crate::estimate::photograph::StatedScene;
use crate::spectrum::{self, Outside};

/// Correlated colour temperature of the sky, K, unless the scene has a sky illuminant; its reciprocal, in
/// 1e-6/K, is normal.
pub static SKY_COLOUR: Unknown = Unknown {
    name: "sky_cct_k",
    description: "Correlated colour temperature of the sky",
    unit: Some("K"),
    flag: SKY.flag,
    scale: Scale::Reciprocal,
    role: Role::Sources { range: 1e3..=1e5, enter },
    whose: Whose::Light,
    known: |_| Known::OfImperfection,
    prior,
    set: |conditions, value| conditions.sky_mired = Some(1e6 / value),
    symptom: None,
};

/// Temperatures of the skies between which others are interpolated, K.
const SKIES_K: [u32; 3] = [20_000, 10_000, 6_250];

/// Every sky becomes three of different colours.
fn enter(scene: &FoldInLight, _: Normal, sources: &mut Sources) -> Result<()> {
    let nodes = SKIES_K.map(|cct_k| 1e6 / f64::from(cct_k));
    let skies: Vec<_> = SKIES_K.iter().map(|cct_k| daylight(scene, *cct_k)).collect::<Result<_>>()?;
    sources.replace(|source| match source.lamp {
        Lamp::Sky { .. } => source.in_colours(SKY_COLOUR.name, nodes, &skies),
        Lamp::Sun | Lamp::EvenSun | Lamp::OddSun => vec![source],
    });
    Ok(())
}

/// The camera's response to daylight of this temperature.
fn daylight(scene: &FoldInLight, cct_k: u32) -> Result<CameraResponse> {
    let power = spectrum::illuminant(&format!("daylight:{cct_k}"))?.on(&scene.grid, Outside::Refuse)?;
    scene.lighting.sun.to_other_light(&scene.grid, &scene.sensitivities, &power)
}

fn prior(stated: &StatedScene) -> Option<Expectation> {
    let shown = stated.shown.and_then(|shown| shown.sky[stated.day as usize]);
    let usual = || stated.day.sky_mired(stated.priors);
    stated.daylight.filter(|_| !stated.has_sky_illuminant).map(|_| shown.unwrap_or_else(usual).into())
}
