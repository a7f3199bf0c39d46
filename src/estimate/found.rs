//! A maximum under one class, and the mean of several of them by their evidence: what an estimate is made of.

use nalgebra::{DMatrix, RowDVector};

use super::data::{FacetData, Residuals};
use super::facets::{AboutMaximum, Facets, Second};
use super::gaussian::logistic;
use super::likely::{Minor, Start};
use super::starts::APART;
use super::unknowns::{EXPOSURE, Expected};
use super::{Estimate, Fitted};
use crate::solve::Termination;
use crate::solve::posterior::{Iteration, Solution};

/// A maximum explains the facets if it leaves them within so many times their noise; further off the scene is not the one that was
/// photographed, and evidence says nothing.
const MISFIT_MOST: f64 = 1.1;
/// The share of the mean from which on the error bars of a class that was not searched are found: that takes as long as a step.
const LEAST_SHARE: f64 = 0.03;
/// A fitted number is one if its standard deviation is below that share of what it was before the picture; an exposure, of which
/// nothing is known before, if it is below that share of the exposure.
const SUPPORTED: f64 = 0.8;
const EXPOSURE_SUPPORTED: f64 = 0.5;

/// The maximum under one class.
pub struct Found {
    /// Where the search ended, under its class; none if that is of all spectra.
    pub end: Option<Start>,
    pub ln_evidence: f64,
    /// Reflectances, unknowns in their own units, exposure.
    pub point: Vec<f64>,
    /// The product of its transpose with it is the covariance of the point.
    pub spread: Option<DMatrix<f64>>,
    /// Derivative of each unknown by its standard normal number: how far it was unknown.
    pub prior_sd: Vec<f64>,
    pub residual_rms: f64,
    /// As [`Solution::surprise`].
    pub surprise: f64,
    pub unexplained: f64,
    pub trace: Vec<Vec<Iteration>>,
    pub termination: Termination,
}

/// A class that was not searched.
pub struct Beside<'a> {
    ln_evidence: f64,
    /// As [`Found::point`].
    point: Vec<f64>,
    minor: &'a Minor<'a>,
    /// As [`Found::prior_sd`].
    prior_sd: Vec<f64>,
    residual_rms: f64,
}

impl<'a> Beside<'a> {
    /// The evidence is less than at the class's own maximum, by what the linear model is off.
    pub fn new(data: &FacetData, minor: &'a Minor<'a>) -> Self {
        let reflectance: Vec<f64> = minor.logit.iter().map(|z| logistic(*z)).collect();
        let Residuals { residuals, exposure } = data.residuals(&reflectance, minor.unknowns.as_slice());
        let unknowns = data.scene().unknowns().iter().zip(&minor.unknowns);
        let (values, prior_sd): (Vec<f64>, Vec<f64>) = unknowns.map(|(expected, w)| expected.at(*w)).unzip();
        Self {
            ln_evidence: minor.ln_evidence_of_fit - 0.5 * residuals.norm_squared(),
            point: reflectance.iter().copied().chain(values).chain([exposure]).collect(),
            minor,
            prior_sd,
            residual_rms: data.rms(&residuals),
        }
    }

    /// As [`Found::spread`].
    fn spread(&self) -> Option<DMatrix<f64>> {
        self.minor.spread(&self.prior_sd, widened(self.residual_rms))
    }
}

/// By how much error bars are wider than the noise makes them. Facets further from the model than their noise: the noise, or the scene, is
/// not what it was said to be (R. T. Birge, *Physical Review* 40 (1932), p. 207).
fn widened(residual_rms: f64) -> f64 {
    residual_rms.max(1.0)
}

/// The mean of the maxima and of classes `beside` them by their evidence, its error bars widened by how far they are from it; the rest is
/// that of the maximum of most evidence. A class beside of no more than [`LEAST_SHARE`] is taken to be known as the rest is in the mean.
pub fn mean(mut found: Vec<Found>, beside: &[Beside]) -> Option<Found> {
    found.sort_by(|a, b| b.ln_evidence.total_cmp(&a.ln_evidence));
    let most = found.first()?;
    // What was not searched counts for no more than the best that was.
    let of_found = found.iter().map(|other| other.ln_evidence);
    let of_all = of_found.chain(beside.iter().map(|other| other.ln_evidence));
    let odds: Vec<f64> = of_all.map(|ln_evidence| (ln_evidence - most.ln_evidence).min(0.0).exp()).collect();
    let sum: f64 = odds.iter().sum();
    let shares: Vec<f64> = odds.iter().map(|odds| odds / sum).collect();
    let points = || found.iter().map(|other| &other.point).chain(beside.iter().map(|other| &other.point));
    let mut point = vec![0.0; most.point.len()];
    for (other, share) in points().zip(&shares) {
        point.iter_mut().zip(other).for_each(|(mean, value)| *mean += share * value);
    }
    let apart = points().zip(&shares).map(|(other, share)| {
        let apart = other.iter().zip(&point).map(|(other, mean)| share.sqrt() * (other - mean));
        RowDVector::from_iterator(point.len(), apart)
    });
    let of_beside = &shares[found.len()..];
    let counting = beside.iter().zip(of_beside).filter(|(_, share)| **share > LEAST_SHARE);
    let counting: Vec<_> = counting.map(|(other, share)| (other.spread(), share)).collect();
    let spreads = found.iter().map(|other| &other.spread).zip(&shares);
    let spreads = spreads.chain(counting.iter().map(|(spread, share)| (spread, *share)));
    let counted: f64 = spreads.clone().map(|(_, share)| share).sum();
    let within = spreads.map(|(spread, share)| Some((share / counted).sqrt() * spread.as_ref()?));
    let within = within.collect::<Option<Vec<_>>>();
    let spread = within.map(|within| {
        let rows = within.iter().flat_map(DMatrix::row_iter).map(nalgebra::Matrix::into_owned);
        DMatrix::from_rows(&rows.chain(apart).collect::<Vec<_>>())
    });
    Some(Found { spread, point, ..found.swap_remove(0) })
}

