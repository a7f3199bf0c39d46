//! The default: the most probable spectrum, given the facets and what is known of reflectances.
//!
//! `z = logit r` is Gaussian in each class of spectra before the picture is taken; the facets are Gaussian about the model.
//! Which classes the facets may belong to is told from all spectra as one Gaussian and the model linearised where that
//! leads. Newton's method finds the maximum under each of them in whitened z, the evidence there chooses, and the curvature
//! gives error bars (Laplace's approximation), wider where classes disagree.

use nalgebra::{Cholesky, DMatrix, DVector, RowDVector};

use super::data::{Curvature, FacetData, FittedExposure, LinearisedFacets, SecondDerivatives};
use super::gaussian::{Gaussian, logistic};
use super::prior::{Class, Prior};
use super::unknowns::{Quantity, Unknown};
use super::{Estimate, Fitted};
use crate::solve::Termination;
use crate::solve::posterior::{Iteration, Linearised, Model, Solution, first_inflation, maximise};

/// The maximum counts as found within this many standard deviations of it.
const TOLERANCE: f64 = 1e-3;
const ITERATION_LIMIT: usize = 500;
/// Classes are told apart at this noise, relative to the brightest facet, or at the true one if that is larger; this near to
/// the maximum under all spectra.
const SORTING_NOISE: f64 = 1e-3;
const SORTING_TOLERANCE: f64 = 0.3;
/// Most classes that are tried, and the least evidence for the second, as the logarithm of its share of the first's.
const CLASSES_TRIED: usize = 3;
const LN_EVIDENCE_LEAST: f64 = -4.0;
/// A fitted number is one if its standard deviation is below that share of what it was before the picture; an exposure, of which
/// nothing is known before, if it is below that share of the exposure.
const SUPPORTED: f64 = 0.8;
const EXPOSURE_SUPPORTED: f64 = 0.5;

/// The most probable reflectance and, with it, the scene's unknowns. `start` is a reflectance to set out from instead of the
/// prior's mean; at a maximum of more evidence than all others it makes no difference.
///
/// # Source
/// Objective: Deeb et al., eq. (36), with the prior in place of its smoothness term.
#[must_use]
pub fn estimate(data: &FacetData, prior: &Prior, start: Option<&[f64]>) -> Estimate {
    let found = most_probable(data, prior, start);
    match found.impossible(data) {
        None => found.into_estimate(data),
        // The maximum lies on the bound; how far off it may be is told from what lies on both of its sides.
        Some((unknown, least)) => {
            let on_bound = most_probable(&data.with_known(unknown, least), prior, start);
            let Found { spread, prior_sd, mut trace, .. } = found;
            trace.extend(on_bound.trace);
            Found { spread, prior_sd, trace, ..on_bound }.into_estimate(data)
        }
    }
}

/// The maximum, whether or not all unknowns of the scene can be so.
fn most_probable(data: &FacetData, prior: &Prior, start: Option<&[f64]>) -> Found {
    let inflation = (SORTING_NOISE * data.peak()).max(1.0);
    let all = Facets { data, gaussian: prior.broad() };
    let start = start.map_or_else(|| DVector::zeros(all.unknowns()), |start| all.from_reflectance(start));
    let first = first_inflation(&all, &start, inflation);
    let sorted = maximise(&all, start, (first, inflation), SORTING_TOLERANCE, ITERATION_LIMIT);
    let starts = likely(prior, &all.by_logit(&sorted.w), inflation);
    let found = starts.into_iter().map(|start| {
        let facets = Facets { data, gaussian: &start.class.gaussian };
        let solution = maximise(&facets, start.w, (inflation, 1.0), TOLERANCE, ITERATION_LIMIT);
        let evidence = solution.ln_evidence().map_or(f64::NEG_INFINITY, |ln| ln + start.class.ln_share);
        facets.found(&solution, evidence)
    });
    let found: Vec<Found> = found.collect();
    let runs = found.iter().flat_map(|found| found.trace.clone());
    let trace = std::iter::once(sorted.trace.clone()).chain(runs).collect();
    let best = most_evident(found).unwrap_or_else(|| all.found(&sorted, 0.0));
    Found { trace, ..best }
}

/// The maximum under one class.
struct Found {
    ln_evidence: f64,
    /// Reflectances, unknowns in their own units, exposure.
    point: Vec<f64>,
    /// The product of its transpose with it is the covariance of the point.
    spread: Option<DMatrix<f64>>,
    /// Derivative of each unknown by its standard normal number: how far it was unknown.
    prior_sd: Vec<f64>,
    residual_rms: f64,
    trace: Vec<Vec<Iteration>>,
    termination: Termination,
}

