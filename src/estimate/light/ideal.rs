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
use crate::estimate::facets::{Facets, Second};
use crate::estimate::family::Family;
use crate::estimate::fluorescence_search::{PRECISE, possible};
use crate::estimate::prior::Prior;
use crate::estimate::search::{Search, Sorted};
use crate::estimate::searched::{Searched, Trace};

/// Lights whose log evidence under all spectra is this far below the best are dropped: knowing the class of
/// spectra rarely changes as much.
const LN_EVIDENCE_HOPELESS: f64 = -6.0;
/// The same until lights between them are tried, one of which may have much more evidence.
const LN_EVIDENCE_BETWEEN: f64 = -20.0;
/// Maximum number of lights under which classes of spectra are distinguished.
const DISTINCT_ODDS: usize = 48;
/// Bands of emission are possible if they are in one of this many lights, the most probable ones.
const TESTED: usize = 3;

/// A candidate light, the facets in it for a sheet with or without emission, and their mode under all
/// spectra.
struct Lit<'a> {
    light: usize,
    data: FacetData<'a>,
    sorted: Sorted<usize, Second>,
}

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
    let start = start.map(|start| Facets { data, gaussian: prior.broad() }.set_out_from(start));
    let not_finite = || Error::Numeric("the facets are not finite".to_owned());
    let (lit, trace) = all(data, lights, prior, start);
    if lit.is_empty() {
        return Err(not_finite());
    }
    let lights_of: Vec<usize> = lit.iter().map(|one| one.light).collect();
    let alternatives = lit.into_iter().map(|Lit { data, sorted, .. }| (data, sorted)).collect();
    let (found, more) = Searched::among(alternatives, prior).ok_or_else(not_finite)?;
    let mut probabilities = vec![0.0; lights.len()];
    let shares = found.mixture.shares.iter();
    shares.for_each(|(alternative, share)| probabilities[lights_of[*alternative]] += share);
    let light = iter::zip(lights, probabilities)
        .map(|(light, probability)| (light.weighed(probability), light.power.as_slice()));
    let light = Some(InferredLight::of(light));
    Ok(Estimate { light, ..found.estimate(found.best(), &found.mixture, [trace, more].concat()) })
}

/// All alternatives that remain possible, those without emission first, and the iterations.
fn all<'a>(
    data: &FacetData<'a>,
    lights: &[Candidate],
    prior: &Prior,
    start: Option<DVector<f64>>,
) -> (Vec<Lit<'a>>, Trace) {
    let mut trace = Trace::new();
    let plain = Alternatives::of(lights.iter().map(|light| move || light.on(data)));
    let mut all = in_each(lights, &plain, (prior, start, f64::NEG_INFINITY), &mut trace);
    let best = |all: &[Lit]| all.iter().map(|one| one.sorted.ln_weight()).fold(f64::NEG_INFINITY, f64::max);
    let bands = bands(data, lights, &all, prior);
    // the bands are known to be possible, and so is their absence
    let emitting = |light: &Candidate, band: usize| {
        let lit = light.on(data);
        let emission = data.scene().emissions()[band].in_light(&light.power);
        lit.emitting(&emission).unwrap_or(lit)
    };
    if !bands.is_empty() {
        all.iter_mut().for_each(|one| one.data = emitting(&lights[one.light], 0));
    }
    let exciting = exciting(lights);
    for band in bands {
        let emitting = Alternatives::of(exciting.iter().map(|light| move || emitting(light, band)));
        let lit = in_each(exciting, &emitting, (prior, None, best(&all)), &mut trace);
        let explained = |one: &Lit| {
            let tempering = Search::new(&one.data, prior).tempering();
            one.data.rms(&one.sorted.solution.at.residuals) < EXPLAINED * tempering
        };
        all.extend(lit.into_iter().filter(explained));
    }
    let least = best(&all) + LN_EVIDENCE_HOPELESS;
    all.retain(|one| one.sorted.ln_weight() >= least);
    (all, trace)
}

