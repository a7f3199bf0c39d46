//! The default for ideal folds: the posterior mean of the spectrum, given the facets and a prior on
//! reflectances, in the stated light or in one of several.
//!
//! `z = logit r` is a priori Gaussian in each class of spectra; the facets are Gaussian about the model.
//! Newton's method finds the mode in whitened z under each candidate class (`search`). The estimate is the
//! mean of the modes, weighted by evidence: over classes, over lights if none was stated, and over emissions
//! of the sheet that the facets leave possible. The curvature gives error bars (Laplace approximation), which
//! widen where modes disagree or facets are further from the model than their noise.

use std::collections::BTreeMap;
use std::iter;

use nalgebra::DVector;

use super::Estimate;
use super::alternatives::Alternatives;
use super::camera_errors::{SURPRISE, seen_by_another};
use super::data::FacetData;
use super::doubt::EXPLAINED;
use super::emission::Emission;
use super::facets::{Facets, Second};
use super::fluorescence_search::{LN_EVIDENCE_HOPELESS, PRECISE, explains, is_unexplained, possible};
use super::light::{Candidate, InferredLight, Others, lights_in_order, rival};
use super::mixture::Mixture;
use super::prior::Prior;
use super::rival::Rival;
use super::search::{Search, Sorted};
use super::searched::{Lit, Searched, Trace};
use super::unknowns::Expected;
use crate::error::{Error, Result};

/// A band of emission is searched if it is possible in one of this many lights, the most probable ones.
const TESTED: usize = 3;

/// The posterior mean reflectance, together with the scene's unknowns. `start` is an initial reflectance in
/// place of the prior's mean; if one mode has more evidence than all others it makes no difference.
///
/// # Source
/// Objective: Deeb et al., eq. (36), with the prior in place of its smoothness term.
///
/// # Errors
/// [`Error::Numeric`] if the facets are not finite.
pub fn estimate(data: &FacetData, prior: &Prior, start: Option<&[f64]>) -> Result<Estimate> {
    Ok(estimate_in((data, &[]), prior, start, None)?.0)
}

/// The same in one of `lights` or, if there are none, in the stated light; and any light among `others` that
/// is more probable than the stated one.
///
/// # Errors
/// As [`estimate`].
pub fn estimate_in(
    (data, lights): (&FacetData, &[Candidate]),
    prior: &Prior,
    start: Option<&[f64]>,
    others: Option<&Others>,
) -> Result<(Estimate, Option<Rival>)> {
    let not_finite = || Error::Numeric("the facets are not finite".to_owned());
    let start = start.map(|start| Facets { data, gaussian: prior.broad() }.set_out_from(start));
    let tempering = Search::new(data, prior).tempering();
    let (sheet, mut trace) = (Sheet { data, lights, prior, tempering }, Trace::new());
    let (found, rival) = sheet.most_probable((start.clone(), others), &mut trace).ok_or_else(not_finite)?;
    // the mode lies on the bounds of unknowns that exceed them; its error bars are those of the unconstrained
    // mode, to both sides
    let (mut known, mut on_bounds) = (data.clone(), None::<Searched>);
    loop {
        let searched = on_bounds.as_ref().unwrap_or(&found);
        let Some((unknown, bound)) = impossible(&known, &searched.mixture) else { break };
        known = known.with_known(unknown, bound);
        let sheet = Sheet { data: &known, ..sheet };
        let (found, _) = sheet.most_probable((start.clone(), None), &mut trace).ok_or_else(not_finite)?;
        on_bounds = Some(found);
    }
    let searched = on_bounds.as_ref().unwrap_or(&found);
    let light = (!lights.is_empty()).then(|| inferred(lights, searched));
    Ok((Estimate { light, ..searched.estimate(data, &found.mixture, trace) }, rival))
}

/// Facets of a sheet in the stated light or in one of several.
#[derive(Clone, Copy)]
struct Sheet<'r, 'a> {
    data: &'r FacetData<'a>,
    /// Candidates for the light; empty if it is stated.
    lights: &'r [Candidate],
    prior: &'r Prior,
    /// Factor by which the noise is tempered while lights and emissions are sorted.
    tempering: f64,
}