/// That of most evidence, its error bars widened by how far the others are from it.
fn most_evident(mut found: Vec<Found>) -> Option<Found> {
    found.sort_by(|a, b| b.ln_evidence.total_cmp(&a.ln_evidence));
    let most = found.first()?;
    let odds = |other: &Found| (other.ln_evidence - most.ln_evidence).exp();
    let total: f64 = found.iter().map(odds).sum();
    let rows = found.iter().map(|other| {
        let share = (odds(other) / total).sqrt();
        let apart = other.point.iter().zip(&most.point).map(|(other, best)| share * (other - best));
        let apart = RowDVector::from_iterator(other.point.len(), apart);
        let own = share * other.spread.as_ref()?;
        Some(own.row_iter().map(nalgebra::Matrix::into_owned).chain([apart]).collect::<Vec<_>>())
    });
    let spread = rows.collect::<Option<Vec<_>>>().map(|rows| DMatrix::from_rows(&rows.concat()));
    Some(Found { spread, ..found.swap_remove(0) })
}

impl Found {
    /// An unknown of the scene below its least value, and that value.
    fn impossible(&self, data: &FacetData) -> Option<(usize, f64)> {
        let values = &self.point[data.scene().facets().bands()..];
        let below =
            |(n, unknown): (usize, &Unknown)| (values[n] < unknown.least()).then_some((n, unknown.least()));
        data.scene().unknowns().iter().enumerate().find_map(below)
    }

    fn into_estimate(self, data: &FacetData) -> Estimate {
        let bands = data.scene().facets().bands();
        let sd = |column: usize| self.spread.as_ref().map_or(f64::INFINITY, |all| all.column(column).norm());
        let unknowns = data.scene().unknowns().iter().zip(&self.prior_sd).zip(bands..);
        let unknowns = unknowns.map(|((unknown, prior_sd), column)| Fitted {
            quantity: unknown.quantity,
            value: self.point[column],
            sd: sd(column),
            supported: sd(column) < SUPPORTED * prior_sd.abs(),
        });
        let (last, exposure) = (self.point.len() - 1, self.point[self.point.len() - 1]);
        let of_exposure = data.fits_exposure().then(|| Fitted {
            quantity: Quantity::Exposure,
            value: exposure,
            sd: sd(last),
            supported: sd(last) < EXPOSURE_SUPPORTED * exposure,
        });
        Estimate {
            reflectance: self.point[..bands].to_vec(),
            fitted: of_exposure.into_iter().chain(unknowns).collect(),
            spread: self.spread.as_ref().map(|all| all.columns(0, bands).into_owned()),
            exposure,
            residual_rms: self.residual_rms,
            iterations: self.trace.iter().map(|run| run.len() as u32).sum(),
            trace: self.trace,
            termination: self.termination,
        }
    }
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
    Some(Start { class, w, ln_evidence: class.ln_share - 0.5 * (cost + factor.ln_determinant()) })
}

/// Derivatives by logits and unknowns as derivatives by whitened logits and unknowns.
fn whitened(jacobian: &DMatrix<f64>, gaussian: &Gaussian) -> DMatrix<f64> {
    let (bands, coordinates) = gaussian.basis().shape();
    let unknowns = jacobian.ncols() - bands;
    let mut all =
        (jacobian.columns(0, bands) * gaussian.basis()).resize_horizontally(coordinates + unknowns, 0.0);
    all.columns_mut(coordinates, unknowns).copy_from(&jacobian.columns(bands, unknowns));
    all
}

/// The facets as a model of the whitened logit of reflectance, followed by the scene's unknowns.
struct Facets<'a> {
    data: &'a FacetData<'a>,
    gaussian: &'a Gaussian,
}

/// Residuals and the derivatives of the model by logit, then by the scene's unknowns, about a point.
struct ByLogit {
    logit: DVector<f64>,
    unknowns: DVector<f64>,
    residuals: DVector<f64>,
    jacobian: DMatrix<f64>,
    second: Second,
}

/// What second derivatives by logit are made of.
struct Second {
    reflectance: Vec<f64>,
    exposure: FittedExposure,
    by_reflectance: SecondDerivatives,
}

