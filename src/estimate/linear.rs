//! The evidence of classes of spectra, from a model linearised about a point.
//!
//! After the rest of the scene is marginalised, data determine a few numbers of the spectrum with standard
//! deviation 1; under a class of spectra these are normal, too. The evidence of all classes at all widths
//! therefore takes only small matrices.

use std::rc::Rc;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::family::{Family, SpectrumModel};
use super::gaussian::Gaussian;
use super::prior::{Class, Prior, ROUGHNESSES, SCALES};
use crate::solve::Eigen;
use crate::solve::dense::{
    add_product, cholesky, product, product_with_transposed, squares, squares_of_rows, stacked,
    transposed_product,
};
use crate::solve::posterior::{Linearised, Model};

/// Widths at which every class is weighed. Only classes whose log evidence is this close to the best are
/// weighed at all widths, which takes most of the time.
const FIRST_WIDTHS: [Width; 2] = [Width { scale: 1, roughness: 0 }, Width { scale: 2, roughness: 1 }];
const LN_EVIDENCE_NEAR: f64 = -6.0;
/// Maximum number of candidates searched, and their least log evidence relative to the first; then the same
/// where data do not distinguish classes.
const TRIED: usize = 3;
const LN_EVIDENCE_LEAST: f64 = -3.0;
const UNSEPARATED_TRIED: usize = 24;
const UNSEPARATED_LN_EVIDENCE_LEAST: f64 = -5.0;
/// Number of values by which most classes are ruled out.
const FEW_VALUES: usize = 4;
/// Other numbers are few if wavebands are this many times as many: those of a photograph are more, and less
/// precise.
const FEW: usize = 2;
/// Number of directions in logit about which data must say more than the prior of all spectra to distinguish
/// classes.
const TELLING_LEAST: usize = 3;
/// Information about a direction in logit that is too small to distinguish classes, each of which has a
/// hundred times more.
const NEGLIGIBLE: f64 = 1e-3;
/// Standard deviation of logits within which a Gaussian approximates a spectrum.
const NEARLY: f64 = 0.1;

/// A possible width of a class: indices into [`SCALES`] and [`ROUGHNESSES`].
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

/// The model under a hypothesis, linearised about a point.
pub struct Linear<H> {
    pub hypothesis: H,
    /// Logarithm of the prior probability.
    pub ln_share: f64,
    /// Factor by which the noise was tempered; everything below is in units of that noise.
    tempering: f64,
    logit: DVector<f64>,
    others: DVector<f64>,
    by_logit: DMatrix<f64>,
    by_others: DMatrix<f64>,
    /// Residuals at that spectrum, with all other numbers at their prior means.
    residuals: DVector<f64>,
    of_others: Cholesky<f64, Dyn>,
    informed: Informed,
    /// Part of the log determinant that does not depend on the spectrum.
    ln_determinant: f64,
}

/// A class of spectra under a hypothesis, with its evidence.
pub struct Candidate<H> {
    pub linear: Rc<Linear<H>>,
    /// Index of the class in the prior.
    class: usize,
    /// Its probable scale, and an index into [`ROUGHNESSES`].
    scale: f64,
    roughness: usize,
    /// Logarithm of evidence times probability, over all widths.
    pub ln_evidence: f64,
    /// Logarithm of the probability it would have if all its spectra were as wide.
    ln_share: f64,
}

/// Starting point of a search for a mode.
pub struct Start<H> {
    /// The hypothesis.
    pub hypothesis: H,
    /// Index of the class of spectra in the prior.
    pub class: usize,
    /// Factor by which the noise was tempered where the point was found.
    pub tempering: f64,
    /// Logarithm of evidence times probability where the point was found.
    pub ln_evidence: f64,
    /// Logarithm of its prior probability, as if all spectra of the class were as wide as `gaussian`.
    pub ln_share: f64,
    /// The spectra of the class, at their probable width.
    pub gaussian: Gaussian,
    pub w: DVector<f64>,
}

/// The mode of the linear model under a class.
pub struct LinearMode {
    pub w: DVector<f64>,
    /// Log evidence without the residual there, which the model itself gives.
    pub ln_evidence_of_fit: f64,
}

