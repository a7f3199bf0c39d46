//! Modes and their mean, weighted by evidence: the ingredients of an estimate.

use nalgebra::{DMatrix, DVector, RowDVector};

use super::family::{Family, SpectrumModel};
use super::linear::{Candidate, LinearMode, Start};
use super::prior::Prior;
use crate::solve::Termination;
use crate::solve::ln_sum;
use crate::solve::posterior::{Iteration, Linearised, Model, Solution};

/// Spectra of a class count as one if their root mean square difference is less.
pub const APART: f64 = 0.005;

/// The mode under a hypothesis and a class of spectra.
pub struct LocalMode<H, S> {
    /// Where the search ended.
    pub start: Start<H>,
    pub at: Linearised<S>,
    pub ln_evidence: f64,
    /// As [`SpectrumModel::values`], and [`SpectrumModel::spread`].
    values: Vec<f64>,
    spread: Option<DMatrix<f64>>,
    pub rms: f64,
    /// As [`Solution::surprise`].
    pub surprise: f64,
    pub trace: Vec<Iteration>,
    pub termination: Termination,
}

/// A class that was not searched, at the mode of the linear model.
pub struct Unsearched<H> {
    hypothesis: H,
    pub ln_evidence: f64,
    values: Vec<f64>,
}

/// The mean of all modes, weighted by their evidence.
pub struct Mixture<H, S> {
    /// As [`SpectrumModel::values`], and [`SpectrumModel::spread`].
    pub values: Vec<f64>,
    pub spread: Option<DMatrix<f64>>,
    /// The mode of most evidence.
    pub best: LocalMode<H, S>,
    /// Hypotheses with their probabilities, which add up to 1; a hypothesis is listed once for each class of
    /// spectra that counts under it.
    pub shares: Vec<(H, f64)>,
    /// Logarithm of the total evidence.
    pub ln_evidence: f64,
}

impl<H: Copy, S> LocalMode<H, S> {
    /// The end of a search from `start`.
    pub fn of<M: SpectrumModel<Second = S>>(model: &M, solution: Solution<S>, start: Start<H>) -> Self {
        let ln_evidence = solution
            .ln_evidence(1.0)
            .map_or(f64::NEG_INFINITY, |ln_evidence| ln_evidence + model.ln_whitening() + start.ln_share);
        Self {
            ln_evidence,
            values: model.values(&solution.w, &model.evaluate(&solution.w)),
            spread: model.spread(&solution.w, &solution.at),
            rms: model.rms(&solution.at.residuals),
            surprise: solution.surprise(1.0),
            start: Start { w: solution.w, tempering: 1.0, ..start },
            at: solution.at,
            trace: solution.trace,
            termination: solution.termination,
        }
    }

    /// True if it is the same mode: of the same class, with reflectances that count as one.
    pub fn is_again(&self, other: &Self) -> bool {
        let bands = self.start.gaussian.mean().len();
        let off = self.values.iter().zip(&other.values).take(bands).map(|(a, b)| (a - b).powi(2));
        self.start.class == other.start.class && off.sum::<f64>() < APART * APART * bands as f64
    }
}

impl<H: Copy> Unsearched<H> {
    /// The evidence is lower than at the class's own mode, because of the error of the linear model; `None`
    /// if it is not finite.
    pub fn of<F: Family<Hypothesis = H>>(
        family: &F,
        candidate: &Candidate<H>,
        prior: &Prior,
    ) -> Option<Self> {
        let hypothesis = candidate.linear.hypothesis;
        let gaussian = candidate.gaussian(prior);
        let LinearMode { w, ln_evidence_of_fit } = candidate.maximum(&gaussian)?;
        let model = family.model(hypothesis, &gaussian)?;
        let at = model.evaluate(&w);
        let ln_evidence = ln_evidence_of_fit - 0.5 * at.residuals.norm_squared();
        ln_evidence.is_finite().then(|| Self { hypothesis, ln_evidence, values: model.values(&w, &at) })
    }
}

impl<H: Copy, S> Mixture<H, S> {
    /// The mean of the modes and of `unsearched` classes, weighted by evidence, with errors widened by their
    /// distances from it. An unsearched class counts at most as much as the best mode, and is assumed to be
    /// as uncertain as the modes are on average. `None` without any mode.
    pub fn of(mut modes: Vec<LocalMode<H, S>>, unsearched: &[Unsearched<H>]) -> Option<Self> {
        modes.retain(|one| one.ln_evidence.is_finite());
        modes.sort_by(|a, b| b.ln_evidence.total_cmp(&a.ln_evidence));
        let most = modes.first()?;
        let all = modes.iter().map(|one| (one.ln_evidence, &one.values));
        let all: Vec<_> = all.chain(unsearched.iter().map(|one| (one.ln_evidence, &one.values))).collect();
        let odds: Vec<f64> = all.iter().map(|(ln, _)| (ln - most.ln_evidence).min(0.0).exp()).collect();
        let (sum, of_modes) = (odds.iter().sum::<f64>(), odds[..modes.len()].iter().sum::<f64>());
        let mut values = DVector::zeros(most.values.len());
        for ((_, own), odds) in all.iter().zip(&odds) {
            values.axpy(odds / sum, &DVector::from_column_slice(own), 1.0);
        }
        let within = modes
            .iter()
            .zip(&odds)
            .map(|(one, odds)| one.spread.as_ref().map(|spread| (odds / of_modes).sqrt() * spread));
        let within: Option<Vec<_>> = within.collect();
        let spread = within.map(|within| {
            let apart = all.iter().zip(&odds).map(|((_, own), odds)| {
                (odds / sum).sqrt() * (RowDVector::from_row_slice(own) - values.transpose())
            });
            let rows = within.iter().flat_map(|spread| spread.row_iter().map(nalgebra::Matrix::into_owned));
            DMatrix::from_rows(&rows.chain(apart).collect::<Vec<_>>())
        });
        let ln_evidence = most.ln_evidence + sum.ln();
        let hypotheses = modes.iter().map(|one| one.start.hypothesis);
        let hypotheses = hypotheses.chain(unsearched.iter().map(|one| one.hypothesis));
        let shares = hypotheses.zip(odds.iter().map(|odds| odds / sum)).collect();
        Some(Self { values: values.data.into(), spread, shares, best: modes.swap_remove(0), ln_evidence })
    }

    /// The mean of two mixtures of the same values, weighted by evidence, with errors widened by their
    /// distance.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let ln_evidence = ln_sum(&[self.ln_evidence, other.ln_evidence]);
        let [own, others] = [&self, &other].map(|one| (one.ln_evidence - ln_evidence).exp());
        let values = |(a, b): (&f64, &f64)| own * a + others * b;
        let apart = self.values.iter().zip(&other.values).map(|(a, b)| (own * others).sqrt() * (a - b));
        let spread = self.spread.as_ref().zip(other.spread.as_ref()).map(|(a, b)| {
            let (a, b) = (own.sqrt() * a, others.sqrt() * b);
            let rows = a.row_iter().chain(b.row_iter()).map(nalgebra::Matrix::into_owned);
            DMatrix::from_rows(
                &rows.chain([RowDVector::from_iterator(self.values.len(), apart)]).collect::<Vec<_>>(),
            )
        });
        let shares = self.shares.iter().map(|(one, share)| (*one, own * share));
        let shares = shares.chain(other.shares.iter().map(|(one, share)| (*one, others * share))).collect();
        Self {
            values: self.values.iter().zip(&other.values).map(values).collect(),
            spread,
            shares,
            best: if own >= others { self.best } else { other.best },
            ln_evidence,
        }
    }
}