impl Found {
    /// Where a search ended.
    pub fn new(facets: &Facets, solution: &Solution<Second>, ln_evidence: f64) -> Self {
        let (_, unknowns) = facets.split(&solution.w);
        let Second { reflectance, exposure, .. } = &solution.at.second;
        let unknowns: Vec<(f64, f64)> = facets
            .data
            .scene()
            .unknowns()
            .iter()
            .zip(&unknowns)
            .map(|(expected, w)| expected.at(*w))
            .collect();
        let prior_sd: Vec<f64> = unknowns.iter().map(|(_, slope)| *slope).collect();
        let values = unknowns.iter().map(|(value, _)| *value);
        let residual_rms = facets.data.rms(&solution.at.residuals);
        let (gaussian, (logit, _)) = (facets.gaussian, facets.split(&solution.w));
        let about = AboutMaximum { gaussian, logit: &logit, jacobian: &solution.at.jacobian, exposure };
        Self {
            end: None,
            ln_evidence,
            point: reflectance.iter().copied().chain(values).chain([exposure.value]).collect(),
            spread: about.spread(&prior_sd, widened(residual_rms)),
            prior_sd,
            residual_rms,
            surprise: solution.surprise(),
            unexplained: facets.data.unexplained(&solution.at.residuals),
            trace: vec![solution.trace.clone()],
            termination: solution.termination,
        }
    }

    /// Whether the facets are as near to it as their noise lets them be.
    pub fn explains(&self) -> bool {
        self.residual_rms < MISFIT_MOST
    }

    /// Whether it is the same maximum.
    pub fn is_again(&self, other: &Self, data: &FacetData) -> bool {
        let bands = data.scene().facets().bands();
        let apart = self.point.iter().zip(&other.point).take(bands).map(|(a, b)| (a - b).powi(2));
        let class = |found: &Self| found.end.as_ref().map(|end| end.class);
        class(self) == class(other) && apart.sum::<f64>() < APART * APART * bands as f64
    }

    pub fn iterations(&self) -> usize {
        self.trace.iter().map(Vec::len).sum()
    }

    /// An unknown of the scene beyond its range, and the end of that.
    pub fn impossible(&self, data: &FacetData) -> Option<(usize, f64)> {
        let values = &self.point[data.scene().facets().bands()..];
        let beyond = |(n, expected): (usize, &Expected)| Some((n, expected.bound_of(values[n])?));
        data.scene().unknowns().iter().enumerate().find_map(beyond)
    }

    pub fn into_estimate(self, data: &FacetData) -> Estimate {
        let bands = data.scene().facets().bands();
        let sd = |column: usize| self.spread.as_ref().map_or(f64::INFINITY, |all| all.column(column).norm());
        let unknowns = data.scene().unknowns().iter().zip(&self.prior_sd).zip(bands..);
        let unknowns = unknowns.map(|((expected, prior_sd), column)| Fitted {
            unknown: expected.unknown,
            value: self.point[column],
            sd: sd(column),
            supported: sd(column) < SUPPORTED * prior_sd.abs(),
        });
        let (last, exposure) = (self.point.len() - 1, self.point[self.point.len() - 1]);
        let of_exposure = data.fits_exposure().then(|| Fitted {
            unknown: &EXPOSURE,
            value: exposure,
            sd: sd(last),
            supported: sd(last) < EXPOSURE_SUPPORTED * exposure,
        });
        Estimate {
            total: None,
            // shares of a mean may add up to a rounding more than 1
            reflectance: self.point[..bands].iter().map(|r| r.min(1.0)).collect(),
            fitted: of_exposure.into_iter().chain(unknowns).collect(),
            findings: Vec::new(),
            skipped: Vec::new(),
            spread: self.spread.as_ref().map(|all| all.columns(0, bands).into_owned()),
            exposure,
            residual_rms: self.residual_rms,
            unexplained: self.unexplained,
            without_bounces: 0.0,
            iterations: self.iterations() as u32,
            trace: self.trace,
            termination: self.termination,
        }
    }
}
