//! How bright the picture is.

use super::{Effect, Flag, Known, Normal, Role, Scale, Told, Unknown, Whose};

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
            None => Known::Usual,
        },
        prior: of_photograph,
        set: |conditions, value| conditions.exposure = value,
        symptom: None,
    }),
};

/// Standard deviations of the logarithm of an exposure: one that was given; and one by a chart or a card, which is uneven, not quite where
/// the sheet is, nor turned as it was said to be.
const GIVEN_SD: f64 = 0.02;
const CHART_SD: f64 = 0.04;
/// The logarithm of an exposure that nobody states: people expose so that white that faces the sun lies within a third and three times the
/// white level of the picture in nineteen cases of twenty.
pub const EXPOSURE_OF_PHOTOGRAPH: Normal = Normal { mean: 0.0, sd: 0.55 };

fn of_photograph(told: &Told) -> Option<Normal> {
    let sd = if told.by_chart { CHART_SD } else { GIVEN_SD };
    let known = told.exposure.map(|exposure| Normal { mean: exposure.ln(), sd });
    Some(known.unwrap_or(EXPOSURE_OF_PHOTOGRAPH))
}
