//! Position of the sun across the crease.

use super::{Factor, Flag, FoldInLight, Known, Lamp, Normal, Role, Scale, Sources, Symptom, Unknown, Whose};
use crate::error::Result;

/// Angle of the sun off the bisecting plane, degrees.
pub static TILT: Unknown = Unknown {
    name: "tilt_deg",
    description: "Angle of the sun off the bisecting plane of the fold",
    unit: Some("degrees"),
    flag: &Flag { value: "tilt", help: "Angle of the sun off the bisecting plane of the fold" },
    scale: Scale::Linear,
    role: Role::Sources { range: f64::NEG_INFINITY..=f64::INFINITY, enter },
    whose: Whose::Fold,
    known: |_| Known::Stated,
    prior: |stated| Some(Normal { mean: stated.tilt_deg, sd: stated.priors.tilt_sd_deg }.into()),
    set: |conditions, value| conditions.tilt_deg = value,
    symptom: Some(Symptom {
        ideal: |stated| Some(stated.tilt_deg),
        least: 1.0,
        words: |_, _| "the sun stood elsewhere than stated".to_owned(),
        remedy: "turn the fold until both panels are equally bright, or give vkernel --tilt-deg",
    }),
};

/// Every sun is split into its even and odd parts.
fn enter(_: &FoldInLight, _: Normal, sources: &mut Sources) -> Result<()> {
    sources.replace(|source| match source.lamp {
        Lamp::Sun => {
            vec![
                source.with(TILT.name, Factor::Cosine).shining(Lamp::EvenSun),
                source.with(TILT.name, Factor::Sine).shining(Lamp::OddSun),
            ]
        }
        Lamp::EvenSun | Lamp::OddSun | Lamp::Sky { .. } => vec![source],
    });
    Ok(())
}
