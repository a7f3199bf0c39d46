//! The opening angle of the fold.

use super::{
    Effect, Expectation, Factor, Fitted, Flag, FoldInLight, Known, Normal, Role, Scale, Sources, State,
    Symptom, Unknown, Whose,
};
use crate::error::{Error, Result};
use crate::estimate::photograph::StatedScene;
use crate::kernel::mesh::respond;

/// Angle between the panels, degrees. It takes two more solutions of the interreflections.
pub static ANGLE: Unknown = Unknown {
    name: "angle_deg",
    description: "Angle between the panels",
    unit: Some("degrees"),
    flag: &Flag { value: "angle", help: "Angle between the panels" },
    range: f64::NEG_INFINITY..=f64::INFINITY,
    scale: Scale::Linear,
    role: Role::Sources { prior, enter },
    photograph: Some(Effect {
        whose: Whose::Scene,
        known: |_| Known::Stated,
        prior: of_photograph,
        set: |conditions, value| conditions.angle_deg = value,
        symptom: Some(Symptom {
            ideal: |stated| stated.angle_deg,
            least: 0.4,
            words: |Fitted { value, sd, .. }, stated| {
                format!("the fold is open by {value:.1} ± {sd:.1}°, not {}° as stated", stated.angle_deg)
            },
            remedy: "measure the angle again",
        }),
    }),
};

/// Standard deviation of an angle, degrees, or a tenth of the angle if that is less: the error of a
/// protractor and of a sheet that springs back. It is also the spacing of the folds between which light is
/// interpolated.
const SD_DEG: f64 = 2.0;

fn prior(scene: &FoldInLight) -> Result<Option<Normal>> {
    let angle_deg = scene.fold.angle_deg();
    let sd = SD_DEG.min(0.1 * angle_deg);
    if angle_deg + sd > 180.0 {
        return Err(Error::field("geometry.angle_deg", format!("{angle_deg} is flat: no angle to fit")));
    }
    Ok(Some(Normal { mean: angle_deg, sd }))
}

/// The fold is one of three, or lies between them.
fn enter(scene: &FoldInLight, Normal { mean, sd }: Normal, sources: &mut Sources) -> Result<()> {
    let Some(tolerance) = scene.tolerance else {
        let problem = "--fit angle needs a scene from vkernel --mesh auto; make it again";
        return Err(Error::field("accuracy.mesh", problem));
    };
    let nodes = [mean - sd, mean, mean + sd];
    let state = |(at, node): (usize, &f64)| {
        let fold = scene.fold.with_angle_deg(*node)?;
        // the stated fold is already solved
        let response = if at == 1 { scene.response.clone() } else { respond(&fold, tolerance)?.0 };
        Ok(State { fold, response, factors: vec![(ANGLE.name, Factor::Node { nodes, at })] })
    };
    sources.states = nodes.iter().enumerate().map(state).collect::<Result<_>>()?;
    Ok(())
}

fn of_photograph(stated: &StatedScene) -> Option<Expectation> {
    Some(Normal { mean: stated.angle_deg, sd: stated.angle_sd_deg }.into())
}
