//! Facets of an ideal fold in an unknown light, one of several candidates.

use std::collections::BTreeSet;
use std::iter;

use nalgebra::DVector;

use super::{Candidate, InferredLight};
use crate::error::{Error, Result};
use crate::estimate::Estimate;
use crate::estimate::alternatives::Alternatives;
use crate::estimate::data::FacetData;
use crate::estimate::doubt::EXPLAINED;
use crate::estimate::emission::Emission;
use crate::estimate::facets::{Facets, Second};
use crate::estimate::family::Family;
use crate::estimate::fluorescence_search::{self, PRECISE, explains, possible};
use crate::estimate::prior::Prior;
use crate::estimate::search::{Search, Sorted};
use crate::estimate::searched::{Searched, Trace};

/// Lights whose log evidence under all spectra is this far below the best are dropped: knowing the class of
/// spectra rarely changes as much.
const LN_EVIDENCE_HOPELESS: f64 = -6.0;
/// The same before the lights next to one have been tried: one of those may have far more evidence.
const LN_EVIDENCE_BETWEEN: f64 = -20.0;
/// Maximum number of lights under which classes of spectra are distinguished.
const DISTINCT_ODDS: usize = 48;
/// A band of emission is searched if it is possible in one of this many lights, the most probable ones.
const TESTED: usize = 3;

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
    let start = start.map(|start| Facets { data, gaussian: prior.broad() }.set_out_from(start));
    let tempering = Search::new(data, prior).tempering();
    let unlit = Unlit { data, lights, prior, tempering };
    let may_emit = tempering <= PRECISE;
    let mut trace = Trace::new();
    let mut found = unlit.searched(start.clone(), may_emit, &mut trace).ok_or_else(not_finite)?;
    if !may_emit && found.0.mixture.best.rms > tempering.max(EXPLAINED) {
        found = unlit.searched(start, true, &mut trace).ok_or_else(not_finite)?;
    }
    let (found, lights_of) = found;
    let mut probabilities = vec![0.0; lights.len()];
    let shares = found.mixture.shares.iter();
    shares.for_each(|(alternative, share)| probabilities[lights_of[*alternative]] += share);
    let light = iter::zip(lights, probabilities)
        .map(|(light, probability)| (light.weighed(probability), light.power.as_slice()));
    let light = Some(InferredLight::of(light));
    Ok(Estimate { light, ..found.estimate(data, &found.mixture, trace) })
}

/// Facets in one of several lights.
struct Unlit<'r, 'a> {
    data: &'r FacetData<'a>,
    lights: &'r [Candidate],
    prior: &'r Prior,
    /// Factor by which the noise is tempered while lights are sorted.
    tempering: f64,
}

/// Facets in a light, for a sheet with or without emission, and their mode under all spectra.
struct Lit<'a> {
    /// Index of the light.
    light: usize,
    data: FacetData<'a>,
    sorted: Sorted<usize, Second>,
}

impl<'a> Unlit<'_, 'a> {
    /// The mean of all modes, and the light of each alternative; `None` if the facets are not finite.
    fn searched(
        &self,
        start: Option<DVector<f64>>,
        may_emit: bool,
        trace: &mut Trace,
    ) -> Option<(Searched<'a>, Vec<usize>)> {
        let in_light = Alternatives::of(self.lights.iter().map(|light| move || light.on(self.data)));
        let every: Vec<usize> = (0..self.lights.len()).collect();
        let mut all = self.in_each(&in_light, &every, (start, f64::NEG_INFINITY), trace);
        if may_emit {
            self.add_emitting(&mut all, trace);
        }
        let lights_of = all.iter().map(|one| one.light).collect();
        let alternatives: Vec<_> = all.into_iter().map(|Lit { data, sorted, .. }| (data, sorted)).collect();
        if alternatives.is_empty() {
            return None;
        }
        let (found, more) = Searched::among(alternatives, self.prior)?;
        trace.extend(more);
        Some((found, lights_of))
    }

    /// Adds the same for sheets with each band of emission that the most probable lights leave possible.
    fn add_emitting(&self, all: &mut Vec<Lit<'a>>, trace: &mut Trace) {
        let scene = self.data.scene();
        let in_light = |emission: &Emission, light: usize| emission.in_light(&self.lights[light].power);
        // the most probable one, and others unlike it
        let is_tested = |(n, one): &(usize, &Lit)| *n == 0 || !self.lights[one.light].is_between;
        let tested = all.iter().enumerate().filter(is_tested).take(TESTED);
        let possible: BTreeSet<usize> = tested
            .flat_map(|(_, Lit { light, data, sorted })| {
                let emissions: Vec<_> = scene.emissions().iter().map(|one| in_light(one, *light)).collect();
                possible(data, &emissions, sorted, self.prior)
            })
            .collect();
        let [nothing, ..] = scene.emissions() else { return };
        if possible.is_empty() {
            return;
        }
        let emitting = |data: FacetData<'a>, emission: &Emission| data.emitting(emission).unwrap_or(data);
        for Lit { light, data, .. } in all.iter_mut() {
            *data = emitting(data.clone(), &in_light(nothing, *light));
        }
        for emission in possible.into_iter().map(|band| &scene.emissions()[band]) {
            let lit = |light: usize| emitting(self.lights[light].on(self.data), &in_light(emission, light));
            let lit = Alternatives::of((0..self.lights.len()).map(|light| move || lit(light)));
            let is_excited = |light: &usize| in_light(emission, *light).is_excited();
            let lights: Vec<usize> = (0..self.lights.len()).filter(is_excited).collect();
            let mut lit = self.in_each(&lit, &lights, (None, most(all)), trace);
            lit.retain(|one| explains(&one.data, &one.sorted, self.tempering));
            all.append(&mut lit);
        }
        // sheets without emission remain: a band is less probable by itself
        let least = most(all) + fluorescence_search::LN_EVIDENCE_HOPELESS;
        let is_plain = |one: &Lit| one.data.emission().is_none_or(|emission| emission.origin().is_none());
        all.retain(|one| is_plain(one) || one.sorted.ln_weight() >= least);
    }

    /// Facets in each of these lights, in order of evidence under all spectra, each started from the result
    /// of its neighbour, without lights that are hopeless beside one of log evidence `best`.
    fn in_each(
        &self,
        family: &Alternatives<'_, 'a>,
        lights: &[usize],
        (start, best): (Option<DVector<f64>>, f64),
        trace: &mut Trace,
    ) -> Vec<Lit<'a>> {
        let found = self.lights.iter().map(|_| None).collect();
        let mut all =
            Series { lights: self.lights, search: Search::new(family, self.prior), found, start, best };
        let apart: Vec<usize> = lights.iter().copied().filter(|n| !self.lights[*n].is_between).collect();
        apart.iter().for_each(|n| all.sort(*n, LN_EVIDENCE_BETWEEN));
        let ln: Vec<f64> = apart.iter().map(|n| all.ln_weight(*n)).collect();
        for (n, ends) in apart.windows(2).enumerate() {
            let &[first, next] = ends else { continue };
            let mut between = first + 1..next;
            let are_alike = !between.is_empty() && between.all(|n| self.lights[n].is_between);
            if are_alike && are_distinguished(&ln, n, all.best) {
                all.refine(first, next);
            }
        }
        let Series { search, found, .. } = all;
        trace.extend(search.trace);
        let mut found: Vec<_> = found.into_iter().flatten().collect();
        found.sort_by(Sorted::order);
        let most = found.first().map_or(best, |first| first.ln_weight().max(best));
        found.retain(|one| one.ln_weight() >= most + LN_EVIDENCE_HOPELESS);
        found.truncate(DISTINCT_ODDS);
        let of = |sorted: Sorted<usize, Second>| {
            let light = sorted.hypothesis;
            Lit { light, data: family.get(light).clone(), sorted }
        };
        found.into_iter().map(of).collect()
    }
}

