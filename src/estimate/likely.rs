//! Classes of spectra by their evidence, and where to look under those of most.
//!
//! Three channels tell most classes apart: all spectra as one Gaussian lead near the spectrum, and the model linearised there says
//! which classes it may be of, and how wide each is: its width is the root mean square of all by their evidence, its evidence that at all.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::data::{FacetData, FittedExposure};
use super::facets::{AboutMaximum, ByLogit, Facets, whitened};
use super::gaussian::Gaussian;
use super::prior::{Class, Prior, ROUGHNESSES};
use crate::solve::Eigen;

/// Channels, those of every light counted, that tell classes apart.
const TELLING_CHANNELS: usize = 3;
/// Most classes that are tried, and the least evidence for the second, as the logarithm of its share of the first's.
const TRIED: usize = 3;
const LN_EVIDENCE_LEAST: f64 = -3.0;
/// Directions of logits that facets must tell more of than is known of all spectra, for so few to be enough; otherwise more are tried.
const TOLD: usize = 3;
const UNTOLD_TRIED: usize = 24;
const UNTOLD_LN_EVIDENCE_LEAST: f64 = -5.0;
/// The least evidence, likewise, for a class that counts without a search.
const MINOR_LN_EVIDENCE_LEAST: f64 = -4.0;

/// How wide a class may be, as a multiple of what its spectra are, and how often: spectra of a kind are not all equally unusual, and
/// with a scale for each of them its tails are heavy.
pub const SCALES: [(f64, f64); 4] = [(0.6, 0.4), (1.1, 0.35), (2.0, 0.2), (3.5, 0.05)];
/// Widths at which every class is weighed; at others, which takes most of the time of it, only those that come so near to the best class, as
/// the logarithm of a share of its evidence.
const FIRST_WIDTHS: [Width; 2] = [Width { scale: 1, roughness: 0 }, Width { scale: 2, roughness: 1 }];
const LN_EVIDENCE_NEAR: f64 = -6.0;

/// A class that the facets may belong to, and where to set out under it.
pub struct Start {
    /// The place of the class in the prior.
    pub class: usize,
    /// Factor by which the noise was inflated where it was found.
    pub inflation: f64,
    /// Logarithm of the evidence for the class and of its share, where it was found.
    pub ln_evidence: f64,
    /// Logarithm of its share of all spectra, as if all of them were as wide as `gaussian`.
    pub ln_share: f64,
    /// Its spectra, as wide as they are likely to be.
    pub gaussian: Gaussian,
    pub w: DVector<f64>,
}

/// A class of too little evidence for a search, at the maximum that the linear model has under it.
pub struct Minor<'a> {
    pub logit: DVector<f64>,
    pub unknowns: DVector<f64>,
    gaussian: Gaussian,
    linear: &'a LinearModel,
    /// Logarithm of its evidence and share, without the misfit of the facets.
    pub ln_evidence_of_fit: f64,
}

impl Minor<'_> {
    /// As [`AboutMaximum::spread`].
    pub fn spread(&self, by_unknown: &[f64], widened: f64) -> Option<DMatrix<f64>> {
        let about = AboutMaximum {
            gaussian: &self.gaussian,
            logit: &self.logit,
            jacobian: &whitened(&self.linear.jacobian, &self.gaussian),
            exposure: &self.linear.exposure,
        };
        about.spread(by_unknown, widened)
    }
}

/// Classes by their evidence, the model taken to be linear about a point.
pub struct Likely<'a> {
    prior: &'a Prior,
    linear: LinearModel,
    /// Most evidence first.
    found: Vec<Weighed>,
    inflation: f64,
    telling: bool,
}

/// A class by its evidence.
struct Weighed {
    class: usize,
    /// How wide it is likely to be, and a place in [`ROUGHNESSES`].
    scale: f64,
    roughness: usize,
    /// Logarithm of the evidence for the class and of its share, at all widths.
    ln_evidence: f64,
    /// Logarithm of the share that the class would have if all its spectra were as wide.
    ln_share: f64,
    facets: LinearClass,
}

/// A width that a class may have: places in [`SCALES`] and [`ROUGHNESSES`].
#[derive(Clone, Copy)]
struct Width {
    scale: usize,
    roughness: usize,
}

impl Width {
    fn all() -> impl Iterator<Item = Self> {
        let of_scale = |scale| (0..ROUGHNESSES.len()).map(move |roughness| Self { scale, roughness });
        (0..SCALES.len()).flat_map(of_scale)
    }

    fn ln_share(self) -> f64 {
        (SCALES[self.scale].1 * ROUGHNESSES[self.roughness].1).ln()
    }
}