impl<'a> Sheet<'_, 'a> {
    /// The mean of all modes, unconstrained by the ranges of the unknowns; `None` if the facets are not
    /// finite.
    fn most_probable(
        &self,
        (start, others): (Option<DVector<f64>>, Option<&Others>),
        trace: &mut Trace,
    ) -> Option<(Searched<'a>, Option<Rival>)> {
        // precise facets are either explained by a sheet without emission or not: emission is considered only
        // in the latter case
        let may_emit = self.tempering <= PRECISE;
        let all = self.sorted((start, may_emit), trace);
        let rival = others.and_then(|others| rival(self.data, all.split_first()?, others, self.prior));
        let emits = all.iter().any(Lit::emits);
        let Sorted { solution, ln_evidence, .. } = &all.first()?.sorted;
        let (surprise, plain) = (solution.surprise(self.tempering), (solution.w.clone(), *ln_evidence));
        let found = Searched::among(all, self.prior, trace)?;
        let found = self.explained(found, (may_emit, emits), trace)?;
        let best = &found.mixture.best;
        let is_usual = surprise.max(best.surprise) < SURPRISE;
        // more precise facets are computed: some spectrum, however improbable, explains those of the camera
        let precise = Search::new(self.data, self.prior).fine_tempering();
        let is_explained = precise > 1.0 && best.rms < precise;
        if is_usual || is_explained || self.lights.len() > 1 {
            return Some((found, rival));
        }
        let other = seen_by_another(found.plain(), plain, self.prior, trace);
        Some((found.or_seen_by_another(other), rival))
    }

    /// What was found, or what is found with emission, or without it, if that explains the facets better.
    fn explained(
        &self,
        found: Searched<'a>,
        (may_emit, emits): (bool, bool),
        trace: &mut Trace,
    ) -> Option<Searched<'a>> {
        let rms = found.mixture.best.rms;
        // precise facets whose residuals reach a noise at which emission is considered may belong to a
        // fluorescent sheet
        let is_open = if may_emit { emits } else { rms > self.tempering };
        if rms < EXPLAINED || !is_open {
            return Some(found);
        }
        // the evidence of sheets that do not explain the facets is meaningless
        let other = Searched::among(self.sorted((None, !may_emit), trace), self.prior, trace)?;
        let is_better = may_emit || other.mixture.best.rms < EXPLAINED;
        Some(if is_better { other } else { found })
    }

    /// The facets in each light that remains possible, under all spectra as one Gaussian: of a sheet without
    /// emission, the most probable light first, then with each possible emission.
    fn sorted(&self, (start, may_emit): (Option<DVector<f64>>, bool), trace: &mut Trace) -> Vec<Lit<'a>> {
        let in_light = |light: usize| match self.lights.get(light) {
            Some(light) => light.on(self.data),
            None => self.data.clone(),
        };
        let every: Vec<usize> = (0..self.lights.len().max(1)).collect();
        let lit = Alternatives::of(every.iter().map(|light| move || in_light(*light)));
        let start = (start, f64::NEG_INFINITY);
        let (mut all, more) = lights_in_order((self.lights, &every), &lit, self.prior, start);
        trace.extend(more);
        let [nothing, ..] = self.data.scene().emissions() else { return all };
        let possible = if may_emit { self.possible(&all) } else { BTreeMap::new() };
        if possible.is_empty() {
            return all;
        }
        let emitting = |data: FacetData<'a>, emission: &Emission, light: usize| {
            data.emitting(&self.in_light(emission, light)).unwrap_or(data)
        };
        // a sheet that is not explained is no start for others
        let first = all.first().filter(|one| !is_unexplained(&one.sorted, self.tempering));
        let plain = first.map(|one| one.sorted.solution.w.clone());
        for Lit { light, data, .. } in &mut all {
            *data = emitting(data.clone(), nothing, *light);
        }
        for (band, size) in possible {
            let emission = &self.data.scene().emissions()[band];
            let excited = every.iter().copied().filter(|n| self.in_light(emission, *n).is_excited());
            let lit = |light: usize| emitting(in_light(light), emission, light);
            let lit = Alternatives::of(every.iter().map(|light| move || lit(*light)));
            let start = plain.as_ref().map(|w| {
                let mut start = w.clone().resize_vertically(w.len() + emission.unknowns(), 0.0);
                start[w.len()] = size;
                start
            });
            let excited: Vec<usize> = excited.collect();
            let start = (start, most(&all));
            // most sheets show no sign of emission: searches for it are no part of the trace
            let (mut lit, _) = lights_in_order((self.lights, &excited), &lit, self.prior, start);
            lit.retain(|one| explains(&one.data, &one.sorted, self.tempering));
            all.append(&mut lit);
        }
        // sheets without emission remain: a band is less probable by itself
        let least = most(&all) + LN_EVIDENCE_HOPELESS;
        all.retain(|one| !one.emits() || one.sorted.ln_weight() >= least);
        all
    }

    /// Indices of the emissions that the most probable lights leave possible, each with its nearest size in
    /// the first of these.
    fn possible(&self, all: &[Lit<'a>]) -> BTreeMap<usize, f64> {
        // the most probable one, and others unlike it
        let is_between = |light: usize| self.lights.get(light).is_some_and(|light| light.is_between);
        let is_tested = |(n, one): &(usize, &Lit)| *n == 0 || !is_between(one.light);
        let of = |(_, Lit { light, data, sorted }): (usize, &Lit<'a>)| {
            let emissions = self.data.scene().emissions().iter().map(|one| self.in_light(one, *light));
            possible(data, &emissions.collect::<Vec<_>>(), sorted, self.prior)
        };
        // of several lights, the first one's counts
        let tested: Vec<_> = all.iter().enumerate().filter(is_tested).take(TESTED).flat_map(of).collect();
        tested.into_iter().rev().collect()
    }

    fn in_light(&self, emission: &Emission, light: usize) -> Emission {
        self.lights.get(light).map_or_else(|| emission.clone(), |light| emission.in_light(&light.power))
    }
}

/// The most evidence of all.
fn most(all: &[Lit]) -> f64 {
    all.iter().map(|one| one.sorted.ln_weight()).fold(f64::NEG_INFINITY, f64::max)
}

/// The lights with their probabilities.
fn inferred(lights: &[Candidate], found: &Searched) -> InferredLight {
    let mut probabilities = vec![0.0; lights.len()];
    let shares = found.mixture.shares.iter();
    shares.for_each(|(alternative, share)| probabilities[found.lights[*alternative]] += share);
    let weighed = |(light, probability): (&Candidate, f64)| light.weighed(probability);
    let powers = lights.iter().map(|light| light.power.as_slice());
    InferredLight::of(iter::zip(iter::zip(lights, probabilities).map(weighed), powers))
}

/// An unknown of the scene outside its range, and the bound that it exceeds.
fn impossible(data: &FacetData, found: &Mixture<usize, Second>) -> Option<(usize, f64)> {
    let scene = data.scene();
    let values = &found.values[scene.facets().bands()..];
    let beyond = |(n, expected): (usize, &Expected)| Some((n, expected.bound_of(values[n])?));
    scene.unknowns().iter().enumerate().find_map(beyond)
}
