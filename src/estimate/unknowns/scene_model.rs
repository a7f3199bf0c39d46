//! A facet model with sources whose amounts depend on unknowns.

use std::sync::{Arc, OnceLock};

use nalgebra::{DMatrix, DVector};

use super::factor::Jet;
use super::{Expectation, Factor, Normal, Role, Unknown};
use crate::camera::CameraResponse;
use crate::estimate::compress::Reach;
use crate::estimate::emission::{Backing, Emission};
use crate::forward::FacetModel;

/// An unknown of a scene, with its prior.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// The unknown.
    pub unknown: &'static Unknown,
    /// Its prior, on its scale.
    pub prior: Expectation,
}

impl Expected {
    /// Value at `w`, a standard normal number, and its derivative, in the unit of the unknown.
    #[must_use]
    pub fn at(self, w: f64) -> (f64, f64) {
        self.prior.value(self.unknown.scale, w)
    }

    /// The bound of its range that `value` exceeds, if any.
    #[must_use]
    pub fn bound_of(self, value: f64) -> Option<f64> {
        let Unknown { role: Role::Sources { range, .. }, scale, .. } = self.unknown else { return None };
        let (least, greatest) = (*range.start(), *range.end());
        let number = |value| scale.normal(value);
        // a negative reciprocal is beyond the greatest value, not the least
        let is_rising = number(least) < number(greatest);
        let (low, high) = if is_rising { (least, greatest) } else { (greatest, least) };
        if number(value) < number(low) { Some(low) } else { (number(value) > number(high)).then_some(high) }
    }
}

/// A facet model with sources whose amounts depend on unknowns.
#[derive(Clone, Debug)]
pub struct SceneModel {
    facets: FacetModel,
    unknowns: Vec<Expected>,
    /// Source by unknown.
    factors: Vec<Vec<Factor>>,
    /// Possible emissions of the sheet in its light, the first of which is none; empty if emission is not
    /// considered.
    emissions: Arc<[Emission]>,
    /// Possible errors of the camera's response, each of one standard deviation and of a channel: share of it
    /// in every waveband.
    camera_errors: Arc<[(usize, DVector<f64>)]>,
    /// How far reflectances can move its facets if all are known equally well, computed on first use.
    reach: OnceLock<Arc<Reach>>,
}

impl SceneModel {
    /// A scene in which only the spectrum is unknown.
    #[must_use]
    pub fn known(facets: FacetModel) -> Self {
        let factors = vec![Vec::new(); facets.sources().len()];
        Self::new(facets, Vec::new(), factors)
    }

    /// A scene with unknowns: `factors` has a row per source of `facets`, with one factor per unknown.
    #[must_use]
    pub fn new(facets: FacetModel, unknowns: Vec<Expected>, factors: Vec<Vec<Factor>>) -> Self {
        Self {
            facets,
            unknowns,
            factors,
            emissions: Arc::default(),
            camera_errors: Arc::default(),
            reach: OnceLock::new(),
        }
    }

    /// The same scene with a sheet, backed so, that may emit light itself under light of this relative power.
    #[must_use]
    pub fn under(self, wavelengths_nm: &[f64], power: &[f64], backing: Backing) -> Self {
        Self { emissions: Emission::all(wavelengths_nm, power, backing).into(), ..self }
    }

    /// The same scene seen by a camera with these possible errors, each of one standard deviation and of a
    /// channel: share of its response in every waveband.
    #[must_use]
    pub fn seen_with(self, errors: Vec<(usize, DVector<f64>)>) -> Self {
        Self { camera_errors: errors.into(), ..self }
    }

    /// Possible errors of the camera's response, as given to [`Self::seen_with`].
    #[must_use]
    pub fn camera_errors(&self) -> &[(usize, DVector<f64>)] {
        &self.camera_errors
    }

    /// Possible emissions of the sheet, the first of which is none; empty if emission is not considered.
    #[must_use]
    pub fn emissions(&self) -> &[Emission] {
        &self.emissions
    }

    /// The model with every source in the amount 1.
    #[must_use]
    pub fn facets(&self) -> &FacetModel {
        &self.facets
    }

    /// How far reflectances can move its facets if all are known equally well.
    pub(in crate::estimate) fn reach(&self) -> &Reach {
        self.reach.get_or_init(|| {
            let sources: Vec<_> = self.facets.sources().iter().map(|source| &source.facets).collect();
            Arc::new(Reach::of(&self.facets, &sources))
        })
    }

    /// The unknowns.
    #[must_use]
    pub fn unknowns(&self) -> &[Expected] {
        &self.unknowns
    }

