//! Where to look for the most probable spectrum: under which classes, and from where.
//!
//! Three channels tell most classes apart: all spectra as one Gaussian lead near the spectrum, and the model linearised there says
//! which classes it may be of. Of one channel or two, spectra of every kind make the same (in light of one colour a red sheet may be
//! a blue one), and many channels that are nearly alike mislead: then all classes are tried, each from its own mean.

use nalgebra::{Cholesky, DVector};

use super::data::FacetData;
use super::facets::{ByLogit, Facets, whitened};
use super::prior::{Class, Prior};
use crate::solve::posterior::{Model, first_inflation, maximise};

/// Maxima are told apart this near to them, in standard deviations.
pub const SORTING_TOLERANCE: f64 = 0.3;
/// Most iterations of a search.
pub const ITERATION_LIMIT: usize = 500;
/// Channels, those of every light counted, that tell classes apart.
const TELLING_CHANNELS: usize = 3;
/// Most classes that are tried, and the least evidence for the second, as the logarithm of its share of the first's.
const CLASSES_TRIED: usize = 3;
const LN_EVIDENCE_LEAST: f64 = -4.0;

/// A class that the facets may belong to, and where to set out under it.
pub struct Start<'a> {
    pub class: &'a Class,
    pub w: DVector<f64>,
}

/// The classes of most evidence, the model taken to be linear about `sorted`, the maximum under `all` spectra as one Gaussian with the
/// noise `inflation` times its size; none if so few channels do not tell classes apart.
pub fn likely<'a>(all: &Facets, sorted: &DVector<f64>, prior: &'a Prior, inflation: f64) -> Vec<Start<'a>> {
    if !tell_classes(all.data) {
        return Vec::new();
    }
    let about = all.by_logit(sorted);
    of_most_evidence(prior.classes().iter().filter_map(|class| linear(class, &about, inflation)))
}

/// The classes of most evidence at the maximum that each class's mean leads to, the noise `inflation` times its size; all of them if so
/// few channels do not tell classes apart.
pub fn from_means<'a>(data: &FacetData, prior: &'a Prior, inflation: f64) -> Vec<Start<'a>> {
    let from_mean = |class: &'a Class| {
        let facets = Facets { data, gaussian: &class.gaussian };
        let mean = DVector::zeros(facets.unknowns());
        let first = first_inflation(&facets, &mean, inflation);
        let found = maximise(&facets, mean, (first, inflation), SORTING_TOLERANCE, ITERATION_LIMIT);
        let ln_evidence = class.ln_share + found.ln_evidence(inflation)?;
        ln_evidence.is_finite().then_some((ln_evidence, Start { class, w: found.w }))
    };
    let found = prior.classes().iter().filter_map(from_mean);
    if tell_classes(data) { of_most_evidence(found) } else { found.map(|(_, start)| start).collect() }
}

fn tell_classes(data: &FacetData) -> bool {
    data.channels() >= TELLING_CHANNELS
}

/// Those of most evidence, most first.
fn of_most_evidence<'a>(found: impl Iterator<Item = (f64, Start<'a>)>) -> Vec<Start<'a>> {
    let mut found: Vec<_> = found.collect();
    found.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    found.truncate(CLASSES_TRIED);
    let least = found.first().map_or(0.0, |(best, _)| best + LN_EVIDENCE_LEAST);
    found.into_iter().filter(|(evidence, _)| *evidence >= least).map(|(_, start)| start).collect()
}

/// The evidence for a class, and the mean of the linear posterior under it; none if the numbers are not finite.
fn linear<'a>(class: &'a Class, about: &ByLogit, inflation: f64) -> Option<(f64, Start<'a>)> {
    let weight = inflation.powi(-2);
    let gaussian = &class.gaussian;
    let jacobian = whitened(&about.jacobian, gaussian);
    let (bands, unknowns) = (about.logit.len(), about.unknowns.len());
    let residuals = &about.residuals
        + about.jacobian.columns(0, bands) * (&about.logit - gaussian.mean())
        + about.jacobian.columns(bands, unknowns) * &about.unknowns;
    let mut information = weight * (jacobian.transpose() * &jacobian);
    (0..information.nrows()).for_each(|i| information[(i, i)] += 1.0);
    let factor = Cholesky::new(information)?;
    let w = factor.solve(&(weight * jacobian.tr_mul(&residuals)));
    let cost = weight * (residuals - jacobian * &w).norm_squared() + w.norm_squared();
    let ln_evidence = class.ln_share - 0.5 * (cost + factor.ln_determinant());
    Some((ln_evidence, Start { class, w }))
}
