//! Amount of light from the sky.

use super::sources::Source;
use super::{
    Expectation, Factor, Flag, FoldInLight, Known, Lamp, Normal, Role, Scale, Sources, Unknown, Whose,
};
use crate::error::{Error, Result};
use crate::estimate::photograph::StatedScene;

/// Irradiance from the sky on an open horizontal plane, relative to the sun's on a plane facing it.
pub static SKY: Unknown = Unknown {
    name: "sky",
    description: "Diffuse-to-direct ratio: irradiance that the sky gives an open horizontal plane \
                  (a uniform sky: any open plane), relative to that which the sun gives a plane facing it",
    unit: None,
    flag: &Flag {
        value: "sky",
        help: "Amount of skylight, and its colour unless the scene has a sky illuminant",
    },
    scale: Scale::Linear,
    role: Role::Sources { range: 0.0..=f64::INFINITY, enter },
    whose: Whose::Light,
    known: |_| Known::Imperfection,
    prior,
    set: |conditions, value| conditions.sky = value,
    symptom: None,
};

/// Replaces any sky of the scene by one of irradiance 1 in an unknown amount.
fn enter(scene: &FoldInLight, _: Normal, sources: &mut Sources) -> Result<()> {
    if scene.stated.sun <= 0.0 {
        let problem = "there is no sun to which --fit sky could relate the sky; leave it out";
        return Err(Error::field("light.sun", problem));
    }
    sources.replace(|source| match source.lamp {
        Lamp::Sky { .. } => Vec::new(),
        Lamp::Sun | Lamp::EvenSun | Lamp::OddSun => vec![source],
    });
    let sky = Source::new(Lamp::Sky { irradiance: 1.0 }, scene.lighting.sky.clone());
    sources.add(sky.with(SKY.name, Factor::Amount));
    Ok(())
}

fn prior(stated: &StatedScene) -> Option<Expectation> {
    // a lamp shines without a sky, unless one is stated
    let has_sky = stated.daylight.is_some() || stated.has_sky_illuminant;
    let with_sun = stated.sky.filter(|_| stated.sun > 0.0);
    stated.day.sky(stated.priors, with_sun).filter(|_| has_sky).map(Normal::into)
}
