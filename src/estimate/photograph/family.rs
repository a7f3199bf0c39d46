//! Photographs of one sheet as a family of models.

use nalgebra::{DMatrix, DVector};

use super::hypotheses::Hypothesis;
use super::joint::{JointModel, Member};
use super::model::Point;
use super::parts::Parts;
use super::priors::Priors;
use super::sheet_models::SheetModel;
use super::whitened::Photograph;
use crate::estimate::Fitted;
use crate::estimate::emission::{Fall, UNKNOWNS};
use crate::estimate::family::{Family, SpectrumModel, widened};
use crate::estimate::gaussian::Gaussian;
use crate::estimate::mixture::LocalMode;
use crate::estimate::prior::Prior;
use crate::estimate::search::Search;
use crate::estimate::unknowns::{EXPOSURE, SUPPORTED};
use crate::solve::dense::rms;
use crate::solve::posterior::{Evaluated, Linearised, Model};

/// A mode counts as found within this many standard deviations.
const TOLERANCE: f64 = 0.03;
/// Step of difference quotients, in standard deviations.
const STEP: f64 = 1e-3;

/// Photographs of one sheet.
pub struct Photographs<'a>(pub Vec<Photograph<'a>>);

/// A photograph at a mode.
pub struct Seen {
    /// Exposure.
    pub exposure: f64,
    /// Unknowns of the scene that have an effect.
    pub fitted: Vec<Fitted>,
    /// Whitened residuals of the facets.
    pub residuals: DVector<f64>,
    /// Share of the light left unexplained.
    pub unexplained: f64,
    /// Whitened changes of the facets by displaced corners.
    pub shifts: Vec<DVector<f64>>,
}

impl<'a> Photographs<'a> {
    /// From the parts of each photograph, with errors relative to predicted values rather than to measured
    /// ones, and the point of the prediction; `None` if the facets are not finite.
    pub fn of(parts: &'a [Parts], prior: &Prior) -> Option<(Self, DVector<f64>)> {
        let measured = Self(Photograph::all(parts));
        let first = Hypothesis::usual(SheetModel::Matt);
        let found = Search::new(&measured, prior).sort((first, 0.0), None, f64::NEG_INFINITY)?;
        let model = measured.model(first, prior.broad())?;
        let w = found.solution.w;
        let predicted = model.members.iter().map(|member| member.model.values_at(&member.own(&w)));
        let predicted: Vec<_> = predicted.collect();
        drop(model);
        // a model that is far off predicts nothing
        let relative = |(one, predicted): (Photograph<'a>, DMatrix<f64>)| {
            let values = predicted.zip_map(&one.parts.values, |predicted, value| predicted.max(0.5 * value));
            one.relative_to(values)
        };
        Some((Self(measured.0.into_iter().zip(predicted).map(relative).collect()), w))
    }

    /// The same photograph assumed to be in the light of other parts, which are otherwise the same.
    pub fn in_light_of(&self, parts: &'a Parts) -> Self {
        Self(self.0.iter().map(|photograph| photograph.in_light_of(parts)).collect())
    }

    /// Number of unknowns of the model; `None` if it is not finite.
    pub fn unknowns(&self, hypothesis: Hypothesis, prior: &Prior) -> Option<usize> {
        self.model(hypothesis, prior.broad()).map(|model| model.unknowns())
    }

