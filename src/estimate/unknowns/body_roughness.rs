//! Roughness of the sheet below its surface.

use super::{AUTO, Expectation, Known, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Body roughness: spread of the slopes of the body's microfacets (Oren and Nayar's sigma), degrees.
pub static BODY_ROUGHNESS: Unknown = Unknown {
    name: "body_roughness_deg",
    description: "Roughness of the body of the sheet: the spread of the slopes \
                  of its facets (Oren and Nayar's sigma)",
    unit: Some("degrees"),
    flag: &AUTO,
    scale: Scale::Positive,
    role: Role::Photograph,
    whose: Whose::Sheet,
    known: |_| Known::Imperfection,
    prior,
    set: |conditions, value| conditions.body_roughness_deg = value,
    symptom: Some(Symptom {
        ideal: |_| Some(0.0),
        least: 10.0,
        words: |_, _| "the sheet is rough".to_owned(),
        remedy: "include a colour chart or a white card",
    }),
};

fn prior(stated: &StatedScene) -> Option<Expectation> {
    Some(stated.priors.amount(stated.priors.body_roughness_deg))
}
