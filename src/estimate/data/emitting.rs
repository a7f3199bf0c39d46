//! Light that the sheet itself emits, in a sample's data.

use nalgebra::{DMatrix, DVector};

use super::FacetData;
use crate::estimate::Exposure;
use crate::estimate::emission::terms::{ExcitingBounces, Made, made};
use crate::estimate::emission::{Emission, Fall, Sent, UNKNOWNS};
use crate::estimate::family::TELLING_CHANNELS;
use crate::estimate::gaussian::logistic;

/// Emission of the sheet at a point.
pub(super) struct Emitted {
    pub sent: Sent,
    pub exciting: ExcitingBounces,
    pub made: Made,
}

impl FacetData<'_> {
    /// The same data for a sheet that is known not to emit light.
    #[must_use]
    pub fn without_fluorescence(self) -> Self {
        Self { may_fluoresce: false, ..self }
    }

    /// The same data for a sheet that may emit light, with the unknowns of the emission after those of the
    /// scene. `None` if the exposure is determined by sums, a part of the surface is known, or there are too
    /// few channels.
    #[must_use]
    pub fn emitting(&self, emission: &Emission) -> Option<Self> {
        self.may_emit().then(|| Self { emission: Some(emission.clone()), ..self.clone() })
    }

    fn may_emit(&self) -> bool {
        let is_open = self.channels() >= TELLING_CHANNELS && self.exposure != Exposure::Sum;
        self.may_fluoresce && is_open && self.scene.facets().signed_poles().is_some()
    }

    /// Changes of the residuals of a sheet without emission caused by each of these emissions at each of its
    /// [sizes](Emission::sizes), with their probabilities; empty if emission is not considered.
    #[must_use]
    pub fn changes_with(
        &self,
        emissions: &[Emission],
        (logit, reflectance): (&DVector<f64>, &[f64]),
        unknowns: &[f64],
    ) -> Vec<Vec<(f64, DVector<f64>)>> {
        if !self.may_emit() {
            return Vec::new();
        }
        let amounts = self.scene.amounts(unknowns).values();
        let plain = self.in_each_band(reflectance, &amounts);
        let residuals = |values: &DVector<f64>| self.left_over(self.exposure_of(values, || 1.0), values);
        let before = residuals(&plain.0);
        let changes = |emission: &Emission| {
            let usual = [0.0; UNKNOWNS];
            let fallen = emission.fall(&usual).map(|Fall { amount, falling, .. }| {
                let fallen = logit + amount * falling;
                fallen.iter().map(|z| logistic(*z)).collect::<Vec<_>>()
            });
            let own = fallen.as_ref().map(|fallen| self.in_each_band(fallen, &amounts));
            let (values, by_band) = own.as_ref().unwrap_or(&plain);
            let mut sent = emission.usual().clone();
            sent.iter_mut()
                .zip(reflectance)
                .for_each(|(sent, r)| *sent *= r.powi(emission.power_of_reflectance()));
            let emitted = by_band * sent;
            let change = |size: f64| &before - residuals(&(values + size * &emitted));
            emission.sizes().map(|(probability, size)| (probability, change(size))).to_vec()
        };
        emissions.iter().map(changes).collect()
    }

    /// The data for a reflectance, and the changes per waveband for emission equal to white there; bounces of
    /// the exciting light, which change little, are omitted.
    fn in_each_band(&self, reflectance: &[f64], amounts: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let (terms, poles) = (self.scene.facets().terms_of(reflectance), self.signed_poles());
        let emitted = made(reflectance, &terms, &poles, (0, &vec![1.0; poles.len()]));
        (self.channels.parts_of(&terms) * amounts, self.channels.columns_of(&emitted, amounts, 0))
    }

    /// The emission of the sheet with its unknowns; `None` without any.
    pub(super) fn emits<'w>(&self, unknowns: &'w [f64]) -> Option<(&Emission, &'w [f64])> {
        let emission = self.emission.as_ref().filter(|emission| emission.unknowns() > 0)?;
        Some((emission, &unknowns[self.scene.unknowns().len()..]))
    }

    /// The emission of the sheet at a point, given the terms of reflected light and their derivatives; `None`
    /// without any.
    pub(super) fn emitted(
        &self,
        reflectance: &[f64],
        unknowns: &[f64],
        terms: [&DMatrix<f64>; 3],
    ) -> Option<Emitted> {
        let ((emission, w), poles) = (self.emits(unknowns)?, self.signed_poles());
        let exciting = emission.exciting_bounces(&poles, w);
        let made = Made::of(reflectance, terms, &poles, (emission.power_of_reflectance(), &exciting));
        Some(Emitted { sent: emission.at(w), exciting, made })
    }

    /// Signed poles, one per term.
    pub(super) fn signed_poles(&self) -> Vec<f64> {
        self.scene.facets().signed_poles().unwrap_or_default()
    }
}

/// Multiplies each column by a factor.
pub(super) fn scaled_columns(matrix: &DMatrix<f64>, factors: &[f64]) -> DMatrix<f64> {
    let mut scaled = matrix.clone();
    scaled.column_iter_mut().zip(factors).for_each(|(mut column, factor)| column.scale_mut(*factor));
    scaled
}

/// Multiplies each row by a factor.
pub(super) fn scaled_rows(matrix: &DMatrix<f64>, factors: &[f64]) -> DMatrix<f64> {
    let mut scaled = matrix.clone();
    for column in scaled.as_mut_slice().chunks_exact_mut(factors.len().max(1)) {
        column.iter_mut().zip(factors).for_each(|(value, factor)| *value *= factor);
    }
    scaled
}
