//! A photograph of a sheet with known reflectance, used to infer the light.

use nalgebra::{DMatrix, DVector};

use super::conditions::ShownDaylight;
use super::day::Day;
use super::family::Photographs;
use super::hypotheses::Hypothesis;
use super::joint::JointModel;
use super::model::Point;
use crate::estimate::family::{Family, SpectrumModel};
use crate::estimate::prior::Prior;
use crate::estimate::smooth_errors::smooth_errors;
use crate::estimate::unknowns::{Normal, SKY_COLOUR, SUN_COLOUR, Unknown};
use crate::solve::dense::{rms, stacked};
use crate::solve::posterior::{Evaluated, Limits, Linearised, Model, Solution, find_mode, first_tempering};

/// A mode counts as found within this many standard deviations, which changes the log evidence by much less
/// than one. A search ends after this many iterations.
const TOLERANCE: f64 = 0.1;
const LIMIT: usize = 500;
/// Error of each waveband of a known reflectance by itself: half of the last digit that instruments give.
const WHITE_SD: f64 = 5e-4;
/// Minimum probability of a kind of day that a known sheet all but rules out, as a cloud may pass between two
/// photographs: a round number, measured on no photograph.
const OTHER_DAY: f64 = 1e-3;

/// A known reflectance with its errors.
#[derive(Clone, Debug)]
pub struct KnownReflectance {
    reflectance: DVector<f64>,
    /// Whitens its errors.
    whitening: DMatrix<f64>,
}

impl KnownReflectance {
    /// A reflectance with this standard deviation in each waveband, smooth over the wavelengths; `None`
    /// without wavelengths.
    #[must_use]
    pub fn new(wavelengths_nm: &[f64], reflectance: &[f64], sd: &[f64]) -> Option<Self> {
        let errors = smooth_errors(wavelengths_nm, sd)?;
        let mut covariance = errors.tr_mul(&errors);
        (0..covariance.nrows()).for_each(|n| covariance[(n, n)] += WHITE_SD * WHITE_SD);
        let count = reflectance.len();
        let whitening =
            covariance.cholesky()?.l().solve_lower_triangular(&DMatrix::identity(count, count))?;
        Some(Self { reflectance: DVector::from_column_slice(reflectance), whitening })
    }
}

/// Facets and reflectance of a known sheet: the latter adds one datum per waveband.
struct KnownModel<'a> {
    photograph: JointModel<'a>,
    known: &'a KnownReflectance,
}

impl KnownModel<'_> {
    fn point(&self, w: &DVector<f64>) -> Point {
        let first = self.photograph.first();
        first.model.point(&first.own(w))
    }

    fn of_reflectance(&self, w: &DVector<f64>) -> DVector<f64> {
        let Point { albedo, departure, .. } = self.point(w);
        let [slope, offset] = departure.reflectance;
        let reflectance = DVector::from_iterator(albedo.len(), albedo.iter().map(|a| slope * a + offset));
        &self.known.whitening * (&self.known.reflectance - reflectance)
    }
}

impl<'a> Model for KnownModel<'a> {
    type Second = ();
    type Ingredients = Evaluated<<JointModel<'a> as Model>::Ingredients>;

    fn unknowns(&self) -> usize {
        self.photograph.unknowns()
    }

    fn evaluate(&self, w: &DVector<f64>) -> Evaluated<Self::Ingredients> {
        let of_photograph = self.photograph.evaluate(w);
        let residuals = stacked(&of_photograph.residuals, &self.of_reflectance(w));
        Evaluated { residuals, ingredients: of_photograph }
    }

    fn derivatives(&self, w: &DVector<f64>, at: Evaluated<Self::Ingredients>) -> Linearised<()> {
        let Linearised { jacobian, .. } = self.photograph.derivatives(w, at.ingredients);
        let by_reflectance = &self.known.whitening * self.photograph.reflectance_slopes(w);
        let (facets, bands) = (jacobian.nrows(), by_reflectance.nrows());
        let mut jacobian = jacobian.resize_vertically(facets + bands, 0.0);
        jacobian.rows_mut(facets, bands).copy_from(&by_reflectance);
        Linearised::new(at.residuals, jacobian, ())
    }
}

