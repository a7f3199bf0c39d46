//! Where to look for the most probable spectrum: under which classes, and from where.
//!
//! Three channels tell most classes apart: all spectra as one Gaussian lead near the spectrum, and the model linearised there says
//! which classes it may be of. Of one channel or two, spectra of every kind make the same (in light of one colour a red sheet may be
//! a blue one), and many channels that are nearly alike mislead: then all classes are tried, each from its own mean.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::data::{FacetData, FittedExposure};
use super::facets::{AboutMaximum, ByLogit, Facets, whitened};
use super::gaussian::Gaussian;
use super::prior::{Class, Prior};
use crate::solve::Eigen;
use crate::solve::posterior::{Model, first_inflation, maximise};

/// So near to the maximum under all spectra, in standard deviations, that what is tried does not depend on the start.
pub const SORTING_TOLERANCE: f64 = 0.01;
/// Maxima from the means of classes are told apart this near to them.
const TOLERANCE_FROM_MEANS: f64 = 0.3;
/// Most iterations of a search that sorts.
pub const ITERATION_LIMIT: usize = 500;
/// Channels, those of every light counted, that tell classes apart.
const TELLING_CHANNELS: usize = 3;
/// Most classes and scales that are tried, and the least evidence for the second, as the logarithm of its share of the first's.
const TRIED: usize = 3;
const LN_EVIDENCE_LEAST: f64 = -2.0;
/// Directions of logits that facets must tell more of than is known of all spectra, for so few to be enough; otherwise more are tried.
const TOLD: usize = 3;
const UNTOLD_TRIED: usize = 24;
const UNTOLD_LN_EVIDENCE_LEAST: f64 = -5.0;
/// The least evidence, likewise, for a class and scale that counts without a search.
const MINOR_LN_EVIDENCE_LEAST: f64 = -4.0;

/// How wide a class may be, as a multiple of what its spectra are, and how often: spectra of a kind are not all equally unusual, and
/// with a scale for each of them its tails are heavy.
pub const SCALES: [(f64, f64); 4] = [(0.6, 0.4), (1.1, 0.35), (2.0, 0.2), (3.5, 0.05)];

/// A class that the facets may belong to, and where to set out under it.
pub struct Start {
    /// The class and its width, by their places in their tables.
    pub which: (usize, usize),
    /// Factor by which the noise was inflated where it was found.
    pub inflation: f64,
    /// Logarithm of its share of all spectra.
    pub ln_share: f64,
    /// Its spectra.
    pub gaussian: Gaussian,
    pub w: DVector<f64>,
}

/// A class and scale of too little evidence for a search, at the maximum that the linear model has under it.
pub struct Minor<'a> {
    pub logit: DVector<f64>,
    pub unknowns: DVector<f64>,
    class: &'a LinearClass<'a>,
    scale: f64,
    exposure: &'a FittedExposure,
    /// Logarithm of its evidence and share, without the misfit of the facets.
    pub ln_evidence_of_fit: f64,
}

impl Minor<'_> {
    /// As [`AboutMaximum::spread`].
    pub fn spread(&self, by_unknown: &[f64], widened: f64) -> Option<DMatrix<f64>> {
        let gaussian = self.class.class.gaussian.scaled(self.scale);
        let mut jacobian = self.class.jacobian.clone();
        jacobian.columns_mut(0, gaussian.basis().ncols()).scale_mut(self.scale);
        let about = AboutMaximum {
            gaussian: &gaussian,
            logit: &self.logit,
            jacobian: &jacobian,
            exposure: self.exposure,
        };
        about.spread(by_unknown, widened)
    }
}

/// Classes and scales by their evidence, the model taken to be linear about a point.
pub struct Likely<'a> {
    classes: Vec<LinearClass<'a>>,
    /// Logarithm of evidence, place of class and scale; most first.
    found: Vec<(f64, (usize, usize))>,
    inflation: f64,
    telling: bool,
    exposure: FittedExposure,
}

