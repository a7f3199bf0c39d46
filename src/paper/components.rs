//! Flat sheets: there are no bounces, so colour is linear in reflectance, and a spectrum must be a
//! combination of a few components.
//!
//! Common parts of [`super::park`] and [`super::khan`], which differ in the components.

use argmin::core::{CostFunction, Error as SolverError, Executor, Gradient, Hessian, State};
use nalgebra::{Cholesky, DMatrix, DVector};

use super::interior_point::InteriorPoint;
use super::smooth::{ITERATION_LIMIT, ended, second_difference_gram};
use crate::error::{Error, Result, counted};
use crate::estimate::measured::{Measured, usable_facets};
use crate::estimate::{Estimate, Exposure};
use crate::forward::FacetModel;
use crate::solve::Eigen;

/// Just above rounding: where colour hardly determines a spectrum, the remaining barrier shifts it by a
/// million times this.
const TOLERANCE: f64 = 2e-15;
/// Eigenvalues below this fraction of the largest are rounding errors: the set has no such component.
const ROUNDING: f64 = 1e-13;
/// Peak of a spectrum whose scale the colour does not determine: the middle of the range of reflectances.
const OPEN_PEAK: f64 = 0.5;
/// Mean reflectance at which such a spectrum is computed: far enough from the upper bound.
const OPEN_MEAN: f64 = 0.02;
/// A direction of the components determined less well than this, relative to the best, is undetermined.
const KNOWN: f64 = 1e-7;

/// The colour of a flat sheet.
#[derive(Clone, Debug)]
pub struct FlatSheet {
    /// Weights of wavebands in channels at exposure 1: channel by waveband.
    pub view: DMatrix<f64>,
    /// Value per channel.
    pub values: Vec<f64>,
    /// Value of a perfect white diffuser facing the sun, in its strongest channel; if unknown, values are
    /// divided by their sum, as in the paper for pictures without a chart (section 5D), and the scale of the
    /// spectrum is undetermined.
    pub exposure: Option<f64>,
}

impl FlatSheet {
    /// The mean colour of the facets of a sample.
    ///
    /// # Errors
    /// [`Error::Field`] if facets or channels do not match the scene, the sheet is folded, or the exposure is
    /// to be fitted.
    pub fn new(model: &FacetModel, measured: &Measured, exposure: Exposure) -> Result<Self> {
        let exposure = match exposure {
            Exposure::Known(exposure) => Some(exposure),
            Exposure::Sum => None,
            Exposure::Free | Exposure::Expected(_) => {
                let problem = "unknown, and a flat sheet does not reveal it; give --exposure X or sum";
                return Err(Error::field("exposure", problem));
            }
        };
        let usable = usable_facets(model, measured)?;
        let view = model.without_bounces(&usable).ok_or_else(|| {
            let problem = "the sheet is folded, but this method ignores bounces; use vkernel --angle-deg 180";
            Error::field("geometry.angle_deg", problem)
        })?;
        let facets: Vec<_> = usable.iter().filter_map(|facet| measured.rgb.facet(*facet)).collect();
        let mean = |channel: usize| facets.iter().map(|rgb| rgb[channel]).sum::<f64>() / facets.len() as f64;
        Ok(Self { values: (0..view.nrows()).map(mean).collect(), view, exposure })
    }

    /// An exposure for computing the spectrum.
    fn trial_exposure(&self) -> f64 {
        let bright = || self.values.iter().sum::<f64>() / (OPEN_MEAN * self.view.sum());
        self.exposure.unwrap_or_else(bright)
    }
}

/// `Σ rrᵀ / n` of n spectra: waveband by waveband. The mean is not subtracted.
#[must_use]
pub fn autocorrelation(spectra: &[Vec<f64>]) -> DMatrix<f64> {
    let columns: Vec<_> = spectra.iter().map(|spectrum| DVector::from_column_slice(spectrum)).collect();
    let all = DMatrix::from_columns(&columns);
    &all * all.transpose() / spectra.len() as f64
}

/// Spectra of which a reflectance is a linear combination, one per column.
pub struct Components(DMatrix<f64>);

impl Components {
    /// Applies `spectrum` to the `count` largest eigenvalues. Sets, cameras and lights have no negative
    /// numbers, so the first component has one sign (Perron and Frobenius): here it is positive.
    ///
    /// # Errors
    /// [`Error::Numeric`] if there are fewer components, or if the first one has a zero.
    pub fn leading(
        eigen: Eigen,
        count: usize,
        spectrum: impl Fn(&Eigen, usize) -> DVector<f64>,
    ) -> Result<Self> {
        let mut order: Vec<usize> = (0..eigen.values.len()).collect();
        order.sort_by(|a, b| eigen.values[*b].total_cmp(&eigen.values[*a]));
        let least = ROUNDING * order.first().map_or(0.0, |first| eigen.values[*first]);
        order.retain(|k| eigen.values[*k] > least);
        if order.len() < count || count == 0 {
            let (count, has) = (counted(count, "component"), order.len());
            return Err(Error::Numeric(format!(
                "{count} requested, but set, camera and lights have {has}; \
                 give --components {has} or fewer"
            )));
        }
        let columns: Vec<_> = order[..count].iter().map(|k| spectrum(&eigen, *k)).collect();
        let mut components = DMatrix::from_columns(&columns);
        if components.column(0).sum() < 0.0 {
            components.neg_mut();
        }
        if components.column(0).min() <= 0.0 {
            let problem = "all spectra of the basis are zero at a wavelength; leave it out or change --basis";
            return Err(Error::Numeric(problem.to_owned()));
        }
        Ok(Self(components))
    }

