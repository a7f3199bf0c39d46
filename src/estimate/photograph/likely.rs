//! Which kinds of sheets and classes of spectra photographs may show, and where to look for their maxima.

use std::rc::Rc;

use nalgebra::{Cholesky, DMatrix, DVector};

use super::imperfection::Imperfection;
use super::joint::{JointModel, Photograph};
use super::kinds::Kind;
use super::model::Hypothesis;
use crate::estimate::gaussian::Gaussian;
use crate::estimate::likely::SCALES;
use crate::estimate::prior::{Class, Prior};
use crate::solve::Eigen;
use crate::solve::posterior::{Model, Solution};

/// Power of the shares that classes have of all spectra: people fold paper and cloth more often than painted chips, of which most is known.
const SHARE_POWER: f64 = 0.36;
/// How often something else is photographed than a fold, in each of two ways.
const WITHOUT_BOUNCES: f64 = 0.01;
/// Information on a direction of logits that tells no classes apart, each of which knows a hundred times more of it.
const NEGLIGIBLE: f64 = 1e-3;
/// Standard deviation of logits in which a Gaussian has a spectrum only nearly.
const NEARLY: f64 = 0.1;

/// Logarithm of the sum of what classes of spectra are weighed with.
pub fn ln_all_shares(prior: &Prior) -> f64 {
    let classes: f64 = prior.classes().iter().map(|class| (SHARE_POWER * class.ln_share).exp()).sum();
    let scales: f64 = SCALES.iter().map(|(_, share)| share).sum();
    (classes * scales).ln()
}

/// All hypotheses on photographs, those of one imperfection after those of another.
pub fn hypotheses(photographs: &[Photograph]) -> Vec<Hypothesis> {
    // the curves of another camera are never those of this one
    let are_stand_ins = photographs.iter().any(|photograph| photograph.parts.eye.is_stand_in);
    let possible = Imperfection::ALL.into_iter().filter(move |one| one.told > 0.0 || !are_stand_ins);
    possible.flat_map(of_kinds).collect()
}

/// Hypotheses on photographs as people take them.
pub fn usual_hypotheses() -> Vec<Hypothesis> {
    let [usual, ..] = Imperfection::ALL;
    of_kinds(usual).collect()
}

fn of_kinds(imperfection: Imperfection) -> impl Iterator<Item = Hypothesis> {
    // an ideal fold is the same whatever its sheet's kind
    let kinds: &[Kind] = if imperfection.is_ideal() { &[Kind::Matt] } else { &Kind::ALL };
    kinds.iter().map(move |kind| Hypothesis { kind: *kind, imperfection, has_bounces: true })
}

/// Hypotheses on what is no fold: a flat sheet, a ridge, corners elsewhere.
pub fn hypotheses_without_bounces() -> impl Iterator<Item = Hypothesis> {
    let [usual, ideal, ..] = Imperfection::ALL;
    let of = |imperfection| Hypothesis { kind: Kind::Matt, imperfection, has_bounces: false };
    [usual, ideal].into_iter().map(of)
}

impl Hypothesis {
    /// Logarithm of how often it is true.
    pub fn ln_share(&self) -> f64 {
        if !self.has_bounces {
            return WITHOUT_BOUNCES.ln();
        }
        let of_kind = if self.imperfection.is_ideal() { 0.0 } else { self.kind.ln_share() };
        self.imperfection.ln_share() + of_kind
    }
}

/// A hypothesis and a class of spectra at one of its widths, and where they are judged from.
pub struct Likely<'a> {
    pub hypothesis: Hypothesis,
    pub about: Rc<About>,
    pub class: &'a Class,
    pub scale: f64,
    pub ln_share: f64,
    /// If the model is linear.
    pub ln_evidence: f64,
}

/// The model, taken to be linear about a maximum under all spectra.
pub struct About {
    /// Logits of the albedo there, and the numbers that are not of the spectrum.
    logit: DVector<f64>,
    others: DVector<f64>,
    /// Derivatives by logit, as far as the coordinates of all spectra tell them, and by the others.
    by_logit: DMatrix<f64>,
    by_others: DMatrix<f64>,
    residuals: DVector<f64>,
    /// What the facets tell of logits whatever the others are, as few values of standard deviation 1: value by waveband, and how far the
    /// values are off at the maximum.
    told: DMatrix<f64>,
    off: DVector<f64>,
}

/// Where a linear model has its maximum, and `|ρ|² + |w|²` of it there.
pub struct LinearMaximum {
    pub w: DVector<f64>,
    pub cost: f64,
}

