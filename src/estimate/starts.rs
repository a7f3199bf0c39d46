//! Where else to look for the most probable spectrum: from the mean of each class.
//!
//! Of one channel or two, spectra of every kind make the same (in light of one colour a red sheet may be a blue one), and many channels that are
//! nearly alike mislead. Precise facets have several maxima, and the one that all spectra as one Gaussian lead to may be false.

use nalgebra::DVector;

use super::data::FacetData;
use super::facets::Facets;
use super::likely::{Start, of_most_evidence, tell_classes};
use super::prior::Prior;
use crate::solve::posterior::{Model, first_inflation, maximise};

/// So near to the maximum under all spectra, in standard deviations, that what is tried does not depend on the start.
pub const SORTING_TOLERANCE: f64 = 0.01;
/// Maxima from the means of classes are told apart this near to them.
const TOLERANCE_FROM_MEANS: f64 = 0.3;
/// Most iterations of a search that sorts.
pub const ITERATION_LIMIT: usize = 500;
/// A quick search sets out from noise so many times that at which it ends, and ends after so many iterations; so many of all classes are
/// followed further.
const QUICK_INFLATION: f64 = 10.0;
const QUICK_LIMIT: usize = 6;
const QUICK_TRIED: usize = 5;

/// The classes of most evidence at the maximum that each class's mean leads to, the noise `inflation` times its size; all of them if so
/// few channels do not tell classes apart.
pub fn from_means(data: &FacetData, prior: &Prior, inflation: f64) -> Vec<Start> {
    let mut found = at_maxima(data, prior, (f64::INFINITY, inflation), ITERATION_LIMIT);
    if tell_classes(data) {
        found.truncate(of_most_evidence(&found, |(ln_evidence, _)| *ln_evidence, true).len());
    }
    found.into_iter().map(|(_, start)| start).collect()
}

/// Those of most evidence where the way to the maximum from each class's mean is not followed to its end.
pub fn quickly_from_means(data: &FacetData, prior: &Prior, inflation: f64) -> Vec<Start> {
    let found = at_maxima(data, prior, (QUICK_INFLATION * inflation, inflation), QUICK_LIMIT);
    found.into_iter().take(QUICK_TRIED).map(|(_, start)| start).collect()
}

/// Classes by their evidence where searches from their means end, the noise `inflation.0` times its size at first, if not less, and
/// `inflation.1` times at last.
fn at_maxima(data: &FacetData, prior: &Prior, inflation: (f64, f64), limit: usize) -> Vec<(f64, Start)> {
    let (most, last) = inflation;
    let of_class = |class: usize| {
        let of_prior = &prior.classes()[class];
        let facets = Facets { data, gaussian: of_prior.gaussian() };
        let mean = DVector::zeros(facets.unknowns());
        let first = first_inflation(&facets, &mean, last).min(most);
        let found = maximise(&facets, mean, (first, last), TOLERANCE_FROM_MEANS, limit);
        let ln_evidence = of_prior.ln_share + found.ln_evidence(last)?;
        let (ln_share, gaussian) = (of_prior.ln_share, of_prior.gaussian().clone());
        let start = Start { class, inflation: last, ln_share, gaussian, wider: 1.0, w: found.w };
        ln_evidence.is_finite().then_some((ln_evidence, start))
    };
    let mut found: Vec<_> = (0..prior.classes().len()).filter_map(of_class).collect();
    found.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    found
}