    /// A grey within the bounds, as nearly as the first component permits.
    fn grey(&self) -> DVector<f64> {
        let mut start = DVector::zeros(self.0.ncols());
        start[0] = 0.5 / self.0.column(0).max();
        start
    }
}

/// The combination between 0 and 1 that minimises the squared distance to the sheet's values, white being 1,
/// plus `smoothness` times its squared second differences.
///
/// # Errors
/// [`Error::Numeric`] if values and smoothness leave a component undetermined, or the solver fails.
pub fn estimate(components: &Components, sheet: &FlatSheet, smoothness: f64) -> Result<Estimate> {
    let exposure = sheet.trial_exposure();
    let space = Space::of(components, sheet, exposure, smoothness)?;
    let solver = InteriorPoint::new(0.0, 1.0, TOLERANCE).on_combinations(space.spectra.clone());
    let run = Executor::new(Distance(space.free), solver)
        .configure(|state| state.param(space.start).max_iters(ITERATION_LIMIT))
        .timer(false)
        .run()
        .map_err(|e| Error::Numeric(format!("interior point: {e}")))?;
    let state = run.state();
    let point =
        state.get_best_param().ok_or_else(|| Error::Numeric("interior point: no iterate".to_owned()))?;
    let reflectance = &space.spectra * point;
    let residuals = DVector::from_column_slice(&sheet.values) - exposure * &sheet.view * &reflectance;
    let scale = sheet.exposure.map_or(OPEN_PEAK / reflectance.max(), |_| 1.0);
    let norm = residuals.norm();
    let left =
        (norm / (residuals.len() as f64).sqrt(), norm / DVector::from_column_slice(&sheet.values).norm());
    let reflectance = (scale * reflectance).as_slice().to_vec();
    Ok(Estimate::of(reflectance, exposure / scale, left, ended(state, run.solver())))
}

/// Combinations of components, in coordinates in which `|ρ/e − Pr|² + α|Dr|²` is a squared distance: the
/// problem is perfectly conditioned.
struct Space {
    /// Spectrum of each coordinate: waveband by coordinate.
    spectra: DMatrix<f64>,
    /// The unconstrained minimum of the objective.
    free: DVector<f64>,
    /// A point within the bounds.
    start: DVector<f64>,
}

impl Space {
    fn of(components: &Components, sheet: &FlatSheet, exposure: f64, smoothness: f64) -> Result<Self> {
        let Components(basis) = components;
        let seen = &sheet.view * basis;
        let rough = basis.tr_mul(&(second_difference_gram(basis.nrows()) * basis));
        let factor = Cholesky::new(seen.tr_mul(&seen) + smoothness * rough).map(|factor| factor.l());
        let known = |factor: &DMatrix<f64>| factor.diagonal().min() > KNOWN * factor.diagonal().max();
        let factor = factor.filter(known).ok_or_else(|| {
            let count = counted(basis.ncols(), "component");
            Error::Numeric(format!("the values do not determine {count}; give fewer, or --smoothness"))
        })?;
        let values = DVector::from_column_slice(&sheet.values) / exposure;
        let (mut spectra, mut free) = (basis.transpose(), seen.tr_mul(&values));
        let start = factor.tr_mul(&components.grey());
        if factor.solve_lower_triangular_mut(&mut spectra) && factor.solve_lower_triangular_mut(&mut free) {
            Ok(Self { spectra: spectra.transpose(), free, start })
        } else {
            Err(Error::Numeric("the components of the basis are not independent".to_owned()))
        }
    }
}

/// Squared distance to a point.
struct Distance(DVector<f64>);

impl CostFunction for Distance {
    type Param = DVector<f64>;
    type Output = f64;

    fn cost(&self, x: &DVector<f64>) -> std::result::Result<f64, SolverError> {
        Ok((x - &self.0).norm_squared())
    }
}

impl Gradient for Distance {
    type Param = DVector<f64>;
    type Gradient = DVector<f64>;

    fn gradient(&self, x: &DVector<f64>) -> std::result::Result<DVector<f64>, SolverError> {
        Ok(2.0 * (x - &self.0))
    }
}

impl Hessian for Distance {
    type Param = DVector<f64>;
    type Hessian = DMatrix<f64>;

    fn hessian(&self, x: &DVector<f64>) -> std::result::Result<DMatrix<f64>, SolverError> {
        Ok(2.0 * DMatrix::identity(x.len(), x.len()))
    }
}
