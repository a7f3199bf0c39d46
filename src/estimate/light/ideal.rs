//! Facets of an ideal fold in an unknown light, one of several candidates.

use std::iter;

use nalgebra::DVector;

use super::{Candidate, InferredLight};
use crate::error::{Error, Result};
use crate::estimate::Estimate;
use crate::estimate::alternatives::Alternatives;
use crate::estimate::data::FacetData;
use crate::estimate::facets::{Facets, Second};
use crate::estimate::map::into_estimate;
use crate::estimate::prior::Prior;
use crate::estimate::search::{Search, Sorted};

/// Lights whose log evidence under all spectra is this far below the best are dropped: knowing the class of
/// spectra rarely changes as much.
const LN_EVIDENCE_HOPELESS: f64 = -6.0;
/// Maximum number of lights under which classes of spectra are distinguished.
const DISTINCT_ODDS: usize = 48;

/// The posterior mean reflectance, and the light, for facets in one of `lights`; `start` is an initial
/// reflectance.
///
/// # Errors
/// [`Error::Numeric`] if the facets are not finite.
pub fn estimate(
    data: &FacetData,
    lights: &[Candidate],
    prior: &Prior,
    start: Option<&[f64]>,
) -> Result<Estimate> {
    let not_finite = || Error::Numeric("the facets are not finite".to_owned());
    let family = Alternatives(lights.iter().map(|light| light.on(data)).collect());
    let mut search = Search::new(&family, prior);
    let start = start.map(|start| Facets { data, gaussian: prior.broad() }.set_out_from(start));
    let sorted = sorted(&mut search, lights, start);
    let found = search.mixture(&sorted).ok_or_else(not_finite)?;
    let mut probabilities = vec![0.0; lights.len()];
    found.shares.iter().for_each(|(light, share)| probabilities[*light] += share);
    let weighed = |(light, probability): (&'_ Candidate, f64)| light.weighed(probability);
    let light = iter::zip(lights, probabilities).map(|one| (weighed(one), one.0.power.as_slice()));
    let light = InferredLight::of(light);
    let best = &family.0[found.best.start.hypothesis];
    Ok(Estimate { light: Some(light), ..into_estimate(best, &found, &found, search.trace) })
}

/// Lights in order of evidence under all spectra, each started from the result of its neighbour, without
/// hopeless ones.
fn sorted(
    search: &mut Search<Alternatives>,
    lights: &[Candidate],
    start: Option<DVector<f64>>,
) -> Vec<Sorted<usize, Second>> {
    let mut all: Vec<Sorted<usize, Second>> = Vec::new();
    let mut best = f64::NEG_INFINITY;
    let mut start = start;
    for (n, light) in lights.iter().enumerate() {
        if let Some(one) = search.sort((n, light.ln_share), start.clone(), best + LN_EVIDENCE_HOPELESS) {
            best = best.max(one.ln_weight());
            start = Some(one.solution.w.clone());
            all.push(one);
        }
    }
    all.retain(|one| one.ln_weight() >= best + LN_EVIDENCE_HOPELESS);
    all.sort_by(|a, b| b.ln_weight().total_cmp(&a.ln_weight()));
    all.truncate(DISTINCT_ODDS);
    all
}