impl<H: Copy> Linear<H> {
    /// Linearises about `w`, with the noise scaled by `tempering`, under a hypothesis and the logarithm of
    /// its probability; `None` if the model is not finite.
    ///
    /// # Source
    /// The other numbers are marginalised: Schur complement of their information (docs/model.md).
    pub fn laplace<M: SpectrumModel>(
        model: &M,
        (w, at): (&DVector<f64>, &Linearised<M::Second>),
        tempering: f64,
        (hypothesis, ln_share): (H, f64),
    ) -> Option<Self> {
        let scene = model.gaussian().basis().ncols();
        let count = w.len() - scene;
        let others = w.rows(scene, count).into_owned();
        let by_logit = model.by_logit(at) / tempering;
        let by_others = at.jacobian.columns(scene, count) / tempering;
        let residuals = &at.residuals / tempering + &by_others * &others;
        let mut information = by_others.tr_mul(&by_others);
        (0..count).for_each(|n| information[(n, n)] += 1.0);
        let of_others = cholesky(information)?;
        let ln_determinant = of_others.ln_determinant() - 2.0 * model.ln_whitening();
        let informed = if FEW * count < by_logit.ncols() {
            Informed::of_few_others(&by_logit, &by_others, &residuals).condensed()
        } else {
            Informed::of_many_others(&by_logit, &by_others, &residuals, &of_others)
        };
        let logit = model.gaussian().logit_at(&w.rows(0, scene).into_owned());
        Some(Self {
            hypothesis,
            ln_share,
            tempering,
            logit,
            others,
            by_logit,
            by_others,
            residuals,
            of_others,
            informed,
            ln_determinant,
        })
        .filter(|linear| (linear.ln_determinant + linear.informed.left).is_finite())
    }

    /// True if the data say so much about a spectrum that classes of less evidence may be dropped.
    pub fn is_telling(&self, gaussian: &Gaussian) -> bool {
        let spread = product(&self.informed.values, gaussian.basis());
        if spread.nrows() < TELLING_LEAST || spread.iter().any(|value| !value.is_finite()) {
            return false;
        }
        let information = Eigen::of_symmetric(&spread * spread.transpose()).values;
        information.iter().filter(|value| **value > 1.0).count() >= TELLING_LEAST
    }
}

/// Combinations of logits determined by the data, with the other numbers marginalised.
struct Informed {
    /// Value by waveband, each value with standard deviation 1, those determined best first.
    values: DMatrix<f64>,
    /// Offsets of the values at the point of linearisation.
    off: DVector<f64>,
    /// Sum of squares that does not depend on the spectrum.
    left: f64,
}

impl Informed {
    /// Uses orthogonal transformations: forming the information would lose half of the digits of precise
    /// data.
    ///
    /// # Source
    /// Bierman, *Factorization Methods for Discrete Sequential Estimation* (1977), section IV.2.
    fn of_few_others(by_logit: &DMatrix<f64>, by_others: &DMatrix<f64>, residuals: &DVector<f64>) -> Self {
        let ((data, bands), others) = (by_logit.shape(), by_others.ncols());
        let mut all = DMatrix::zeros(data + others, others + bands + 1);
        all.view_mut((0, 0), (data, others)).copy_from(by_others);
        all.view_mut((0, others), (data, bands)).copy_from(by_logit);
        all.view_mut((0, others + bands), (data, 1)).copy_from(residuals);
        (0..others).for_each(|n| all[(data + n, n)] = 1.0);
        let r = all.qr().unpack_r();
        let count = (r.nrows() - others).min(bands);
        let last = others + bands;
        Self {
            values: r.view((others, others), (count, bands)).into_owned(),
            off: r.view((others, last), (count, 1)).column(0).into_owned(),
            left: if r.nrows() > last { r[(last, last)].powi(2) } else { 0.0 },
        }
    }

    /// Without the information that distinguishes no classes: weighing these takes the time of its square.
    ///
    /// # Source
    /// Golub and Van Loan, *Matrix Computations* (2013), section 5.4.2: QR with column pivoting, which is an
    /// orthogonal transformation.
    fn condensed(self) -> Self {
        let Self { values, mut off, left } = self;
        let qr = values.col_piv_qr();
        let mut values = qr.r();
        let count = (0..values.nrows()).take_while(|n| values[(*n, *n)].powi(2) > NEGLIGIBLE).count();
        qr.p().inv_permute_columns(&mut values);
        qr.q_tr_mul(&mut off);
        let beyond = off.rows(count, off.len() - count).norm_squared();
        Self {
            values: values.rows(0, count).into_owned(),
            off: off.rows(0, count).into_owned(),
            left: left + beyond,
        }
    }

