//! Derivatives of the facets of a photograph, which make it a model that the search takes.

use std::borrow::Cow;

use nalgebra::{DMatrix, DMatrixViewMut, DVector};

use super::{Ingredients, PhotographModel};
use crate::estimate::photograph::hypotheses::Hypothesis;
use crate::estimate::photograph::number::Number;
use crate::estimate::photograph::prediction::{Predicted, Predictor};
use crate::estimate::unknowns::Known;
use crate::solve::dense::{add_product, columns};
use crate::solve::posterior::{Evaluated, Linearised, Model};

/// Step of the difference quotients for unknowns of the scene, in standard deviations.
const STEP: f64 = 1e-3;

impl PhotographModel<'_> {
    /// Computes derivatives of the values by the numbers of the spectrum, given the `slopes` of the terms by
    /// albedo: for all lights at once, whose terms are far fewer than wavebands.
    fn by_spectrum(
        &self,
        out: &mut DMatrixViewMut<f64>,
        albedo: &[f64],
        slopes: &DMatrix<f64>,
        Predicted { values, lights, lens, .. }: &Predicted,
    ) {
        let ((terms, bands), (facets, channels)) = (slopes.shape(), values.shape());
        let of_channel = lights.len() * terms;
        // Term of a light in a channel by waveband.
        let mut by_logit = DMatrix::zeros(channels * of_channel, bands);
        for (band, (mut by_logit, slopes)) in by_logit.column_iter_mut().zip(columns(slopes)).enumerate() {
            let weights = (0..channels)
                .flat_map(|channel| lights.iter().map(move |light| light.weights[(band, channel)]));
            let change = albedo[band] * (1.0 - albedo[band]);
            for (out, weight) in by_logit.as_mut_slice().chunks_exact_mut(terms).zip(weights) {
                out.iter_mut().zip(slopes).for_each(|(out, slope)| *out = weight * change * slope);
            }
        }
        let by_number = by_logit * self.gaussian.basis();
        let mut radiances = DMatrix::zeros(facets, of_channel);
        for (light, first) in lights.iter().zip((0..).step_by(terms)) {
            radiances.columns_mut(first, terms).copy_from(light.radiance.as_ref());
        }
        for channel in 0..channels {
            let mut out = out.rows_mut(channel * facets, facets);
            out.gemm(1.0, &radiances, &by_number.rows(channel * of_channel, of_channel), 0.0);
            out.column_iter_mut().for_each(|mut column| lens.see(channel, column.as_mut_slice()));
        }
    }

    /// Computes derivatives of the values by the errors of the camera's sensitivities, each of which affects
    /// one channel.
    fn by_sensitivities(
        &self,
        out: &mut DMatrixViewMut<f64>,
        terms: &DMatrix<f64>,
        Predicted { values, lights, lens, .. }: &Predicted,
    ) {
        let facets = values.nrows();
        let errors = &self.parts.eye.errors;
        let mut seen = DMatrix::zeros(facets, errors.len());
        for light in lights {
            let mut lit = terms.clone();
            for (mut of_band, power) in lit.column_iter_mut().zip(light.power.iter()) {
                of_band *= *power;
            }
            let of_nodes = lit * &self.curve_errors;
            add_product(&mut seen, &light.radiance, &of_nodes);
        }
        for ((mut out, mut seen), (channel, _)) in
            out.column_iter_mut().zip(seen.column_iter_mut()).zip(errors)
        {
            lens.see(*channel, seen.as_mut_slice());
            out.rows_mut(channel * facets, facets).copy_from(&seen);
        }
    }

    /// Derivatives of the residuals by deviations of an ideal fold's camera and daylight from the stated
    /// ones, as between two of a kind: these are not fitted, as facets would determine them with too much
    /// confidence. `None` where they are unknowns.
    #[must_use]
    pub fn by_nominal(&self, w: &DVector<f64>) -> Option<DMatrix<f64>> {
        self.hypothesis.imperfection.is_ideal().then_some(())?;
        let Ingredients { terms, sensitivities, conditions, beyond, facets: here, .. } = self.ingredients(w);
        let predictor = Predictor { parts: self.parts, terms: &terms, sensitivities: &sensitivities };
        let is_nominal =
            |number: &&Number| (number.unknown.known)(&self.stated) == Known::Nominal && !number.matters;
        let numbers: Vec<&Number> = self.numbers.iter().filter(is_nominal).collect();
        let mut by_nominal = DMatrix::zeros(here.values.len(), numbers.len() + self.parts.eye.errors.len());
        for (mut column, number) in by_nominal.column_iter_mut().zip(&numbers) {
            let [at, shifted] = [0.0, STEP].map(|w| {
                let mut conditions = conditions.clone();
                (number.unknown.set)(&mut conditions, number.at(w).0);
                predictor.shifted(&here, &conditions, &beyond, number.unknown.whose)
            });
            column.copy_from(&(in_order(&(shifted - at)) / STEP));
        }
        let sensitivities = self.parts.eye.errors.len();
        self.by_sensitivities(
            &mut by_nominal.columns_mut(numbers.len(), sensitivities),
            &terms.values,
            &here,
        );
        Some(self.whitening.of_all(&by_nominal))
    }
}

