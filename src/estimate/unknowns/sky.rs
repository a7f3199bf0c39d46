//! Amount of light from the sky.

use super::sources::Source;
use super::{
    Effect, Expectation, Factor, Flag, FoldInLight, Known, Lamp, Normal, Role, Scale, Sources, Unknown, Whose,
};
use crate::error::Result;
use crate::estimate::photograph::StatedScene;

/// Irradiance from the sky on a plane facing the sun, relative to the sun's.
pub static SKY: Unknown = Unknown {
    name: "sky",
    description: "Diffuse-to-direct ratio: irradiance that the sky gives an unobstructed plane facing \
                  the sun, relative to that which the sun gives it",
    unit: None,
    flag: &Flag {
        value: "sky",
        help: "Amount of skylight, and its colour unless the scene has a sky illuminant",
    },
    range: 0.0..=f64::INFINITY,
    scale: Scale::Linear,
    role: Role::Sources { prior, enter },
    photograph: Some(Effect {
        whose: Whose::Light,
        known: |_| Known::Imperfection,
        prior: of_photograph,
        set: |conditions, value| conditions.sky = value,
        symptom: None,
    }),
};

/// Standard deviation of the sky: a clear one gives a tenth to a third of the sun's light, a hazy one half of
/// it, and a sheet among houses gets a part of that.
const SD: f64 = 0.25;

fn prior(scene: &FoldInLight) -> Result<Option<Normal>> {
    Ok(Some(Normal { mean: scene.lighting.light.sky(), sd: SD }))
}

/// Replaces any sky of the scene by one of irradiance 1 in an unknown amount.
fn enter(scene: &FoldInLight, _: Normal, sources: &mut Sources) -> Result<()> {
    sources.replace(|source| match source.lamp {
        Lamp::Sky { .. } => Vec::new(),
        Lamp::Sun | Lamp::EvenSun | Lamp::OddSun => vec![source],
    });
    let sky = Source::new(Lamp::Sky { irradiance: 1.0 }, scene.lighting.sky.clone());
    sources.add(sky.with(SKY.name, Factor::Amount));
    Ok(())
}

fn of_photograph(stated: &StatedScene) -> Option<Expectation> {
    let with_sun = stated.sky.filter(|_| stated.sun > 0.0);
    stated.daylight.and_then(|_| stated.day.sky(stated.priors, with_sun)).map(Normal::into)
}