impl<'a> Likely<'a> {
    /// `sorted` is the maximum under `all` spectra as one Gaussian with the noise `inflation` times its size. None if so few channels do
    /// not tell classes apart.
    pub fn new(all: &Facets, sorted: &DVector<f64>, prior: &'a Prior, inflation: f64) -> Option<Self> {
        if !tell_classes(all.data) {
            return None;
        }
        let about = all.by_logit(sorted);
        let classes: Vec<_> =
            prior.classes().iter().map(|class| LinearClass::new(class, &about, inflation)).collect();
        let found = classes.iter().enumerate().flat_map(|(class, linear)| {
            (0..SCALES.len()).filter_map(move |scale| {
                let ln_evidence = linear.ln_evidence(SCALES[scale])?;
                ln_evidence.is_finite().then_some((ln_evidence, (class, scale)))
            })
        });
        let found = by_evidence(found);
        let telling = is_telling(all, &about, inflation);
        Some(Self { telling, found, classes, inflation, exposure: about.second.exposure })
    }

    /// Where to look under those of most evidence.
    pub fn starts(&self) -> Vec<Start> {
        let most = of_most_evidence(&self.found, self.telling);
        most.iter().filter_map(|(_, which)| self.classes[which.0].start(*which, self.inflation)).collect()
    }

    /// Those of less evidence than `starts`, unless they do not count beside them.
    pub fn minor(&self, starts: &[Start]) -> Vec<Minor<'_>> {
        let least = self.found.first().map_or(0.0, |(most, _)| most + MINOR_LN_EVIDENCE_LEAST);
        let counts = |(ln_evidence, which): &&(f64, (usize, usize))| {
            *ln_evidence >= least && starts.iter().all(|start| start.which != *which)
        };
        let minor = self.found.iter().filter(counts);
        minor.filter_map(|(_, which)| self.classes[which.0].minor(SCALES[which.1], &self.exposure)).collect()
    }
}

/// The classes of most evidence at the maximum that each class's mean leads to, the noise `inflation` times its size; all of them if so
/// few channels do not tell classes apart.
pub fn from_means(data: &FacetData, prior: &Prior, inflation: f64) -> Vec<Start> {
    let from_mean = |(n, class): (usize, &Class)| {
        let facets = Facets { data, gaussian: &class.gaussian };
        let mean = DVector::zeros(facets.unknowns());
        let first = first_inflation(&facets, &mean, inflation);
        let found = maximise(&facets, mean, (first, inflation), TOLERANCE_FROM_MEANS, ITERATION_LIMIT);
        let ln_evidence = class.ln_share + found.ln_evidence(inflation)?;
        let (ln_share, gaussian) = (class.ln_share, class.gaussian.clone());
        let start = Start { which: (n, SCALES.len()), inflation, ln_share, gaussian, w: found.w };
        ln_evidence.is_finite().then_some((ln_evidence, start))
    };
    let found = prior.classes().iter().enumerate().filter_map(from_mean);
    let mut found = by_evidence(found);
    if tell_classes(data) {
        found.truncate(of_most_evidence(&found, true).len());
    }
    found.into_iter().map(|(_, start)| start).collect()
}

fn tell_classes(data: &FacetData) -> bool {
    data.channels() >= TELLING_CHANNELS
}

/// Whether facets tell so much of a spectrum that classes of less evidence may be left out.
fn is_telling(all: &Facets, about: &ByLogit, inflation: f64) -> bool {
    if about.residuals.len() < TOLD || about.jacobian.iter().any(|slope| !slope.is_finite()) {
        return false;
    }
    let jacobian = whitened(&about.jacobian, all.gaussian) / inflation;
    let of_spectrum = jacobian.columns(0, all.gaussian.basis().ncols());
    let information = Eigen::of_symmetric(of_spectrum * of_spectrum.transpose()).values;
    information.iter().filter(|value| **value > 1.0).count() >= TOLD
}

fn by_evidence<T>(found: impl Iterator<Item = (f64, T)>) -> Vec<(f64, T)> {
    let mut found: Vec<_> = found.collect();
    found.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    found
}