/// Values in the order of residuals, channel by channel.
fn in_order(values: &DMatrix<f64>) -> DVector<f64> {
    DVector::from_column_slice(values.as_slice())
}

impl<'a> Model for PhotographModel<'a> {
    type Second = ();
    type Ingredients = Ingredients<'a>;

    fn unknowns(&self) -> usize {
        self.layout()[4]
    }

    fn evaluate(&self, w: &DVector<f64>) -> Evaluated<Ingredients<'a>> {
        let ingredients = self.ingredients(w);
        let residuals = self.whitening.of(&in_order(&(&self.parts.values - &ingredients.facets.values)));
        Evaluated { residuals, ingredients }
    }

    fn derivatives(&self, w: &DVector<f64>, at: Evaluated<Ingredients<'a>>) -> Linearised<()> {
        let Ingredients { albedo, terms, sensitivities, conditions, beyond, facets: here } = at.ingredients;
        let predictor = Predictor { parts: self.parts, terms: &terms, sensitivities: &sensitivities };
        let Predicted { values, lens, lights, .. } = &here;
        let [scene, sheet, camera, emission, end] = self.layout();
        let mut jacobian = DMatrix::zeros(values.len(), end);
        self.by_spectrum(&mut jacobian.columns_mut(0, scene), &albedo, &terms.slopes, &here);
        let Hypothesis { kind, imperfection, .. } = self.hypothesis;
        let telling = |(_, number): &(usize, &Number)| number.matters && kind.has(number.unknown);
        for (n, Number { unknown, .. }) in (scene..).zip(&self.numbers).filter(telling) {
            let mut shifted = w.clone();
            shifted[n] += STEP;
            let conditions = self.conditions(&shifted);
            let beyond = match unknown.is_of_sheet() {
                true => Cow::Owned(self.departure(&shifted, &conditions)),
                false => Cow::Borrowed(&beyond),
            };
            let moved = predictor.shifted(&here, &conditions, &beyond, unknown.whose);
            jacobian.column_mut(n).copy_from(&(in_order(&(moved - values)) / STEP));
        }
        // variations of the sheet and errors of the sensitivities enter linearly
        let sun = &lights[0];
        let variations = self.sheet_models.by_variation(kind, conditions.sun);
        for (n, change) in (sheet..).zip(variations.filter(|_| !imperfection.is_ideal())) {
            let mut radiances = DMatrix::zeros(values.nrows(), values.ncols());
            add_product(&mut radiances, &change, &sun.to_channels);
            jacobian.column_mut(n).copy_from_slice(lens.seen(radiances).as_slice());
        }
        if !imperfection.is_ideal() {
            self.by_sensitivities(&mut jacobian.columns_mut(camera, emission - camera), &terms.values, &here);
        }
        if let Some(by_emission) = self.terms_by_emission(w, &albedo, &terms) {
            for (n, change) in (emission..end).zip(by_emission) {
                jacobian.column_mut(n).copy_from_slice(here.with_terms(&change).as_slice());
            }
        }
        Linearised::new(at.residuals, self.whitening.of_all(&jacobian), ())
    }
}
