//! The default: the most probable spectrum, given the facets and what is known of reflectances.
//!
//! `z = logit r` is Gaussian in each class of spectra before the picture is taken; the facets are Gaussian about the model.
//! Which classes the facets may belong to is told from all spectra as one Gaussian and the model linearised where that
//! leads. Newton's method finds the maximum under each of them in whitened z, the evidence there chooses, and the curvature
//! gives error bars (Laplace's approximation), wider where classes disagree.

use nalgebra::{Cholesky, DMatrix, DVector, RowDVector};

use super::Estimate;
use super::data::{FacetData, LinearisedFacets, SecondDerivatives};
use super::gaussian::{Gaussian, logistic};
use super::prior::{Class, Prior};
use crate::solve::posterior::{Linearised, Model, Solution, first_inflation, maximise};

/// The maximum counts as found within this many standard deviations of it.
const TOLERANCE: f64 = 1e-3;
const ITERATION_LIMIT: u32 = 500;
/// Classes are told apart at this noise, relative to the brightest facet, or at the true one if that is larger; this near to
/// the maximum under all spectra.
const SORTING_NOISE: f64 = 1e-3;
const SORTING_TOLERANCE: f64 = 0.3;
/// Most classes that are tried, and the least evidence for the second, as the logarithm of its share of the first's.
const CLASSES_TRIED: usize = 3;
const LN_EVIDENCE_LEAST: f64 = -4.0;

/// The most probable reflectance. `start` is a reflectance to set out from instead of the prior's mean; at a maximum of more
/// evidence than all others it makes no difference.
///
/// # Source
/// Objective: Deeb et al., eq. (36), with the prior in place of its smoothness term.
#[must_use]
pub fn estimate(data: &FacetData, prior: &Prior, start: Option<&[f64]>) -> Estimate {
    let inflation = (SORTING_NOISE * data.peak()).max(1.0);
    let all = Facets { data, gaussian: prior.broad() };
    let start = start.map_or_else(|| DVector::zeros(all.unknowns()), |start| prior.broad().nearest(start));
    let first = first_inflation(&all, &start, inflation);
    let sorted = maximise(&all, start, (first, inflation), SORTING_TOLERANCE, ITERATION_LIMIT);
    let mut iterations = sorted.iterations;
    let starts = likely(prior, &all.by_logit(&sorted.w), inflation);
    let found = starts.into_iter().map(|start| {
        let facets = Facets { data, gaussian: &start.class.gaussian };
        let solution = maximise(&facets, start.w, (inflation, 1.0), TOLERANCE, ITERATION_LIMIT);
        iterations += solution.iterations;
        let evidence = solution.ln_evidence().map_or(f64::NEG_INFINITY, |ln| ln + start.class.ln_share);
        (evidence, facets, solution)
    });
    let found: Vec<(f64, Estimate)> =
        found.map(|(evidence, facets, solution)| (evidence, facets.estimate(&solution))).collect();
    let estimate = most_evident(found).unwrap_or_else(|| all.estimate(&sorted));
    Estimate { iterations, ..estimate }
}

/// The estimate of most evidence, its error bars widened by how far the others are from it.
fn most_evident(mut found: Vec<(f64, Estimate)>) -> Option<Estimate> {
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let most = found.first()?.0;
    let total: f64 = found.iter().map(|(evidence, _)| (evidence - most).exp()).sum();
    let rows = found.iter().map(|(evidence, other)| {
        let share = ((evidence - most).exp() / total).sqrt();
        let apart =
            other.reflectance.iter().zip(&found[0].1.reflectance).map(|(other, best)| share * (other - best));
        let apart = RowDVector::from_iterator(other.reflectance.len(), apart);
        Some(
            (share * other.spread.as_ref()?)
                .row_iter()
                .map(nalgebra::Matrix::into_owned)
                .chain([apart])
                .collect::<Vec<_>>(),
        )
    });
    let spread = rows.collect::<Option<Vec<_>>>().map(|rows| DMatrix::from_rows(&rows.concat()));
    Some(Estimate { spread, ..found.swap_remove(0).1 })
}

/// A class that the facets may belong to, and where to set out under it.
struct Start<'a> {
    class: &'a Class,
    w: DVector<f64>,
    ln_evidence: f64,
}

/// The classes of most evidence, the model taken to be linear and the noise inflated.
fn likely<'a>(prior: &'a Prior, about: &ByLogit, inflation: f64) -> Vec<Start<'a>> {
    let mut starts: Vec<Start> =
        prior.classes().iter().filter_map(|class| linear(class, about, inflation)).collect();
    starts.sort_by(|a, b| b.ln_evidence.total_cmp(&a.ln_evidence));
    starts.truncate(CLASSES_TRIED);
    let least = starts.first().map_or(0.0, |best| best.ln_evidence + LN_EVIDENCE_LEAST);
    starts.retain(|start| start.ln_evidence >= least);
    starts
}

