//! Whether another angle explains a photograph of an ideal fold better than the one that was told.
//!
//! A wrong angle makes another spectrum of nearly the same facets: what is left of them says little of it, the angle that they tell much.

use std::sync::OnceLock;

use vfold::Result;
use vfold::estimate::data::FacetData;
use vfold::estimate::measured::Measured;
use vfold::estimate::photograph::Finding;
use vfold::estimate::prior::Prior;
use vfold::estimate::unknowns::{ANGLE, SceneModel, Unknown};
use vfold::estimate::verdict::{Doubt, EXPLAINED};
use vfold::estimate::{Estimate, Exposure, Fitted, map};
use vfold::scene::Setting;
use vfold::stream::Scene;

use super::estimator::CUTOFF;

/// Standard deviations between an angle and the one that was told that are no chance.
const SURE: f64 = 3.0;
/// An angle that is told is known to that, degrees: whose fold is open by so much more told something else wrong, too.
const TOLD_DEG: f64 = 4.0;

/// Relative error of facet means at which a glance is taken at other angles, and how many standard deviations and how much misfit it must
/// find for a second look.
const ROUGH: f64 = 1e-3;
const PROMISING: f64 = 2.0;
const PROMISING_MISFIT: f64 = 1.5 * EXPLAINED;

/// A scene with its angle unknown, for a glance and for an estimate, each made when a sample first asks for it.
#[derive(Default)]
pub struct OtherAngle {
    rough: OnceLock<Option<SceneModel>>,
    fine: OnceLock<Option<SceneModel>>,
}

/// An estimate with the angle that the facets tell.
pub struct Turned {
    pub estimate: Estimate,
    told_deg: f64,
    value_deg: f64,
    sd_deg: f64,
}

impl OtherAngle {
    /// The estimate under another angle, if the `misfit` under the angle that was told is worse.
    pub fn better(
        &self,
        misfit: f64,
        scene: &Scene,
        fit: &[&'static Unknown],
        (measured, exposure): (&Measured, Exposure),
        prior: &Prior,
    ) -> Result<Option<Turned>> {
        let Some(told_deg) = scene.fold_if_one()?.map(|fold| fold.angle_deg()) else { return Ok(None) };
        if fit.contains(&&ANGLE) {
            return Ok(None);
        }
        let fit: Vec<_> = fit.iter().copied().chain([&ANGLE]).collect();
        let Some(rough) = made(&self.rough, scene, &fit, ROUGH) else { return Ok(None) };
        let data = FacetData::new(rough, measured, exposure, CUTOFF)?;
        let promises = |seen: Estimate| {
            let is_off = angle(&seen).is_some_and(|angle| off(angle, told_deg) > PROMISING);
            is_off && seen.residual_rms < (1.05 * misfit).min(PROMISING_MISFIT)
        };
        // a glance that does not end says nothing
        if !map::glance(&data, prior).is_none_or(promises) {
            return Ok(None);
        }
        let Some(model) = made(&self.fine, scene, &fit, 0.0) else { return Ok(None) };
        let data = FacetData::new(model, measured, exposure, CUTOFF)?;
        let estimate = map::estimate(&data, prior, None);
        let Some(angle) = angle(&estimate) else { return Ok(None) };
        let (value_deg, sd_deg) = (angle.value, angle.sd);
        let is_better = estimate.residual_rms < misfit.min(EXPLAINED) && off(angle, told_deg) > SURE;
        Ok(is_better.then_some(Turned { estimate, told_deg, value_deg, sd_deg }))
    }
}

fn angle(estimate: &Estimate) -> Option<&Fitted> {
    estimate.fitted.iter().find(|one| one.unknown == &ANGLE)
}

/// How far an angle is from the one that was told, in standard deviations.
fn off(angle: &Fitted, told_deg: f64) -> f64 {
    (angle.value - told_deg).abs() / angle.sd
}

/// The scene with these unknowns; none if it has no other angle, as of a flat fold, or of one that was given facet by facet.
///
/// Who finds none makes one: to wait for another thread that makes it would be for ever, since while that thread waits for the parts of its
/// own work it may take up the sample that waits.
fn made<'a>(
    model: &'a OnceLock<Option<SceneModel>>,
    scene: &Scene,
    fit: &[&'static Unknown],
    tolerance: f64,
) -> Option<&'a SceneModel> {
    if model.get().is_none() {
        let made = Setting::of(scene).and_then(|setting| setting.model_to_fit_within(fit, tolerance)).ok();
        model.get_or_init(|| made);
    }
    model.get()?.as_ref()
}

impl Turned {
    /// The estimate with the angle that the facets tell, which is said.
    pub fn into_estimate(self, doubts: &mut Vec<Doubt>) -> Estimate {
        doubts.extend(self.doubt_if_far());
        let findings = vec![self.finding()];
        Estimate { findings, ..self.estimate }
    }

    /// What is said of it where the estimate takes the angle of the facets.
    fn finding(&self) -> Finding {
        let Self { told_deg, value_deg, sd_deg, .. } = self;
        let what = format!("the fold is open by {value_deg:.1} ± {sd_deg:.1}°, not {told_deg}° as told");
        Finding { what, remedy: "measure the angle again", is_unusual: false }
    }

    /// Why the estimate is doubtful where that angle is far from the one that was told.
    fn doubt_if_far(&self) -> Option<Doubt> {
        let is_far = (self.value_deg - self.told_deg).abs() > TOLD_DEG;
        is_far.then(|| {
            Doubt::new(self.finding().what, "measure the angle again, and look at all else that was told")
        })
    }

    /// Why the estimate is doubtful where it keeps the angle that was told.
    pub fn doubt_if_kept(&self) -> Doubt {
        let Self { told_deg, value_deg, sd_deg, .. } = self;
        let because = format!(
            "a fold open by {value_deg:.1} ± {sd_deg:.1}°, not {told_deg}° as told, explains the facets better"
        );
        Doubt::new(because, "measure the angle again, or leave --fit out")
    }
}