/// The most evidence of all.
fn most(all: &[Lit]) -> f64 {
    all.iter().map(|one| one.sorted.ln_weight()).fold(f64::NEG_INFINITY, f64::max)
}

/// Lights in a row, and their modes as far as they were searched.
struct Series<'r, F: Family<Hypothesis = usize>> {
    lights: &'r [Candidate],
    search: Search<'r, F>,
    found: Vec<Option<Sorted<usize, F::Second>>>,
    /// Where the next search starts.
    start: Option<DVector<f64>>,
    /// The most evidence so far.
    best: f64,
}

impl<F: Family<Hypothesis = usize>> Series<'_, F> {
    fn ln_weight(&self, light: usize) -> f64 {
        self.found[light].as_ref().map_or(f64::NEG_INFINITY, Sorted::ln_weight)
    }

    /// Searches a light, unless its evidence is this far below the best.
    fn sort(&mut self, light: usize, ln_hopeless: f64) {
        let share = (light, self.lights[light].ln_share);
        if let Some(one) = self.search.sort(share, self.start.clone(), self.best + ln_hopeless) {
            self.best = self.best.max(one.ln_weight());
            self.start = Some(one.solution.w.clone());
            self.found[light] = Some(one);
        }
    }

    /// Searches the lights between two, from the more probable one on; the first shares its probability with
    /// them.
    fn refine(&mut self, first: usize, next: usize) {
        let is_up = self.ln_weight(first) >= self.ln_weight(next);
        let nearest = if is_up { first } else { next };
        self.start = self.found[nearest].as_ref().map(|one| one.solution.w.clone());
        let ln_sharing = ((next - first) as f64).ln();
        if let Some(one) = &mut self.found[first] {
            one.ln_share -= ln_sharing;
        }
        for n in 1..next - first {
            self.sort(if is_up { first + n } else { next - n }, LN_EVIDENCE_HOPELESS - ln_sharing);
        }
    }
}

/// True if lights between the one at `n` and the next may be among the most probable, and differ from both:
/// log evidence `ln` bends by more than one per step, as it does where its width is less than a step.
fn are_distinguished(ln: &[f64], n: usize, best: f64) -> bool {
    let at = |n: usize| ln.get(n).copied().unwrap_or(f64::NEG_INFINITY);
    let before = |n: usize| n.checked_sub(1).map_or(f64::NEG_INFINITY, at);
    let is_peak = |n: usize| at(n) >= before(n) && at(n) >= at(n + 1);
    let bend = |n: usize| 2.0 * at(n) - before(n) - at(n + 1);
    let most = at(n).max(at(n + 1));
    let is_bent = [n, n + 1].into_iter().any(|n| at(n).is_finite() && bend(n) > 1.0);
    let is_near = most >= best + LN_EVIDENCE_HOPELESS;
    is_bent && (is_near || (most >= best + LN_EVIDENCE_BETWEEN && (is_peak(n) || is_peak(n + 1))))
}