/// Mean of the linear posterior under a class, and its evidence; none if the numbers are not finite.
fn linear<'a>(class: &'a Class, about: &ByLogit, inflation: f64) -> Option<Start<'a>> {
    let weight = inflation.powi(-2);
    let gaussian = &class.gaussian;
    let jacobian = &about.jacobian * gaussian.basis();
    let residuals = &about.residuals + &about.jacobian * (&about.logit - gaussian.mean());
    let mut information = weight * (jacobian.transpose() * &jacobian);
    (0..information.nrows()).for_each(|i| information[(i, i)] += 1.0);
    let factor = Cholesky::new(information)?;
    let w = factor.solve(&(weight * jacobian.tr_mul(&residuals)));
    let cost = weight * (residuals - jacobian * &w).norm_squared() + w.norm_squared();
    Some(Start { class, w, ln_evidence: class.ln_share - 0.5 * (cost + factor.ln_determinant()) })
}

/// The facets as a model of the whitened logit of reflectance.
struct Facets<'a> {
    data: &'a FacetData<'a>,
    gaussian: &'a Gaussian,
}

/// Residuals and the derivatives of the model by logit about a spectrum.
struct ByLogit {
    logit: DVector<f64>,
    residuals: DVector<f64>,
    jacobian: DMatrix<f64>,
    second: Second,
}

/// What second derivatives by logit are made of.
struct Second {
    reflectance: Vec<f64>,
    by_reflectance: SecondDerivatives,
}

impl Facets<'_> {
    fn reflectance(&self, w: &DVector<f64>) -> Vec<f64> {
        self.gaussian.logit_at(w).iter().map(|z| logistic(*z)).collect()
    }

    fn by_logit(&self, w: &DVector<f64>) -> ByLogit {
        let logit = self.gaussian.logit_at(w);
        let reflectance: Vec<f64> = logit.iter().map(|z| logistic(*z)).collect();
        let LinearisedFacets { residuals, mut jacobian, second } = self.data.linearise(&reflectance);
        for (mut column, r) in jacobian.column_iter_mut().zip(&reflectance) {
            column *= r * (1.0 - r);
        }
        ByLogit { logit, residuals, jacobian, second: Second { reflectance, by_reflectance: second } }
    }

    fn estimate(&self, solution: &Solution<Second>) -> Estimate {
        let reflectance = self.reflectance(&solution.w);
        let at = self.data.residuals(&reflectance);
        Estimate {
            spread: self.spread(&reflectance, solution),
            exposure: at.exposure,
            residual_rms: self.data.rms(&at.residuals),
            iterations: solution.iterations,
            termination: solution.termination,
            reflectance,
        }
    }

    /// Laplace's covariance as a factor, carried from logit to reflectance.
    fn spread(&self, reflectance: &[f64], solution: &Solution<Second>) -> Option<DMatrix<f64>> {
        // The covariance of the logits is B(I + JᵀJ)⁻¹Bᵀ, B the prior's basis.
        let mut spread =
            solution.information()?.l().solve_lower_triangular(&self.gaussian.basis().transpose())?;
        spread.column_iter_mut().zip(reflectance).for_each(|(mut column, r)| column *= r * (1.0 - r));
        Some(spread)
    }
}

impl Model for Facets<'_> {
    type Second = Second;

    fn unknowns(&self) -> usize {
        self.gaussian.basis().ncols()
    }

    fn residuals(&self, w: &DVector<f64>) -> DVector<f64> {
        self.data.residuals(&self.reflectance(w)).residuals
    }

    fn linearise(&self, w: &DVector<f64>) -> Linearised<Second> {
        let ByLogit { residuals, jacobian, second, .. } = self.by_logit(w);
        Linearised { residuals, jacobian: jacobian * self.gaussian.basis(), second }
    }

    fn curvature(&self, at: &Second, multipliers: &DVector<f64>) -> DMatrix<f64> {
        let [slopes, curvatures] = self.data.curvature(&at.by_reflectance, multipliers);
        // By the chain rule, with dr/dz = r(1 − r) and d²r/dz² = r(1 − r)(1 − 2r); wavebands do not mix.
        let by_logit =
            at.reflectance.iter().zip(slopes.iter().zip(&curvatures)).map(|(r, (slope, curvature))| {
                let change = r * (1.0 - r);
                change * (change * curvature + (1.0 - 2.0 * r) * slope)
            });
        let basis = self.gaussian.basis();
        let mut weighted = basis.clone();
        weighted.row_iter_mut().zip(by_logit).for_each(|(mut row, weight)| row *= weight);
        basis.transpose() * weighted
    }
}