/// Lights that may excite a sheet: daylight, which is listed first, as lamps have little of what excites; any
/// light if there is none.
fn exciting(lights: &[Candidate]) -> &[Candidate] {
    match lights.iter().take_while(|light| light.is_any_daylight).count() {
        0 => lights,
        days => &lights[..days],
    }
}

/// Facets in each light, in order of evidence under all spectra, each started from the result of its
/// neighbour, without lights that are hopeless beside one of log evidence `best`.
fn in_each<'a>(
    lights: &[Candidate],
    family: &Alternatives<'_, 'a>,
    (prior, start, best): (&Prior, Option<DVector<f64>>, f64),
    trace: &mut Trace,
) -> Vec<Lit<'a>> {
    let found = lights.iter().map(|_| None).collect();
    let mut all = Series { lights, search: Search::new(family, prior), found, start, best };
    let apart: Vec<usize> = (0..lights.len()).filter(|n| !lights[*n].is_between).collect();
    apart.iter().for_each(|n| all.sort(*n, LN_EVIDENCE_BETWEEN));
    let ln: Vec<f64> = apart.iter().map(|n| all.ln_weight(*n)).collect();
    for (n, between) in apart.windows(2).enumerate() {
        let &[first, next] = between else { continue };
        if next > first + 1 && is_told_apart(&ln, n, all.best) {
            all.refine(first, next);
        }
    }
    let Series { search, found, best, .. } = all;
    trace.extend(search.trace);
    let mut found: Vec<_> = found.into_iter().flatten().collect();
    found.retain(|one| one.ln_weight() >= best + LN_EVIDENCE_HOPELESS);
    found.sort_by(|a, b| b.ln_weight().total_cmp(&a.ln_weight()));
    found.truncate(DISTINCT_ODDS);
    let of = |sorted: Sorted<usize, Second>| {
        let light = sorted.hypothesis;
        Lit { light, data: family.get(light).clone(), sorted }
    };
    found.into_iter().map(of).collect()
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

    /// Searches the lights between two, the first of which shares its probability with them.
    fn refine(&mut self, first: usize, next: usize) {
        if let Some(one) = &mut self.found[first] {
            one.ln_share -= ((next - first) as f64).ln();
        }
        let nearest = if self.ln_weight(first) > self.ln_weight(next) { first } else { next };
        self.start = self.found[nearest].as_ref().map(|one| one.solution.w.clone());
        (first + 1..next).for_each(|light| self.sort(light, LN_EVIDENCE_HOPELESS));
    }
}

/// True if lights between the one at `n` and the next may be among the most probable, and differ from both:
/// log evidence `ln` bends by more than one per step, as it does where its width is less than a step.
fn is_told_apart(ln: &[f64], n: usize, best: f64) -> bool {
    let at = |n: usize| ln.get(n).copied().unwrap_or(f64::NEG_INFINITY);
    let before = |n: usize| n.checked_sub(1).map_or(f64::NEG_INFINITY, at);
    let is_peak = |n: usize| at(n) >= before(n) && at(n) >= at(n + 1);
    let bend = |n: usize| 2.0 * at(n) - before(n) - at(n + 1);
    let top = at(n).max(at(n + 1));
    let is_bent = [n, n + 1].into_iter().any(|n| at(n).is_finite() && bend(n) > 1.0);
    let is_near = top >= best + LN_EVIDENCE_HOPELESS;
    is_bent && (is_near || (top >= best + LN_EVIDENCE_BETWEEN && (is_peak(n) || is_peak(n + 1))))
}

/// Indices of the bands of emission that the facets may show.
fn bands(data: &FacetData, lights: &[Candidate], plain: &[Lit], prior: &Prior) -> BTreeSet<usize> {
    // as in a stated light, precise facets are explained by a sheet without emission
    if Search::new(data, prior).tempering() > PRECISE {
        return BTreeSet::new();
    }
    let of = |Lit { light, data: lit, sorted }: &Lit| {
        let power = &lights[*light].power;
        let emissions: Vec<_> =
            data.scene().emissions().iter().map(|emission| emission.in_light(power)).collect();
        possible(lit, &emissions, sorted, prior).0
    };
    plain.iter().take(TESTED).flat_map(of).collect()
}