impl Facets<'_> {
    /// Where to set out from a reflectance, the scene being as likely as can be.
    fn from_reflectance(&self, reflectance: &[f64]) -> DVector<f64> {
        self.gaussian.nearest(reflectance).resize_vertically(self.unknowns(), 0.0)
    }

    /// Logits and the scene's unknowns at `w`.
    fn split(&self, w: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let coordinates = self.gaussian.basis().ncols();
        let logit = self.gaussian.logit_at(&w.rows(0, coordinates).into_owned());
        (logit, w.rows(coordinates, w.len() - coordinates).into_owned())
    }

    fn by_logit(&self, w: &DVector<f64>) -> ByLogit {
        let (logit, unknowns) = self.split(w);
        let reflectance: Vec<f64> = logit.iter().map(|z| logistic(*z)).collect();
        let LinearisedFacets { residuals, mut jacobian, mut exposure, second } =
            self.data.linearise(&reflectance, unknowns.as_slice());
        for (band, r) in reflectance.iter().enumerate() {
            jacobian.column_mut(band).scale_mut(r * (1.0 - r));
            exposure.slopes[band] *= r * (1.0 - r);
        }
        let second = Second { reflectance, exposure, by_reflectance: second };
        ByLogit { logit, unknowns, residuals, jacobian, second }
    }

    fn found(&self, solution: &Solution<Second>, ln_evidence: f64) -> Found {
        let (_, unknowns) = self.split(&solution.w);
        let Second { reflectance, exposure, .. } = &solution.at.second;
        let unknowns: Vec<(f64, f64)> =
            self.data.scene().unknowns().iter().zip(&unknowns).map(|(unknown, w)| unknown.at(*w)).collect();
        let prior_sd: Vec<f64> = unknowns.iter().map(|(_, slope)| *slope).collect();
        let values = unknowns.iter().map(|(value, _)| *value);
        Found {
            ln_evidence,
            point: reflectance.iter().copied().chain(values).chain([exposure.value]).collect(),
            spread: self.spread(&prior_sd, solution),
            prior_sd,
            residual_rms: self.data.rms(&solution.at.residuals),
            trace: vec![solution.trace.clone()],
            termination: solution.termination,
        }
    }

    /// Laplace's covariance as a factor, carried from whitened logits to reflectances, unknowns and exposure.
    fn spread(&self, by_unknown: &[f64], solution: &Solution<Second>) -> Option<DMatrix<f64>> {
        let Second { reflectance, exposure, .. } = &solution.at.second;
        let bands = reflectance.len();
        let point = bands + by_unknown.len() + 1;
        // Derivatives of the point by logits and unknowns: point by both.
        let mut slopes = DMatrix::zeros(point, point - 1);
        for (n, r) in reflectance.iter().enumerate() {
            slopes[(n, n)] = r * (1.0 - r);
        }
        for (n, slope) in (bands..).zip(by_unknown) {
            slopes[(n, n)] = *slope;
        }
        slopes.row_mut(point - 1).tr_copy_from(&exposure.slopes);
        // The covariance is S(I + JᵀJ)⁻¹Sᵀ, S the derivatives by what is whitened.
        let information = solution.information()?;
        let spread = information.l().solve_lower_triangular(&whitened(&slopes, self.gaussian).transpose())?;
        let rows = spread.nrows();
        let mut spread = spread.insert_row(rows, 0.0);
        spread[(rows, point - 1)] = exposure.sd;
        Some(spread)
    }
}

impl Model for Facets<'_> {
    type Second = Second;

    fn unknowns(&self) -> usize {
        self.gaussian.basis().ncols() + self.data.scene().unknowns().len()
    }

    fn residuals(&self, w: &DVector<f64>) -> DVector<f64> {
        let (logit, unknowns) = self.split(w);
        let reflectance: Vec<f64> = logit.iter().map(|z| logistic(*z)).collect();
        self.data.residuals(&reflectance, unknowns.as_slice()).residuals
    }

    fn linearise(&self, w: &DVector<f64>) -> Linearised<Second> {
        let ByLogit { residuals, jacobian, second, .. } = self.by_logit(w);
        Linearised { residuals, jacobian: whitened(&jacobian, self.gaussian), second }
    }

    fn curvature(&self, at: &Second, multipliers: &DVector<f64>) -> DMatrix<f64> {
        let Curvature { slopes, reflectance, mut mixed, unknowns } =
            self.data.curvature(&at.by_reflectance, multipliers);
        let basis = self.gaussian.basis();
        let mut weighted = basis.clone();
        // By the chain rule, with dr/dz = r(1 − r) and d²r/dz² = r(1 − r)(1 − 2r); wavebands do not mix.
        for (band, r) in at.reflectance.iter().enumerate() {
            let change = r * (1.0 - r);
            let by_logit = change * (change * reflectance[band] + (1.0 - 2.0 * r) * slopes[band]);
            weighted.row_mut(band).scale_mut(by_logit);
            mixed.row_mut(band).scale_mut(change);
        }
        let (coordinates, count) = (basis.ncols(), unknowns.nrows());
        let mut all = (basis.transpose() * weighted).resize(coordinates + count, coordinates + count, 0.0);
        let mixed = basis.tr_mul(&mixed);
        all.view_mut((0, coordinates), mixed.shape()).copy_from(&mixed);
        all.view_mut((coordinates, 0), (count, coordinates)).tr_copy_from(&mixed);
        all.view_mut((coordinates, coordinates), (count, count)).copy_from(&unknowns);
        all
    }
}
