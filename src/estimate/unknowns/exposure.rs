//! Brightness of the picture.

use super::{Expectation, Fitted, Flag, Known, Normal, Role, Scale, Symptom, Unknown, Whose};
use crate::estimate::photograph::StatedScene;

/// Value of a perfect white diffuser facing the sun, in its strongest channel.
pub static EXPOSURE: Unknown = Unknown {
    name: "exposure",
    description: "Exposure: value of a perfect white diffuser that faces the sun, in its strongest channel",
    unit: None,
    flag: &Flag { value: "exposure", help: "Value of white facing the sun, as --exposure free" },
    scale: Scale::Logarithm,
    role: Role::Exposure,
    whose: Whose::Lens,
    known: |stated| match stated.exposure {
        Some(_) if stated.by_chart => Known::Shown,
        Some(_) => Known::Stated,
        None if stated.by_paper.or(stated.metered_exposure()).is_some() => Known::Metered,
        None => Known::Usual,
    },
    prior: of_photograph,
    set: |conditions, value| conditions.exposure = value,
    symptom: Some(Symptom {
        ideal: |stated| stated.exposure.filter(|_| !stated.by_chart),
        least: 0.05,
        words: |Fitted { value, sd, .. }, stated| {
            let stated = stated.exposure.unwrap_or(1.0);
            format!("the facets show an exposure of {value:.3} ± {sd:.3}, not {stated} as stated")
        },
        remedy: "leave --exposure out, \
                 or measure it again with a white card or chart in the sheet's light",
    }),
};

fn of_photograph(stated: &StatedScene) -> Option<Expectation> {
    let priors = stated.priors;
    let sd = if stated.by_chart { priors.exposure_shown_sd } else { priors.exposure_stated_sd };
    let known = stated.exposure.map(|exposure| Normal { mean: exposure.ln(), sd });
    let usual = priors.exposure();
    let observed = stated.by_paper.or(stated.metered_exposure());
    let assumed = || observed.map_or(usual, |observed| usual.and(observed));
    Some(known.unwrap_or_else(assumed).into())
}