    /// The priors in use.
    pub fn priors(&self) -> &'static Priors {
        self.0.first().map_or(&Priors::USUAL, |photograph| photograph.parts.stated.priors)
    }

    /// Each photograph at a mode; `None` if the model is not finite.
    pub fn seen(&self, LocalMode { start, at, .. }: &LocalMode<Hypothesis, ()>) -> Option<Vec<Seen>> {
        let model = self.model(start.hypothesis, &start.gaussian)?;
        let lower = model.information(&start.w, at)?;
        let own = lower.solve_lower_triangular(&DMatrix::identity(lower.nrows(), lower.nrows()))?;
        let widened = widened(model.rms(&at.residuals));
        let of = |(member, residuals): (&Member, DVector<f64>)| {
            let w = member.own(&start.w);
            let exposure = member.model.point(&w).exposure;
            let measured = &member.model.parts.values;
            let [scene, ..] = member.model.layout();
            let numbers = member.model.numbers.iter().zip(scene..);
            let fitted = numbers.filter(|(number, _)| number.matters).map(|(number, n)| {
                let (value, _) = number.at(w[n]);
                let value = if number.unknown == &EXPOSURE { exposure } else { value };
                let sd = widened * own.column(member.places[n]).norm();
                Fitted {
                    unknown: number.unknown,
                    value,
                    sd: number.spread(w[n], sd),
                    supported: sd < SUPPORTED,
                }
            });
            Seen {
                exposure,
                fitted: fitted.collect(),
                residuals,
                unexplained: (measured - member.model.values_at(&w)).norm()
                    / measured.norm().max(f64::MIN_POSITIVE),
                shifts: member.model.shifts(),
            }
        };
        Some(model.members.iter().zip(model.each(&at.residuals)).map(of).collect())
    }
}

impl<'a> Family for Photographs<'a> {
    type Hypothesis = Hypothesis;
    type Second = ();
    type Model<'m>
        = JointModel<'m>
    where
        Self: 'm;

    fn model<'m>(&'m self, hypothesis: Hypothesis, gaussian: &'m Gaussian) -> Option<JointModel<'m>> {
        JointModel::new(&self.0, hypothesis, gaussian)
    }

    /// Probabilities are not tempered for computed pictures, which are of known spectra.
    fn ln_class_shares(&self, hypothesis: Hypothesis, prior: &Prior) -> Vec<f64> {
        let is_ideal = hypothesis.imperfection.is_ideal();
        let of_all = prior.ln_shares(if is_ideal { 1.0 } else { self.priors().class_share_power });
        let emissions = self.0.first().map(Photograph::emissions);
        match hypothesis.emission.zip(emissions).and_then(|(place, all)| all.get(place)) {
            Some(emission) => emission.ln_class_shares(of_all, prior),
            None => of_all,
        }
    }

    fn channels(&self) -> usize {
        self.0.iter().map(|photograph| photograph.parts.values.ncols()).max().unwrap_or(0)
    }

    /// Noise of photographs is never so small that classes are distinguished at a larger one.
    fn peak(&self) -> f64 {
        0.0
    }

    fn tolerance(&self) -> f64 {
        TOLERANCE
    }
}

impl SpectrumModel for JointModel<'_> {
    fn gaussian(&self) -> &Gaussian {
        self.first().model.gaussian
    }

    fn by_logit(&self, at: &Linearised<()>) -> DMatrix<f64> {
        let basis = self.gaussian().basis();
        let coordinates_of = basis.tr_mul(basis).cholesky().map(|factor| factor.solve(&basis.transpose()));
        let (coordinates, bands) = (basis.ncols(), basis.nrows());
        let coordinates_of = coordinates_of.unwrap_or_else(|| DMatrix::zeros(coordinates, bands));
        at.jacobian.columns(0, coordinates) * coordinates_of
    }

    /// 45:0 reflectance, then albedo, then emission as a fraction of white.
    fn values(&self, w: &DVector<f64>, _: &Evaluated<Self::Ingredients>) -> Vec<f64> {
        let first = self.first();
        let own = first.own(w);
        let Point { albedo, departure, .. } = first.model.point(&own);
        let [slope, offset] = departure.reflectance;
        let reflectance = albedo.iter().map(|albedo| (slope * albedo + offset).clamp(0.0, 1.0));
        let sent =
            first.model.fraction_sent(&own).map_or_else(|| vec![0.0; albedo.len()], |(f, _)| f.data.into());
        reflectance.chain(albedo.iter().copied()).chain(sent).collect()
    }

    fn spread(&self, w: &DVector<f64>, at: &Linearised<()>) -> Option<DMatrix<f64>> {
        let first = self.first();
        let lower = self.information(w, at)?;
        let point = first.model.point(&first.own(w));
        let slopes = slopes(first, lower.nrows(), &first.own(w), &point);
        let spread = widened(self.rms(&at.residuals)) * lower.solve_lower_triangular(&slopes.transpose())?;
        Some(match first.model.instrument_errors(&point.albedo) {
            Some(errors) => {
                let errors = errors.resize_horizontally(spread.ncols(), 0.0);
                DMatrix::from_rows(&spread.row_iter().chain(errors.row_iter()).collect::<Vec<_>>())
            }
            None => spread,
        })
    }

    fn rms(&self, residuals: &DVector<f64>) -> f64 {
        rms(residuals)
    }

    fn ln_whitening(&self) -> f64 {
        self.members.iter().map(|member| member.model.whitening.ln_determinant()).sum()
    }
}