    /// Uses the information on logits, in which few directions count.
    fn of_many_others(
        by_logit: &DMatrix<f64>,
        by_others: &DMatrix<f64>,
        residuals: &DVector<f64>,
        of_others: &Cholesky<f64, Dyn>,
    ) -> Self {
        let both = transposed_product(by_others, by_logit);
        let left = of_others.solve(&both);
        let by_others_off = by_others.tr_mul(residuals);
        let information = transposed_product(by_logit, by_logit) - transposed_product(&both, &left);
        let off = by_logit.tr_mul(residuals) - left.tr_mul(&by_others_off);
        let Eigen { values, vectors } = Eigen::of_symmetric(information);
        let mut kept: Vec<usize> = (0..values.len()).filter(|n| values[*n] > NEGLIGIBLE).collect();
        kept.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
        let informed = DMatrix::from_fn(kept.len(), by_logit.ncols(), |n, band| {
            values[kept[n]].sqrt() * vectors[(band, kept[n])]
        });
        let off = kept.iter().map(|n| vectors.column(*n).dot(&off) / values[*n].sqrt());
        let off = DVector::from_iterator(kept.len(), off);
        let explained = by_others_off.dot(&of_others.solve(&by_others_off)) + off.norm_squared();
        Self { values: informed, off, left: residuals.norm_squared() - explained }
    }

    /// The first values alone, at most `count`.
    fn first(&self, count: usize) -> Self {
        let count = count.min(self.off.len());
        let (values, off) = (self.values.rows(0, count).into_owned(), self.off.rows(0, count).into_owned());
        Self { values, off, left: self.left }
    }

    /// Covariance of the values by deviations of spectra beyond any class.
    fn by_beyond(&self, prior: &Prior) -> DMatrix<f64> {
        product_with_transposed(&product(&self.values, prior.beyond()), &self.values)
    }
}

/// That model under a class.
struct LinearClass {
    /// Offset from the mean of the class.
    off: DVector<f64>,
    /// Covariance of the values under the class, without deviations of spectra beyond it: its lower triangle.
    by_class: DMatrix<f64>,
}

/// A class at several widths.
struct AtWidths {
    /// Log evidence, with the widths weighted by their probabilities.
    ln_evidence: f64,
    /// Root mean square, weighted by evidence: where data do not determine the width of a class, error bars
    /// reflect all widths.
    scale: f64,
    /// That of most evidence, as an index into [`ROUGHNESSES`].
    roughness: usize,
}

impl LinearClass {
    fn new(informed: &Informed, logit: &DVector<f64>, class: &Class) -> Self {
        let mut off = informed.off.clone();
        add_product(&mut off, &informed.values, &(logit - class.mean()));
        let own = product_with_transposed(&informed.values, class.own());
        Self { off, by_class: squares_of_rows(&own) }
    }

    /// The log evidence at a width; `None` if it is not finite.
    ///
    /// # Source
    /// Factors the covariance into `LDLᵀ`, as in Golub and Van Loan, *Matrix Computations* (2013), section
    /// 4.1.2, and solves as it goes: a few values take a fraction of the time of a library's factor.
    fn ln_evidence(&self, by_beyond: &DMatrix<f64>, scale: f64, roughness: usize) -> Option<f64> {
        let (scale, roughness) = (scale.powi(2), ROUGHNESSES[roughness].0.powi(2));
        let mut left = self
            .by_class
            .zip_map(by_beyond, |by_class, by_beyond| scale * (by_class + roughness * by_beyond));
        let mut off = self.off.clone();
        let (mut cost, mut ln_determinant) = (0.0, 0.0);
        let count = off.len();
        for n in 0..count {
            let (own, rest) = left.as_mut_slice()[n * count..].split_at_mut(count);
            let variance = own[n] + 1.0;
            cost += off[n].powi(2) / variance;
            ln_determinant += f64::ln(variance);
            for (column, rest) in (n + 1..count).zip(rest.chunks_exact_mut(count)) {
                let share = own[column] / variance;
                off[column] -= share * off[n];
                rest[column..].iter_mut().zip(&own[column..]).for_each(|(left, own)| *left -= share * own);
            }
        }
        let ln_evidence = -0.5 * (cost + ln_determinant);
        ln_evidence.is_finite().then_some(ln_evidence)
    }

