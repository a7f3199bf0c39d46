//! A photograph of a sheet whose reflectance is known, to tell the light by.

use nalgebra::{DMatrix, DVector};

use super::conditions::ShownDaylight;
use super::day::Day;
use super::family::Photographs;
use super::hypotheses::Hypothesis;
use super::joint::JointModel;
use super::model::Point;
use super::sheet_models::SheetModel;
use crate::estimate::family::{Family, SpectrumModel};
use crate::estimate::prior::Prior;
use crate::estimate::smooth_errors::smooth_errors;
use crate::estimate::unknowns::{Normal, SKY_COLOUR, SUN_COLOUR, Unknown};
use crate::solve::posterior::{Limits, Linearised, Model, Solution, find_mode, first_tempering, information};

/// A maximum counts as found within so many standard deviations of it: what is left out is less than one of
/// evidence. A search ends after so many iterations.
const TOLERANCE: f64 = 0.1;
const LIMIT: usize = 500;
/// What each waveband of a known reflectance is off by itself: the last digit in which instruments state it,
/// halved.
const WHITE_SD: f64 = 5e-4;
/// Share of a kind of day that a known sheet all but rules out: a cloud passes between two photographs.
const OTHER_DAY: f64 = 1e-3;

/// A reflectance that is known, and how far it may be off.
#[derive(Clone, Debug)]
pub struct KnownReflectance {
    reflectance: DVector<f64>,
    /// What makes its errors standard normal.
    whitening: DMatrix<f64>,
}

impl KnownReflectance {
    /// One that is off by this standard deviation in each waveband, smoothly over the wavelengths; none
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

/// Facets and reflectance of a known sheet: the latter is one datum more for each waveband.
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

fn stacked(above: &DVector<f64>, below: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(above.len() + below.len(), above.iter().chain(below).copied())
}

impl Model for KnownModel<'_> {
    type Second = ();

    fn unknowns(&self) -> usize {
        self.photograph.unknowns()
    }

    fn residuals(&self, w: &DVector<f64>) -> DVector<f64> {
        stacked(&self.photograph.residuals(w), &self.of_reflectance(w))
    }

    fn linearise(&self, w: &DVector<f64>) -> Linearised<()> {
        let Linearised { residuals, jacobian, .. } = self.photograph.linearise(w);
        let by_reflectance = &self.known.whitening * self.photograph.reflectance_slopes(w);
        let (facets, bands) = (jacobian.nrows(), by_reflectance.nrows());
        let mut jacobian = jacobian.resize_vertically(facets + bands, 0.0);
        jacobian.rows_mut(facets, bands).copy_from(&by_reflectance);
        Linearised { residuals: stacked(&residuals, &self.of_reflectance(w)), jacobian, second: () }
    }

    /// As that of photographs.
    fn curvature(&self, (): &(), _: &DVector<f64>) -> Option<DMatrix<f64>> {
        None
    }
}

/// A photograph of a known sheet on a kind of day.
pub struct KnownSeen {
    /// Logarithm of the probability of its facets, but for a term that is the same in all lights.
    pub ln_evidence: f64,
    /// Where its search ended.
    pub w: DVector<f64>,
    /// Reciprocal colour temperatures of sun and sky, 1e-6/K, where these are unknown.
    sun: Option<Normal>,
    sky: Option<Normal>,
    /// What is left of its facets, in units of what is expected.
    pub rms: f64,
}

impl Photographs<'_> {
    /// The photograph as one of a known sheet, from `start` on if it has as many numbers; none if its
    /// evidence is less than `ln_least`.
    pub fn known(
        &self,
        day: Day,
        prior: &Prior,
        known: &KnownReflectance,
        start: Option<&DVector<f64>>,
        ln_least: f64,
    ) -> Option<KnownSeen> {
        let hypothesis = Hypothesis::on_dull_day(day, SheetModel::Family);
        let photograph = self.model(hypothesis, prior.broad())?;
        let ln_whitening = photograph.ln_whitening();
        let model = KnownModel { photograph, known };
        let at_mean =
            || prior.broad().nearest(known.reflectance.as_slice()).resize_vertically(model.unknowns(), 0.0);
        let start = start.filter(|w| w.len() == model.unknowns()).cloned().unwrap_or_else(at_mean);
        let first = first_tempering(&model, &start, 1.0);
        let limits = Limits { iterations: LIMIT, cost: 2.0 * (ln_whitening - ln_least) };
        let found = find_mode(&model, start, (first, 1.0), TOLERANCE, limits);
        let ln_evidence = found.ln_evidence(1.0)? + ln_whitening;
        if !(ln_evidence.is_finite() && ln_evidence >= ln_least) {
            return None;
        }
        let Solution { w, at, .. } = found;
        let lower = information(&at.jacobian)?.l();
        let own = lower.solve_lower_triangular(&DMatrix::identity(lower.nrows(), lower.nrows()))?;
        let facets = model.photograph.first().model.values().len();
        let rms = at.residuals.rows(0, facets).norm() / (facets as f64).sqrt();
        let mired = |unknown: &Unknown| {
            let first = &model.photograph.first();
            let [scene, ..] = first.model.layout();
            let numbers = first.model.scene_unknowns();
            let n = numbers.iter().position(|one| one.unknown == unknown && one.matters())?;
            let place = first.place(scene + n);
            let (cct_k, slope) = numbers[n].at(w[place]);
            let sd = rms.max(1.0) * own.column(place).norm() * slope.abs() * 1e6 / (cct_k * cct_k);
            Some(Normal { mean: 1e6 / cct_k, sd })
        };
        Some(KnownSeen { ln_evidence, sun: mired(&SUN_COLOUR), sky: mired(&SKY_COLOUR), rms, w })
    }
}

/// What a known sheet shows of daylight, by kinds of days: these with how often they are and what it is on
/// them.
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