    /// The same scene with another light in place of that of every source, given the camera's response to it.
    #[must_use]
    pub fn in_light(&self, camera: &CameraResponse) -> Self {
        let Self { facets, unknowns, factors, camera_errors, .. } = self;
        let scene = Self::new(facets.in_light(camera), unknowns.clone(), factors.clone());
        Self { camera_errors: camera_errors.clone(), ..scene }
    }

    /// The same scene with one unknown fixed at this value.
    #[must_use]
    pub fn with_known(mut self, unknown: usize, value: f64) -> Self {
        let Expected { unknown, prior } = &mut self.unknowns[unknown];
        *prior = Normal { mean: unknown.scale.normal(value), sd: 0.0 }.into();
        self
    }

    /// The model with its unknowns at their `found` values, in their units, or at their prior means if there
    /// are none.
    #[must_use]
    pub fn with_fitted(&self, found: impl Fn(&Unknown) -> Option<f64>) -> FacetModel {
        let number =
            |one: &Expected| one.unknown.scale.normal(found(one.unknown).unwrap_or_else(|| one.at(0.0).0));
        let numbers: Vec<f64> = self.unknowns.iter().map(number).collect();
        let amount = |factors: &Vec<Factor>| {
            factors.iter().zip(&numbers).map(|(factor, number)| factor.at(*number)[0]).product()
        };
        self.facets.in_amounts(&self.factors.iter().map(amount).collect::<Vec<f64>>())
    }

    /// Amounts of the sources at `w`, one standard normal number per unknown.
    #[must_use]
    pub fn amounts(&self, w: &[f64]) -> Amounts {
        let jet = |factor: &Factor, expected: &Expected, w: f64| {
            let [number, by_w, bend] = expected.prior.number(w);
            let [value, slope, curvature] = factor.at(number);
            [value, by_w * slope, by_w * by_w * curvature + bend * slope]
        };
        let jets = |factors: &Vec<Factor>| {
            factors
                .iter()
                .zip(&self.unknowns)
                .zip(w)
                .map(|((factor, expected), w)| jet(factor, expected, *w))
                .collect()
        };
        Amounts { jets: self.factors.iter().map(jets).collect(), unknowns: self.unknowns.len() }
    }
}

/// Amounts of the sources near a point, as factors with their derivatives: source by unknown.
pub struct Amounts {
    jets: Vec<Vec<Jet>>,
    unknowns: usize,
}

impl Amounts {
    /// Amount of every source.
    #[must_use]
    pub fn values(&self) -> DVector<f64> {
        self.derivative(&[])
    }

    /// Derivatives of the amounts: source by unknown.
    #[must_use]
    pub fn slopes(&self) -> DMatrix<f64> {
        let columns: Vec<_> = (0..self.unknowns).map(|p| self.derivative(&[p])).collect();
        if columns.is_empty() { DMatrix::zeros(self.jets.len(), 0) } else { DMatrix::from_columns(&columns) }
    }

    /// Second derivatives of `Σ weightᵢ amountᵢ`: unknown by unknown.
    #[must_use]
    pub fn curvature(&self, weights: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::from_fn(self.unknowns, self.unknowns, |p, q| self.derivative(&[p, q]).dot(weights))
    }

    /// The amounts differentiated by each unknown of `by` in turn.
    fn derivative(&self, by: &[usize]) -> DVector<f64> {
        let order = |p: usize| by.iter().filter(|q| **q == p).count();
        let product = |jets: &Vec<Jet>| jets.iter().enumerate().map(|(p, jet)| jet[order(p)]).product();
        DVector::from_iterator(self.jets.len(), self.jets.iter().map(product))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::unknowns::{SKY, SKY_COLOUR};

    /// Skies bluer than any real one have a negative reciprocal temperature.
    #[test]
    fn bounds_are_those_that_were_passed() {
        let colour = Expected { unknown: &SKY_COLOUR, prior: Normal { mean: 100.0, sd: 30.0 }.into() };
        let bound = |mired: f64| colour.bound_of(1e6 / mired);
        assert_eq!([-20.0, 5.0, 100.0, 2000.0].map(bound), [Some(1e5), Some(1e5), None, Some(1e3)]);
        let sky = Expected { unknown: &SKY, prior: Normal { mean: 0.0, sd: 0.25 }.into() };
        assert_eq!([-0.1, 0.0, 3.0].map(|amount| sky.bound_of(amount)), [Some(0.0), None, None]);
    }

    #[test]
    fn a_temperature_is_the_reciprocal_of_its_normal_number() {
        let colour = Expected { unknown: &SKY_COLOUR, prior: Normal { mean: 100.0, sd: 30.0 }.into() };
        let (cct_k, slope) = colour.at(1.0);
        assert!((cct_k - 1e6 / 130.0).abs() < 1e-9);
        assert!((slope - (colour.at(1.0 + 1e-5).0 - colour.at(1.0 - 1e-5).0) / 2e-5).abs() < 1e-3);
    }
}