    /// `None` if no width has a finite value.
    fn at_widths(&self, by_beyond: &DMatrix<f64>, widths: impl Iterator<Item = Width>) -> Option<AtWidths> {
        let weighed = |width: Width| {
            let ln_of_width = self.ln_evidence(by_beyond, SCALES[width.scale].0, width.roughness)?;
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

/// Classes under all hypotheses, in order of decreasing evidence.
///
/// Most are ruled out by a few values: as each value has a standard deviation of 1 or more given the others,
/// evidence never exceeds that of the first values alone.
pub fn candidates<F: Family>(
    family: &F,
    linears: Vec<Linear<F::Hypothesis>>,
    prior: &Prior,
) -> Vec<Candidate<F::Hypothesis>> {
    let (mut first, mut most) = (Vec::new(), f64::NEG_INFINITY);
    for linear in linears.into_iter().map(Rc::new) {
        let few = linear.informed.first(FEW_VALUES);
        let by_beyond_few = few.by_beyond(prior);
        let by_beyond = Rc::new(linear.informed.by_beyond(prior));
        let known = -0.5 * (linear.ln_determinant + linear.informed.left);
        let ln_shares = family.ln_class_shares(linear.hypothesis, prior);
        for (class, (of_prior, ln_share)) in prior.classes().iter().zip(ln_shares).enumerate() {
            let ln_share = linear.ln_share + ln_share;
            let weighed = |informed: &Informed, by_beyond: &DMatrix<f64>| {
                let informed = LinearClass::new(informed, &linear.logit, of_prior);
                let ln_evidence =
                    known + ln_share + informed.at_widths(by_beyond, FIRST_WIDTHS.into_iter())?.ln_evidence;
                (ln_evidence >= most + LN_EVIDENCE_NEAR).then_some((ln_evidence, informed))
            };
            if weighed(&few, &by_beyond_few).is_some()
                && let Some((ln_evidence, informed)) = weighed(&linear.informed, &by_beyond)
            {
                most = most.max(ln_evidence);
                let (linear, by_beyond) = (Rc::clone(&linear), Rc::clone(&by_beyond));
                first.push((ln_evidence, (known, ln_share), class, informed, linear, by_beyond));
            }
        }
    }
    let near = first.into_iter().filter(|(ln_evidence, ..)| *ln_evidence >= most + LN_EVIDENCE_NEAR);
    let weighed = near.filter_map(|(_, (known, ln_share), class, informed, linear, by_beyond)| {
        let AtWidths { ln_evidence, scale, roughness } = informed.at_widths(&by_beyond, Width::all())?;
        let of_width = informed.ln_evidence(&by_beyond, scale, roughness)?;
        Some(Candidate {
            linear,
            class,
            scale,
            roughness,
            ln_evidence: known + ln_share + ln_evidence,
            ln_share: ln_share + ln_evidence - of_width,
        })
    });
    let mut weighed: Vec<_> = weighed.collect();
    weighed.sort_by(|a, b| b.ln_evidence.total_cmp(&a.ln_evidence));
    weighed
}

/// Those of `candidates`, in order of evidence, that are worth a search: more of them if data are not
/// `telling`.
pub fn worth_a_search<H>(candidates: &[Candidate<H>], is_telling: bool) -> &[Candidate<H>] {
    let (most, ln_least) = if is_telling {
        (TRIED, LN_EVIDENCE_LEAST)
    } else {
        (UNSEPARATED_TRIED, UNSEPARATED_LN_EVIDENCE_LEAST)
    };
    let least = candidates.first().map_or(0.0, |best| best.ln_evidence + ln_least);
    let enough = candidates.partition_point(|one| one.ln_evidence >= least);
    &candidates[..enough.min(most)]
}

impl<H: Copy> Candidate<H> {
    /// The Gaussian of the class, at its probable width.
    pub fn gaussian(&self, prior: &Prior) -> Gaussian {
        prior.classes()[self.class].rough(self.roughness).scaled(self.scale)
    }

    /// Starting point for the mode: that of the linear model or, if it is worse, the point of linearisation.
    pub fn start<F: Family<Hypothesis = H>>(&self, family: &F, prior: &Prior) -> Option<Start<H>> {
        let Linear { hypothesis, tempering, .. } = *self.linear;
        let gaussian = self.gaussian(prior);
        let model = family.model(hypothesis, &gaussian)?;
        let cost = |w: &DVector<f64>| (model.residuals(w) / tempering).norm_squared() + w.norm_squared();
        let (maximum, here) = (self.maximum(&gaussian)?.w, self.in_coordinates_of(&gaussian)?);
        // the linear model may lead to where the true one is not finite
        let w = if cost(&maximum) <= cost(&here) { maximum } else { here };
        let Self { class, ln_evidence, ln_share, .. } = *self;
        drop(model);
        Some(Start { hypothesis, class, tempering, ln_evidence, ln_share, gaussian, w })
    }

    /// The point of linearisation in the coordinates of a Gaussian, as closely as possible.
    fn in_coordinates_of(&self, own: &Gaussian) -> Option<DVector<f64>> {
        let (basis, linear) = (own.basis(), &self.linear);
        let mut information = squares(basis);
        (0..information.nrows()).for_each(|i| information[(i, i)] += NEARLY.powi(2));
        let spectrum = cholesky(information)?.solve(&basis.tr_mul(&(&linear.logit - own.mean())));
        Some(stacked(&spectrum, &linear.others))
    }

    /// The mode of the linear model under a Gaussian of spectra.
    pub fn maximum(&self, own: &Gaussian) -> Option<LinearMode> {
        let linear = &self.linear;
        let away = &linear.logit - own.mean();
        let values = &linear.informed.values;
        let spread = product(values, own.basis());
        let mut covariance = squares_of_rows(&spread);
        (0..covariance.nrows()).for_each(|n| covariance[(n, n)] += 1.0);
        let factor = cholesky(covariance)?;
        let spectrum = spread.tr_mul(&factor.solve(&(&linear.informed.off + values * &away)));
        let left = &linear.residuals + &linear.by_logit * (away - own.basis() * &spectrum);
        let w = stacked(&spectrum, &linear.of_others.solve(&linear.by_others.tr_mul(&left)));
        let ln_determinant = factor.ln_determinant() + linear.ln_determinant;
        Some(LinearMode { ln_evidence_of_fit: self.ln_share - 0.5 * (w.norm_squared() + ln_determinant), w })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// The evidence is that of a normal distribution, by a library's factor of its covariance, and the
        /// first values bound it from above.
        #[test]
        fn a_few_values_bound_the_evidence_of_all(
            entries in prop::collection::vec(-1.0_f64..1.0, 36),
            off in prop::collection::vec(-3.0_f64..3.0, 6),
            ln_precision in 0.0_f64..7.0,
        ) {
            let (precision, beyond) = (ln_precision.exp(), DMatrix::from_row_slice(6, 6, &entries[..36]));
            let own = precision * &beyond;
            let by_beyond = 0.1 * precision * precision * beyond.transpose() * &beyond;
            let of = |count: usize| {
                let off = DVector::from_column_slice(&off[..count]) * precision;
                let by_class = (&own * own.transpose()).view((0, 0), (count, count)).into_owned();
                let by_beyond = by_beyond.view((0, 0), (count, count)).into_owned();
                (LinearClass { off, by_class }, by_beyond)
            };
            let (class, by_beyond) = of(6);
            let ln_evidence = class.ln_evidence(&by_beyond, 1.1, 1).unwrap();
            let scale = 1.1_f64.powi(2);
            let covariance = DMatrix::identity(6, 6)
                + scale * (&class.by_class + ROUGHNESSES[1].0.powi(2) * &by_beyond);
            let factor = Cholesky::new(covariance).unwrap();
            let cost = class.off.dot(&factor.solve(&class.off));
            let want = -0.5 * (cost + factor.ln_determinant());
            prop_assert!((ln_evidence - want).abs() < 1e-6 * want.abs().max(1.0), "{ln_evidence} {want}");
            let mut bound = 0.0;
            for count in 1..=6 {
                let (class, by_beyond) = of(count);
                let first = class.ln_evidence(&by_beyond, 1.1, 1).unwrap();
                prop_assert!(first <= bound + 1e-6 * first.abs(), "{count}: {first} {bound}");
                bound = first;
            }
        }
    }
}