impl JointModel<'_> {
    /// Derivatives of the 45:0 reflectance by all numbers: waveband by number.
    #[must_use]
    pub fn reflectance_slopes(&self, w: &DVector<f64>) -> DMatrix<f64> {
        let first = self.first();
        let own = first.own(w);
        let point = first.model.point(&own);
        slopes(first, self.unknowns(), &own, &point).rows(0, point.albedo.len()).into_owned()
    }

    /// A factor of the information at a mode, with everything that is [stated](PhotographModel::by_nominal)
    /// about camera and light as additional numbers: an ideal fold is estimated as if the statements were
    /// exact, but its uncertainty is not reduced.
    fn information(&self, w: &DVector<f64>, at: &Linearised<()>) -> Option<DMatrix<f64>> {
        // joined photographs are usual ones, or show no fold
        let stated = match self.members.as_slice() {
            [Member { model, .. }] => model.by_nominal(w),
            _ => None,
        };
        let Some(stated) = stated else { return Some(at.information()?.l()) };
        let columns: Vec<_> = at.jacobian.column_iter().chain(stated.column_iter()).collect();
        Some(Linearised::new(at.residuals.clone(), DMatrix::from_columns(&columns), ()).information()?.l())
    }
}

/// Derivatives of reflectance and albedo by all `unknowns` of photographs of a sheet, where `w` are the
/// numbers of the `first`.
fn slopes(first: &Member, unknowns: usize, w: &DVector<f64>, point: &Point) -> DMatrix<f64> {
    let [scene, sheet, camera, emission, _] = first.model.layout();
    let basis = first.model.gaussian.basis();
    let bands = point.albedo.len();
    let mut slopes = DMatrix::zeros(3 * bands, unknowns);
    if let Some((_, by_number)) = first.model.fraction_sent(w) {
        let mut sent = slopes.rows_mut(2 * bands, bands);
        for (n, column) in by_number.columns(0, UNKNOWNS).column_iter().enumerate() {
            sent.set_column(first.places[emission + n], &column);
        }
        for n in 0..scene {
            let by_spectrum = by_number.column(UNKNOWNS).component_mul(&basis.column(n));
            sent.set_column(first.places[n], &by_spectrum);
        }
    }
    if let Some(Fall { place, sd, falling, .. }) = first.model.fall(w) {
        let place = first.places[emission + place];
        for (band, albedo) in point.albedo.iter().enumerate() {
            let change = albedo * (1.0 - albedo) * sd * falling[band];
            slopes[(band, place)] = point.departure.reflectance[0] * change;
            slopes[(bands + band, place)] = change;
        }
    }
    for (band, albedo) in point.albedo.iter().enumerate() {
        for n in 0..scene {
            let change = albedo * (1.0 - albedo) * basis[(band, n)];
            slopes[(band, first.places[n])] = point.departure.reflectance[0] * change;
            slopes[(bands + band, first.places[n])] = change;
        }
    }
    let numbers = first.model.numbers.iter().zip(scene..);
    let of_sheet = numbers.filter(|(number, _)| number.unknown.is_of_sheet()).map(|(_, n)| n);
    for n in of_sheet.chain(sheet..camera) {
        let mut shifted = w.clone();
        shifted[n] += STEP;
        let moved = first.model.point(&shifted).departure.reflectance;
        let [slope, offset] = [0, 1].map(|k| (moved[k] - point.departure.reflectance[k]) / STEP);
        for (band, albedo) in point.albedo.iter().enumerate() {
            slopes[(band, first.places[n])] = slope * albedo + offset;
        }
    }
    slopes
}