impl About {
    pub fn new(broad: &Gaussian, solution: &Solution<()>) -> Option<Self> {
        let scene = broad.basis().ncols();
        let count = solution.w.len() - scene;
        let coordinates_of = broad.basis().clone().pseudo_inverse(1e-9).ok()?;
        let logit = broad.logit_at(&solution.w.rows(0, scene).into_owned());
        let others = solution.w.rows(scene, count).into_owned();
        let by_logit = solution.at.jacobian.columns(0, scene) * coordinates_of;
        let by_others = solution.at.jacobian.columns(scene, count).into_owned();
        let residuals = solution.at.residuals.clone();
        let mut information = by_others.transpose() * &by_others;
        (0..count).for_each(|n| information[(n, n)] += 1.0);
        let both = by_others.transpose() * &by_logit;
        let left = Cholesky::new(information)?.solve(&both);
        let at_prior = &residuals + &by_others * &others;
        let told = by_logit.transpose() * &by_logit - both.transpose() * &left;
        let off = by_logit.tr_mul(&at_prior) - left.tr_mul(&by_others.tr_mul(&at_prior));
        let Eigen { values, vectors } = Eigen::of_symmetric(told);
        let kept: Vec<usize> = (0..values.len()).filter(|n| values[*n] > NEGLIGIBLE).collect();
        let row = |n: &usize| values[*n].sqrt() * vectors.column(*n).transpose();
        Some(Self {
            told: DMatrix::from_rows(&kept.iter().map(row).collect::<Vec<_>>()),
            off: DVector::from_iterator(
                kept.len(),
                kept.iter().map(|n| vectors.column(*n).dot(&off) / values[*n].sqrt()),
            ),
            logit,
            others,
            by_logit,
            by_others,
            residuals,
        })
    }

    /// All classes of spectra at all widths under a hypothesis that is so often true, `ln_evidence` being that for all spectra as one Gaussian.
    pub fn classes<'a>(
        self,
        (hypothesis, ln_share): (Hypothesis, f64),
        prior: &'a Prior,
        ln_evidence: f64,
    ) -> Option<Vec<Likely<'a>>> {
        let about = Rc::new(self);
        let of_all = about.ln_evidence(prior.broad(), 1.0)?;
        let pairs =
            prior.classes().iter().flat_map(|class| SCALES.map(|(scale, share)| (class, scale, share)));
        let likely = |(class, scale, share): (&'a Class, f64, f64)| {
            let ln_share = ln_share + SHARE_POWER * class.ln_share + share.ln();
            let ln_evidence = ln_evidence + ln_share + about.ln_evidence(class.gaussian(), scale)? - of_all;
            Some(Likely { hypothesis, class, scale, ln_share, ln_evidence, about: Rc::clone(&about) })
        };
        Some(pairs.filter_map(likely).collect())
    }

    /// The evidence for spectra that are `scale` times as wide as a Gaussian, but for a term that all spectra share.
    fn ln_evidence(&self, spectra: &Gaussian, scale: f64) -> Option<f64> {
        let spread = scale * &self.told * spectra.basis();
        let mut covariance = &spread * spread.transpose();
        (0..covariance.nrows()).for_each(|n| covariance[(n, n)] += 1.0);
        let off = &self.off + &self.told * (&self.logit - spectra.mean());
        let factor = Cholesky::new(covariance)?;
        let cost = factor.l_dirty().solve_lower_triangular(&off)?.norm_squared();
        Some(-0.5 * (cost + factor.ln_determinant()))
    }

    /// Where to set out for the maximum under a Gaussian of spectra: where the linear model has it or, if that is further off, here.
    pub fn start(&self, model: &JointModel, own: &Gaussian) -> Option<DVector<f64>> {
        let cost = |w: &DVector<f64>| model.residuals(w).norm_squared() + w.norm_squared();
        let (maximum, here) = (self.maximum(own)?.w, self.in_coordinates_of(own)?);
        Some(if cost(&here) < cost(&maximum) { here } else { maximum })
    }

    /// The maximum under all spectra in the coordinates of another Gaussian, as nearly as that has it.
    fn in_coordinates_of(&self, own: &Gaussian) -> Option<DVector<f64>> {
        let basis = own.basis();
        let mut information = basis.tr_mul(basis);
        (0..information.nrows()).for_each(|i| information[(i, i)] += NEARLY.powi(2));
        let spectrum = Cholesky::new(information)?.solve(&basis.tr_mul(&(&self.logit - own.mean())));
        let count = spectrum.len() + self.others.len();
        Some(DVector::from_iterator(count, spectrum.iter().chain(&self.others).copied()))
    }

    /// The maximum under a Gaussian of spectra.
    pub fn maximum(&self, own: &Gaussian) -> Option<LinearMaximum> {
        let coordinates = own.basis().ncols();
        let mut jacobian = DMatrix::zeros(self.by_logit.nrows(), coordinates + self.others.len());
        jacobian.columns_mut(0, coordinates).gemm(1.0, &self.by_logit, own.basis(), 0.0);
        jacobian.columns_mut(coordinates, self.others.len()).copy_from(&self.by_others);
        let residuals =
            &self.residuals + &self.by_logit * (&self.logit - own.mean()) + &self.by_others * &self.others;
        let mut information = jacobian.transpose() * &jacobian;
        (0..information.nrows()).for_each(|i| information[(i, i)] += 1.0);
        let slope = jacobian.tr_mul(&residuals);
        let w = Cholesky::new(information)?.solve(&slope);
        Some(LinearMaximum { cost: residuals.norm_squared() - slope.dot(&w), w })
    }
}