/// Those of most evidence, of which the first has most; more of them if facets are not `telling`.
fn of_most_evidence<T>(found: &[(f64, T)], telling: bool) -> &[(f64, T)] {
    let (most, ln_least) =
        if telling { (TRIED, LN_EVIDENCE_LEAST) } else { (UNTOLD_TRIED, UNTOLD_LN_EVIDENCE_LEAST) };
    let least = found.first().map_or(0.0, |(best, _)| best + ln_least);
    let enough = found.partition_point(|(ln_evidence, _)| *ln_evidence >= least);
    &found[..enough.min(most)]
}

/// A linear model of the facets under a class, in units of the inflated noise.
struct LinearClass<'a> {
    class: &'a Class,
    /// Residual by whitened logit, then by unknown of the scene.
    jacobian: DMatrix<f64>,
    residuals: DVector<f64>,
    /// Covariance of the facets by the class, and by noise and unknowns.
    by_class: DMatrix<f64>,
    by_others: DMatrix<f64>,
}

impl<'a> LinearClass<'a> {
    fn new(class: &'a Class, about: &ByLogit, inflation: f64) -> Self {
        let (bands, unknowns) = (about.logit.len(), about.unknowns.len());
        let residuals = &about.residuals
            + about.jacobian.columns(0, bands) * (&about.logit - class.gaussian.mean())
            + about.jacobian.columns(bands, unknowns) * &about.unknowns;
        let jacobian = whitened(&about.jacobian, &class.gaussian) / inflation;
        let coordinates = class.gaussian.basis().ncols();
        let of_class = jacobian.columns(0, coordinates);
        let of_others = jacobian.columns(coordinates, unknowns);
        let by_class = of_class * of_class.transpose();
        let mut by_others = of_others * of_others.transpose();
        (0..by_others.nrows()).for_each(|i| by_others[(i, i)] += 1.0);
        Self { class, residuals: residuals / inflation, by_class, by_others, jacobian }
    }

    fn covariance(&self, scale: f64) -> Option<Cholesky<f64, Dyn>> {
        Cholesky::new(scale * scale * &self.by_class + &self.by_others)
    }

    /// The evidence for the class at a scale and its share; none if the numbers are not finite.
    fn ln_evidence(&self, (scale, share): (f64, f64)) -> Option<f64> {
        let factor = self.covariance(scale)?;
        let cost = factor.l_dirty().solve_lower_triangular(&self.residuals)?.norm_squared();
        Some(self.class.ln_share + share.ln() - 0.5 * (cost + factor.ln_determinant()))
    }

    /// Where to look under the class at its scale: at the mean of the linear posterior.
    fn start(&self, which: (usize, usize), inflation: f64) -> Option<Start> {
        let (scale, share) = SCALES[which.1];
        let (w, _) = self.posterior(scale)?;
        let gaussian = self.class.gaussian.scaled(scale);
        Some(Start { which, inflation, ln_share: self.class.ln_share + share.ln(), gaussian, w })
    }

    /// The mean of the linear posterior, as a point.
    fn minor<'b>(&'b self, (scale, share): (f64, f64), exposure: &'b FittedExposure) -> Option<Minor<'b>> {
        let (w, ln_determinant) = self.posterior(scale)?;
        let coordinates = self.class.gaussian.basis().ncols();
        Some(Minor {
            class: self,
            scale,
            exposure,
            logit: self.class.gaussian.logit_at(&(scale * w.rows(0, coordinates))),
            unknowns: w.rows(coordinates, w.len() - coordinates).into_owned(),
            ln_evidence_of_fit: self.class.ln_share + share.ln() - 0.5 * (w.norm_squared() + ln_determinant),
        })
    }

    /// The mean of the linear posterior under the class at a scale, and the logarithm of the determinant of the facets' covariance.
    fn posterior(&self, scale: f64) -> Option<(DVector<f64>, f64)> {
        let factor = self.covariance(scale)?;
        let mut w = self.jacobian.tr_mul(&factor.solve(&self.residuals));
        w.rows_mut(0, self.class.gaussian.basis().ncols()).scale_mut(scale);
        Some((w, factor.ln_determinant()))
    }
}
