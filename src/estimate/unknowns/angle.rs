//! The opening angle of the fold.

use super::{
    Factor, Fitted, Flag, FoldInLight, Known, Normal, Role, Scale, Sources, State, Symptom, Unknown, Whose,
};
use crate::error::{Error, Result};
use crate::kernel::mesh::respond;

/// Angle between the panels, degrees. It takes two more solutions of the interreflections.
pub static ANGLE: Unknown = Unknown {
    name: "angle_deg",
    description: "Angle between the panels",
    unit: Some("degrees"),
    flag: &Flag { value: "angle", help: "Angle between the panels" },
    scale: Scale::Linear,
    role: Role::Sources { range: f64::NEG_INFINITY..=f64::INFINITY, enter },
    whose: Whose::Scene,
    known: |_| Known::Stated,
    prior: |stated| Some(Normal { mean: stated.angle_deg, sd: stated.angle_sd_deg }.into()),
    set: |conditions, value| conditions.angle_deg = value,
    symptom: Some(Symptom {
        ideal: |stated| Some(stated.angle_deg),
        least: 0.4,
        words: |Fitted { value, sd, .. }, stated| {
            format!("the fold's angle is {value:.1} ± {sd:.1}°, not {}° as stated", stated.angle_deg)
        },
        remedy: "measure the angle again",
    }),
};

/// Distance between the folds among which light is interpolated, degrees, at least: tails reach further than
/// a small standard deviation. At most it is this share of the angle, and of what it lacks to a flat sheet.
const APART_DEG: f64 = 2.0;
const APART_MOST: f64 = 0.1;
/// Folds that are nearer to each other are one.
const APART_LEAST_DEG: f64 = 1e-3;

/// The fold is one of three, or lies between them.
fn enter(scene: &FoldInLight, Normal { mean, sd }: Normal, sources: &mut Sources) -> Result<()> {
    let Some(tolerance) = scene.tolerance else {
        let problem = "--fit angle needs a scene from vkernel --mesh auto; make it again";
        return Err(Error::field("accuracy.mesh", problem));
    };
    let apart = (2.0 * sd).max(APART_DEG).min(APART_MOST * mean.min(180.0 - mean));
    if apart < APART_LEAST_DEG {
        return Err(Error::field("geometry.angle_deg", format!("{mean} is flat: no angle to fit")));
    }
    let nodes = [mean - apart, mean, mean + apart];
    let state = |(at, node): (usize, &f64)| {
        let fold = scene.fold.with_angle_deg(*node)?;
        // the stated fold is already solved
        let response = if at == 1 { scene.response.clone() } else { respond(&fold, tolerance)?.0 };
        Ok(State { fold, response, factors: vec![(ANGLE.name, Factor::Node { nodes, at })] })
    };
    sources.states = nodes.iter().enumerate().map(state).collect::<Result<_>>()?;
    Ok(())
}