/// A photograph of a known sheet on a kind of day.
pub struct KnownSeen {
    /// Log evidence of its facets, up to a term common to all lights.
    pub ln_evidence: f64,
    /// The end of its search.
    pub w: DVector<f64>,
    /// Reciprocal colour temperatures of sun and sky, 1e-6/K, where they are unknown.
    sun: Option<Normal>,
    sky: Option<Normal>,
    /// Root mean square residual of its facets, relative to the expected error.
    pub rms: f64,
}

impl Photographs<'_> {
    /// Treats the photograph as one of a known sheet, starting from `start` if it has the right length;
    /// `None` if the evidence is below `ln_least`.
    pub fn known(
        &self,
        day: Day,
        prior: &Prior,
        known: &KnownReflectance,
        start: Option<&DVector<f64>>,
        ln_least: f64,
    ) -> Option<KnownSeen> {
        let hypothesis = Hypothesis::of_family(day);
        let photograph = self.model(hypothesis, prior.broad())?;
        let ln_whitening = photograph.ln_whitening();
        let model = KnownModel { photograph, known };
        let at_mean =
            || prior.broad().nearest(known.reflectance.as_slice()).resize_vertically(model.unknowns(), 0.0);
        let start = start.filter(|w| w.len() == model.unknowns()).cloned().unwrap_or_else(at_mean);
        let first = first_tempering(&model, &start, 1.0);
        let limits = Limits { iterations: LIMIT, ln_evidence: ln_least - ln_whitening };
        let found = find_mode(&model, start, (first, 1.0), TOLERANCE, limits);
        let ln_evidence = found.ln_evidence(1.0)? + ln_whitening;
        if !(ln_evidence.is_finite() && ln_evidence >= ln_least) {
            return None;
        }
        let Solution { w, at, .. } = found;
        let lower = at.information()?.l();
        let own = lower.solve_lower_triangular(&DMatrix::identity(lower.nrows(), lower.nrows()))?;
        let facets = model.photograph.first().model.parts.values.len();
        let rms = rms(&at.residuals.rows(0, facets).into_owned());
        let mired = |unknown: &Unknown| {
            let first = &model.photograph.first();
            let [scene, ..] = first.model.layout();
            let numbers = &first.model.numbers;
            let n = numbers.iter().position(|one| one.unknown == unknown && one.matters)?;
            let place = first.places[scene + n];
            let (cct_k, slope) = numbers[n].at(w[place]);
            let sd = rms.max(1.0) * own.column(place).norm() * slope.abs() * 1e6 / (cct_k * cct_k);
            Some(Normal { mean: 1e6 / cct_k, sd })
        };
        Some(KnownSeen { ln_evidence, sun: mired(&SUN_COLOUR), sky: mired(&SKY_COLOUR), rms, w })
    }
}

/// Daylight inferred from a known sheet, for the given kinds of day with their probabilities and results.
#[must_use]
pub fn shown_daylight(days: &[(Day, f64, KnownSeen)]) -> Option<ShownDaylight> {
    let most =
        days.iter().map(|(_, share, seen)| share.ln() + seen.ln_evidence).fold(f64::NEG_INFINITY, f64::max);
    let mut shown = ShownDaylight { shares: [0.0; 4], sun: [None; 4], sky: [None; 4] };
    for (day, share, seen) in days {
        let n = *day as usize;
        shown.shares[n] = (share.ln() + seen.ln_evidence - most).exp();
        (shown.sun[n], shown.sky[n]) = (seen.sun, seen.sky);
    }
    let sum: f64 = shown.shares.iter().sum();
    shown.shares = shown.shares.map(|share| (share / sum).max(OTHER_DAY));
    (sum.is_finite() && sum > 0.0).then_some(shown)
}