impl<'a> Likely<'a> {
    /// `w` is a maximum under the spectra of `under` with the noise `inflation` times its size. None if so few channels do not tell classes
    /// apart.
    pub fn new(under: &Facets, w: &DVector<f64>, prior: &'a Prior, inflation: f64) -> Option<Self> {
        if !tell_classes(under.data) {
            return None;
        }
        let about = under.by_logit(w);
        let telling = is_telling(under, &about, inflation);
        let linear = LinearModel::new(about, prior.beyond(), inflation);
        Some(Self { found: weighed(&linear, prior), prior, linear, inflation, telling })
    }

    /// Where to look under those of most evidence, the most first.
    pub fn starts(&self) -> Vec<Start> {
        let likely = of_most_evidence(&self.found, |one| one.ln_evidence, self.telling);
        likely.iter().filter_map(|one| self.start(one)).collect()
    }

    /// Where to look first.
    pub fn first_start(&self) -> Option<Start> {
        self.start(self.found.first()?)
    }

    /// Those of less evidence than `starts`, unless they do not count beside them.
    pub fn minor(&self, starts: &[Start]) -> Vec<Minor<'_>> {
        let least = self.found.first().map_or(0.0, |most| most.ln_evidence + MINOR_LN_EVIDENCE_LEAST);
        let counts =
            |one: &&Weighed| one.ln_evidence >= least && starts.iter().all(|start| start.class != one.class);
        self.found.iter().filter(counts).filter_map(|one| self.minor_of(one)).collect()
    }

    /// The Gaussian of a class as wide as it is likely to be.
    fn gaussian(&self, one: &Weighed) -> Gaussian {
        self.prior.classes()[one.class].rough(one.roughness).scaled(one.scale)
    }

    /// Where to look under a class: at the mean of the linear posterior.
    fn start(&self, one: &Weighed) -> Option<Start> {
        let gaussian = self.gaussian(one);
        let (w, _) = self.posterior(one, &gaussian)?;
        let Weighed { class, ln_evidence, ln_share, .. } = *one;
        Some(Start { class, inflation: self.inflation, ln_evidence, ln_share, gaussian, w })
    }

    /// The mean of the linear posterior, as a point.
    fn minor_of(&self, one: &Weighed) -> Option<Minor<'_>> {
        let gaussian = self.gaussian(one);
        let (w, ln_determinant) = self.posterior(one, &gaussian)?;
        let coordinates = gaussian.basis().ncols();
        Some(Minor {
            logit: gaussian.logit_at(&w.rows(0, coordinates).into_owned()),
            unknowns: w.rows(coordinates, w.len() - coordinates).into_owned(),
            gaussian,
            linear: &self.linear,
            ln_evidence_of_fit: one.ln_share - 0.5 * (w.norm_squared() + ln_determinant),
        })
    }

    /// The mean of the linear posterior under a class, and the logarithm of the determinant of the facets' covariance.
    fn posterior(&self, one: &Weighed, gaussian: &Gaussian) -> Option<(DVector<f64>, f64)> {
        let factor = one.facets.covariance(&self.linear, one.scale, one.roughness)?;
        let by_logit = self.linear.jacobian.tr_mul(&factor.solve(&one.facets.residuals));
        let (bands, coordinates) = gaussian.basis().shape();
        let mut w = gaussian.basis().tr_mul(&by_logit.rows(0, bands));
        w = w.resize_vertically(coordinates + by_logit.len() - bands, 0.0);
        w.rows_mut(coordinates, by_logit.len() - bands).copy_from(&by_logit.rows_range(bands..));
        Some((w, factor.ln_determinant()))
    }
}

/// Classes by their evidence, most first.
fn weighed(linear: &LinearModel, prior: &Prior) -> Vec<Weighed> {
    let of_class = |(class, known): (usize, &Class)| {
        let facets = LinearClass::new(linear, known);
        let first = facets.at_widths(linear, FIRST_WIDTHS.into_iter())?;
        Some((known.ln_share + first.ln_evidence, class, facets))
    };
    let first: Vec<_> = prior.classes().iter().enumerate().filter_map(of_class).collect();
    let most = first.iter().map(|(ln_evidence, ..)| *ln_evidence).fold(f64::NEG_INFINITY, f64::max);
    let near = first.into_iter().filter(|(ln_evidence, ..)| *ln_evidence >= most + LN_EVIDENCE_NEAR);
    let weighed = near.filter_map(|(_, class, facets)| {
        let AtWidths { ln_evidence, scale, roughness } = facets.at_widths(linear, Width::all())?;
        let ln_evidence = prior.classes()[class].ln_share + ln_evidence;
        let ln_share = ln_evidence - facets.ln_evidence(linear, scale, roughness)?;
        Some(Weighed { class, scale, roughness, ln_evidence, ln_share, facets })
    });
    let mut weighed: Vec<_> = weighed.collect();
    weighed.sort_by(|a, b| b.ln_evidence.total_cmp(&a.ln_evidence));
    weighed
}

