//! Panels that bow.

use super::{AUTO, Expectation, Known, Normal, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Turn of both panels over their depth, degrees.
pub static BOW: Unknown = Unknown {
    name: "bow_deg",
    description: "Curvature of the panels: angle by which both turn from the crease to the outer side",
    unit: Some("degrees"),
    flag: &AUTO,
    scale: Scale::Linear,
    role: Role::Photograph,
    whose: Whose::Scene,
    known: |_| Known::Imperfection,
    prior,
    set: |conditions, value| conditions.bow_deg = value,
    symptom: Some(BOWED),
};

/// For both kinds of bow.
pub(super) const BOWED: Symptom = Symptom {
    ideal: |_| Some(0.0),
    least: 1.0,
    words: |_, _| "the panels bow".to_owned(),
    remedy: "hold them flat with stiff card behind them",
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    Some(Normal { mean: 0.0, sd: stated.priors.bow_sd_deg }.into())
}
