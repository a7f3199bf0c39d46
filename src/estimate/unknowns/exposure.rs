//! How bright the picture is.

use super::{Effect, Expectation, Flag, Known, Normal, Role, Scale, Unknown, Whose};
use crate::estimate::photograph::Told;

/// Value of a perfect white diffuser facing the sun, in its strongest channel.
pub static EXPOSURE: Unknown = Unknown {
    name: "exposure",
    about: "Exposure: value of a perfect white diffuser that faces the sun, in its strongest channel",
    unit: None,
    flag: &Flag { value: "exposure", help: "Value of white facing the sun, as --exposure free" },
    range: 0.0..=f64::INFINITY,
    scale: Scale::Logarithm,
    role: Role::Exposure,
    photograph: Some(Effect {
        whose: Whose::Lens,
        known: |told| match told.exposure {
            Some(_) if told.by_chart => Known::Shown,
            Some(_) => Known::Stated,
            None if told.metered_exposure().is_some() => Known::Metered,
            None => Known::Usual,
        },
        prior: of_photograph,
        set: |conditions, value| conditions.exposure = value,
        symptom: None,
    }),
};

fn of_photograph(told: &Told) -> Option<Expectation> {
    let beliefs = told.beliefs;
    let sd = if told.by_chart { beliefs.exposure_shown_sd } else { beliefs.exposure_stated_sd };
    let known = told.exposure.map(|exposure| Normal { mean: exposure.ln(), sd });
    let usual = beliefs.exposure();
    let untold = || told.metered_exposure().map_or(usual, |metered| usual.and(metered));
    Some(known.unwrap_or_else(untold).into())
}