/// Whether there are channels enough to tell classes apart.
pub fn tell_classes(data: &FacetData) -> bool {
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

/// Those of most evidence, of which the first has most; more of them if facets are not `telling`.
pub fn of_most_evidence<T>(found: &[T], ln_evidence: impl Fn(&T) -> f64, telling: bool) -> &[T] {
    let (most, ln_least) =
        if telling { (TRIED, LN_EVIDENCE_LEAST) } else { (UNTOLD_TRIED, UNTOLD_LN_EVIDENCE_LEAST) };
    let least = found.first().map_or(0.0, |best| ln_evidence(best) + ln_least);
    let enough = found.partition_point(|one| ln_evidence(one) >= least);
    &found[..enough.min(most)]
}

/// A linear model of the facets about a point, in units of the inflated noise.
struct LinearModel {
    logit: DVector<f64>,
    /// Residual by logit, then by unknown of the scene.
    jacobian: DMatrix<f64>,
    /// What the unknowns would leave if they were as expected.
    residuals: DVector<f64>,
    /// Covariance of the facets by what spectra usually do beyond their class, and by noise and unknowns.
    by_beyond: DMatrix<f64>,
    by_others: DMatrix<f64>,
    exposure: FittedExposure,
}

impl LinearModel {
    fn new(about: ByLogit, beyond: &DMatrix<f64>, inflation: f64) -> Self {
        let ByLogit { logit, unknowns, residuals, jacobian, second } = about;
        let (bands, count) = (logit.len(), unknowns.len());
        let jacobian = jacobian / inflation;
        let residuals = residuals / inflation + jacobian.columns(bands, count) * &unknowns;
        let of_spectrum = jacobian.columns(0, bands);
        let of_others = jacobian.columns(bands, count);
        let by_beyond = of_spectrum * beyond * of_spectrum.transpose();
        let mut by_others = of_others * of_others.transpose();
        (0..by_others.nrows()).for_each(|i| by_others[(i, i)] += 1.0);
        Self { residuals, by_beyond, by_others, exposure: second.exposure, logit, jacobian }
    }
}

/// That model under a class.
struct LinearClass {
    /// What the mean of the class leaves.
    residuals: DVector<f64>,
    /// Covariance of the facets by the class, without what its spectra do beyond it.
    by_class: DMatrix<f64>,
}

/// A class at several widths.
struct AtWidths {
    /// Logarithm of the evidence, the widths being as frequent as they are.
    ln_evidence: f64,
    /// Root mean square by evidence: where facets do not tell the width of a class, error bars are those of all widths.
    scale: f64,
    /// Of most evidence, a place in [`ROUGHNESSES`].
    roughness: usize,
}

impl LinearClass {
    fn new(linear: &LinearModel, class: &Class) -> Self {
        let of_spectrum = linear.jacobian.columns(0, linear.logit.len());
        let residuals = &linear.residuals + of_spectrum * (&linear.logit - class.mean());
        let own = of_spectrum * class.own();
        Self { residuals, by_class: &own * own.transpose() }
    }

    fn covariance(&self, linear: &LinearModel, scale: f64, roughness: usize) -> Option<Cholesky<f64, Dyn>> {
        let (scale, roughness) = (scale.powi(2), ROUGHNESSES[roughness].0.powi(2));
        let mut covariance = linear.by_others.clone();
        let parts = covariance
            .as_mut_slice()
            .iter_mut()
            .zip(self.by_class.as_slice())
            .zip(linear.by_beyond.as_slice());
        parts.for_each(|((sum, by_class), by_beyond)| *sum += scale * (by_class + roughness * by_beyond));
        Cholesky::new(covariance)
    }

    /// The evidence at a width; none if the numbers are not finite.
    fn ln_evidence(&self, linear: &LinearModel, scale: f64, roughness: usize) -> Option<f64> {
        let factor = self.covariance(linear, scale, roughness)?;
        let cost = factor.l_dirty().solve_lower_triangular(&self.residuals)?.norm_squared();
        let ln_evidence = -0.5 * (cost + factor.ln_determinant());
        ln_evidence.is_finite().then_some(ln_evidence)
    }

    /// None if no number is finite.
    fn at_widths(&self, linear: &LinearModel, widths: impl Iterator<Item = Width>) -> Option<AtWidths> {
        let weighed = |width: Width| {
            let ln_of_width = self.ln_evidence(linear, SCALES[width.scale].0, width.roughness)?;
            Some((ln_of_width + width.ln_share(), width))
        };
        let all: Vec<_> = widths.filter_map(weighed).collect();
        let &(most, Width { roughness, .. }) = all.iter().max_by(|(a, _), (b, _)| a.total_cmp(b))?;
        let (mut sum, mut squares) = (0.0, 0.0);
        for (ln_evidence, width) in &all {
            let odds = (ln_evidence - most).exp();
            sum += odds;
            squares += odds * SCALES[width.scale].0.powi(2);
        }
        Some(AtWidths { ln_evidence: most + sum.ln(), scale: (squares / sum).sqrt(), roughness })
    }
}
