//! Where to look for the most probable spectrum: under which classes, and from where.
//!
//! Three channels tell most classes apart: all spectra as one Gaussian lead near the spectrum, and the model linearised there says
//! which classes it may be of. Of one channel or two, spectra of every kind make the same (in light of one colour a red sheet may be
//! a blue one), and many channels that are nearly alike mislead: then all classes are tried, each from its own mean.

use nalgebra::{Cholesky, DVector};

use super::data::FacetData;
use super::facets::{ByLogit, Facets, whitened};
use super::prior::{Class, Prior};
use crate::solve::posterior::{Model, first_inflation};

/// Channels, those of every light counted, that tell classes apart.
const TELLING_CHANNELS: usize = 3;
/// Most classes that are tried where they are told apart, and the least evidence for the second, as the logarithm of its share of the
/// first's.
const CLASSES_TRIED: usize = 3;
const LN_EVIDENCE_LEAST: f64 = -4.0;

/// A class that the facets may belong to, where to set out under it, and at what noise in units of the true one.
pub struct Start<'a> {
    pub class: &'a Class,
    pub w: DVector<f64>,
    pub inflation: f64,
}

/// The classes of most evidence, the model taken to be linear about `sorted`, the maximum under `all` spectra as one Gaussian with the
/// noise `inflation` times its size; none if so few channels do not tell classes apart.
pub fn likely<'a>(all: &Facets, sorted: &DVector<f64>, prior: &'a Prior, inflation: f64) -> Vec<Start<'a>> {
    if all.data.channels() < TELLING_CHANNELS {
        return Vec::new();
    }
    let about = all.by_logit(sorted);
    let mut found: Vec<_> =
        prior.classes().iter().filter_map(|class| linear(class, &about, inflation)).collect();
    found.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    found.truncate(CLASSES_TRIED);
    let least = found.first().map_or(0.0, |(best, _)| best + LN_EVIDENCE_LEAST);
    found.into_iter().filter(|(evidence, _)| *evidence >= least).map(|(_, start)| start).collect()
}

/// All classes, each from its mean and at the noise that would explain what it misses there.
pub fn means<'a>(data: &FacetData, prior: &'a Prior, inflation: f64) -> Vec<Start<'a>> {
    let from_mean = |class: &'a Class| {
        let facets = Facets { data, gaussian: &class.gaussian };
        let w = DVector::zeros(facets.unknowns());
        Start { class, inflation: first_inflation(&facets, &w, inflation), w }
    };
    prior.classes().iter().map(from_mean).collect()
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
    Some((ln_evidence, Start { class, w, inflation }))
}
