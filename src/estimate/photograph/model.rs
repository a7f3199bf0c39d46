//! The facets of a photograph as a model of standard normal numbers: those of the spectrum of the sheet's
//! albedo, the unknowns of the scene, the variations of a sheet model, and the errors of the camera's
//! sensitivities.

use std::borrow::Cow;
use std::ops::AddAssign;

use nalgebra::{DMatrix, DMatrixViewMut, DVector};

use super::chebyshev::{chebyshev, nodes};
use super::conditions::{Conditions, StatedScene};
use super::corners;
use super::day::Day;
use super::error::Whitening;
use super::hypotheses::Hypothesis;
use super::lighting::Lighting;
use super::number::Number;
use super::parts::{Parts, Radiance};
use super::prediction::{Predicted, Predictor, Terms};
use super::sheet_models::{SheetModel, SheetModels};
use super::sheets::Departure;
use crate::estimate::emission::{Emission, Fall, Sent, UNKNOWNS};
use crate::estimate::gaussian::{Gaussian, logistic};
use crate::estimate::smooth_errors::smooth_errors;
use crate::estimate::unknowns::Known;
use crate::solve::dense::{add_product, columns};
use crate::solve::posterior::{Linearised, Model};

/// Step of the difference quotients for unknowns of the scene, in standard deviations.
const STEP: f64 = 1e-3;
/// Albedo below which emission is not distinguished from the reflection of more light: darker sheets hardly
/// light themselves.
const DARKEST: f64 = 0.01;

/// The model under one hypothesis and one Gaussian of albedos.
pub struct PhotographModel<'a> {
    parts: &'a Parts,
    sheet_models: &'a SheetModels<'a>,
    hypothesis: Hypothesis,
    /// The emission of the sheet; `None` without any.
    emission: Option<&'a Emission>,
    gaussian: &'a Gaussian,
    whitening: &'a Whitening,
    /// The stated properties of the photograph that are used.
    stated: StatedScene,
    numbers: Vec<Number>,
    /// Maps values at the nodes to Chebyshev coefficients.
    coefficients: DMatrix<f64>,
    /// Errors of the camera's sensitivities: waveband by error.
    curve_errors: DMatrix<f64>,
}

/// A point of the model in its own units.
pub struct Point {
    /// Albedo of the sheet per waveband: reflectance for light from all directions into all directions.
    pub albedo: Vec<f64>,
    /// Conditions.
    pub conditions: Conditions,
    /// The sheet's departure from a Lambertian one.
    pub departure: Departure,
    /// Exposure: value of a perfect white diffuser facing the sun, in the sun alone.
    pub exposure: f64,
}

impl<'a> PhotographModel<'a> {
    /// The model; `whitening` makes the residuals of all values, ordered by channel and then facet, standard
    /// normal.
    #[must_use]
    pub fn new(
        parts: &'a Parts,
        sheet_models: &'a SheetModels,
        (hypothesis, emission): (Hypothesis, Option<&'a Emission>),
        gaussian: &'a Gaussian,
        whitening: &'a Whitening,
    ) -> Self {
        let count = parts.sun.even.ncols();
        let chebyshev = chebyshev(&nodes(count), count).0;
        let coefficients = chebyshev.try_inverse().unwrap_or_else(|| DMatrix::identity(count, count));
        let stated = hypothesis.stated(&parts.stated);
        Self {
            parts,
            sheet_models,
            hypothesis,
            emission: emission.filter(|emission| emission.unknowns() > 0),
            gaussian,
            whitening,
            stated,
            numbers: Number::all(&stated, hypothesis),
            coefficients,
            curve_errors: curve_errors(parts),
        }
    }

    /// The unknowns of the scene.
    #[must_use]
    pub fn scene_unknowns(&self) -> &[Number] {
        &self.numbers
    }

    /// First indices of the unknowns of the scene, the variations of the sheet, the errors of the camera and
    /// the emission, and the total number of unknowns.
    #[must_use]
    pub fn layout(&self) -> [usize; 5] {
        let scene = self.gaussian.basis().ncols();
        let sheet = scene + self.numbers.len();
        let camera = sheet + self.sheet_models.variation_count();
        let emission = camera + self.parts.eye.errors.len();
        [scene, sheet, camera, emission, emission + self.emission.map_or(0, Emission::unknowns)]
    }

    /// Conditions at `w`.
    fn conditions(&self, w: &DVector<f64>) -> Conditions {
        let (stated, is_ideal) = (&self.stated, self.hypothesis.imperfection.is_ideal());
        let stated_sky = stated.sky_kind.filter(|_| is_ideal);
        let mut conditions = Conditions {
            exposure: stated.exposure.unwrap_or(1.0),
            gains: [1.0; 2],
            angle_deg: stated.angle_deg,
            tilt_deg: stated.tilt_deg,
            sun_mired: None,
            day: stated.day,
            sun: if is_ideal { stated.sun } else { 1.0 },
            sky: match stated.day.has_sun() {
                true if is_ideal => stated.sky_above_horizon(),
                true => 0.0,
                false => 1.0,
            },
            cloud: if stated_sky.map_or(stated.day == Day::Overcast, |sky| sky.is_overcast) {
                1.0
            } else {
                0.0
            },
            elevation_deg: stated_sky.map_or(stated.priors.elevation_deg, |sky| sky.elevation_deg),
            even_sky: if is_ideal { stated.even_sky() } else { 0.0 },
            sky_mired: None,
            ground: 0.0,
            ground_redness: 0.0,
            crease_radius: 0.0,
            bow_deg: 0.0,
            bow_difference_deg: 0.0,
            nearness: 0.0,
            fall_off: 0.0,
            vignetting: 0.0,
            veiling_glare: 0.0,
            specular_weight: 0.0,
            specular_roughness: 0.42,
            body_roughness_deg: 0.0,
            sheen: 0.0,
        };
        let [first, ..] = self.layout();
        for (n, number) in self.numbers.iter().enumerate().filter(|(_, number)| number.matters()) {
            (number.effect.set)(&mut conditions, number.at(w[first + n]).0);
        }
        conditions
    }

    /// The terms for an albedo, including emission: a sheet that emits looks like one that does not in light
    /// that is (1 + f / albedo) times as strong. For light from behind f is proportional to the albedo's
    /// square.
    fn terms(&self, w: &DVector<f64>, albedo: &[f64]) -> Terms {
        let mut terms = self.reflected_terms(albedo);
        if let Some((sent, power)) = self.sent(w) {
            let Terms { values, slopes } = &mut terms;
            for (n, (albedo, f)) in albedo.iter().zip(&sent.fraction).enumerate() {
                let (of_light, slope) = of_albedo(*albedo, *f, power);
                let change = slope * values.column(n);
                slopes.column_mut(n).scale_mut(of_light);
                slopes.column_mut(n).add_assign(&change);
                values.column_mut(n).scale_mut(of_light);
            }
        }
        terms
    }

    /// The emission of the sheet at `w`, and the power of the albedo to which it is proportional; `None`
    /// without any.
    fn sent(&self, w: &DVector<f64>) -> Option<(Sent, i32)> {
        let emission = self.emission?;
        Some((emission.at(self.of_emission(w)), emission.power_of_reflectance()))
    }

    /// The numbers of the emission.
    fn of_emission<'w>(&self, w: &'w DVector<f64>) -> &'w [f64] {
        let [.., emission, end] = self.layout();
        &w.as_slice()[emission..end]
    }

    /// The emission of the sheet at `w` as a fraction of white, and its derivatives by the numbers of the
    /// emission, then by the logit of the albedo: waveband by number. `None` without any.
    #[must_use]
    pub fn fraction_sent(&self, w: &DVector<f64>) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let (Sent { mut fraction, slopes, .. }, power) = self.sent(w)?;
        let mut slopes = slopes.insert_column(UNKNOWNS, 0.0);
        for (band, z) in self.logit(w).iter().enumerate() {
            let albedo = logistic(*z);
            let of_albedo = albedo.powi(power);
            fraction[band] *= of_albedo;
            slopes.row_mut(band).scale_mut(of_albedo);
            slopes[(band, UNKNOWNS)] = f64::from(power) * (1.0 - albedo) * fraction[band];
        }
        Some((fraction, slopes))
    }

    /// The fall of logits towards the wavelengths that excite the sheet, if there is one.
    #[must_use]
    pub fn fall(&self, w: &DVector<f64>) -> Option<Fall<'a>> {
        self.emission?.fall(self.of_emission(w))
    }

    /// Derivatives of the terms by the numbers of the emission, node by waveband; `None` without emission.
    fn terms_by_emission(
        &self,
        w: &DVector<f64>,
        albedo: &[f64],
        terms: &Terms,
    ) -> Option<Vec<DMatrix<f64>>> {
        let (sent, power) = self.sent(w)?;
        let reflected = self.reflected_terms(albedo).values;
        let fall = self.fall(w);
        let by = |(k, slopes): (usize, nalgebra::DVectorView<f64>)| match &fall {
            Some(Fall { place, sd, falling, .. }) if *place == k => {
                let change = |n: usize| albedo[n] * (1.0 - albedo[n]) * sd * falling[n];
                DMatrix::from_fn(reflected.nrows(), albedo.len(), |node, n| {
                    terms.slopes[(node, n)] * change(n)
                })
            }
            _ => DMatrix::from_fn(reflected.nrows(), albedo.len(), |node, n| {
                reflected[(node, n)] * slopes[n] * albedo[n].max(DARKEST).powi(power - 1)
            }),
        };
        Some(sent.slopes.column_iter().enumerate().map(by).collect())
    }

    fn reflected_terms(&self, albedo: &[f64]) -> Terms {
        let count = self.coefficients.nrows();
        if self.hypothesis.has_bounces() {
            let (values, slopes) = chebyshev(albedo, count);
            return Terms { values: &self.coefficients * values, slopes: &self.coefficients * slopes };
        }
        // in a dark sheet light bounces once. A Lambertian sheet's radiance per unit of albedo is smoother
        // than the radiance itself and stays finite; specular reflection does not vanish with albedo, and
        // only the slope is determined
        let (values, slopes) = chebyshev(&[0.0], count);
        let once = if self.hypothesis.imperfection.is_ideal() {
            (&self.coefficients * values).component_div(&DMatrix::from_column_slice(count, 1, &nodes(count)))
        } else {
            &self.coefficients * slopes
        };
        Terms {
            values: &once * DMatrix::from_row_slice(1, albedo.len(), albedo),
            slopes: once * DMatrix::from_element(1, albedo.len(), 1.0),
        }
    }

    /// Logits of albedo.
    fn logit(&self, w: &DVector<f64>) -> DVector<f64> {
        let mut logit = self.gaussian.logit_at(&w.rows(0, self.gaussian.basis().ncols()).into_owned());
        if let Some(Fall { amount, falling, .. }) = self.fall(w) {
            logit.axpy(amount, falling, 1.0);
        }
        logit
    }

    /// The point at `w` in its own units.
    #[must_use]
    pub fn point(&self, w: &DVector<f64>) -> Point {
        let conditions = self.conditions(w);
        let [_, sheet, camera, ..] = self.layout();
        let variations: Vec<f64> = w.rows(sheet, camera - sheet).iter().copied().collect();
        Point {
            albedo: self.logit(w).iter().map(|z| logistic(*z)).collect(),
            departure: self.departure(&conditions, &variations),
            exposure: Lighting::new(self.parts, &conditions).exposure(self.parts, &conditions),
            conditions,
        }
    }

    fn departure(&self, conditions: &Conditions, variations: &[f64]) -> Departure {
        let Hypothesis { kind, imperfection, .. } = self.hypothesis;
        self.sheet_models.departure(kind, imperfection.scale, conditions, variations)
    }

    /// Radiance of the facets minus that of a Lambertian sheet.
    fn beyond(&self, w: &DVector<f64>) -> Radiance {
        let [_, sheet, camera, ..] = self.layout();
        let variations: Vec<f64> = w.rows(sheet, camera - sheet).iter().copied().collect();
        self.departure(&self.conditions(w), &variations).radiance
    }

    /// The camera's sensitivities with their errors at `w`: waveband by channel.
    fn sensitivities(&self, w: &DVector<f64>) -> DMatrix<f64> {
        let Parts { eye, .. } = self.parts;
        let [_, _, camera, emission, _] = self.layout();
        let mut sensitivities = eye.sensitivities.clone();
        for ((channel, error), size) in eye.errors.iter().zip(&w.as_slice()[camera..emission]) {
            let curve = &mut sensitivities.as_mut_slice()[channel * error.len()..];
            curve
                .iter_mut()
                .zip(error.as_slice())
                .for_each(|(value, error)| *value += self.hypothesis.imperfection.scale * size * error);
        }
        sensitivities
    }

    /// The facets at `w`.
    fn predicted(&self, w: &DVector<f64>) -> Predicted<'a> {
        let albedo: Vec<f64> = self.logit(w).iter().map(|z| logistic(*z)).collect();
        let (terms, sensitivities) = (self.terms(w, &albedo), self.sensitivities(w));
        let predictor = Predictor { parts: self.parts, terms: &terms, sensitivities: &sensitivities };
        predictor.facets(&self.conditions(w), &self.beyond(w))
    }

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
        let albedo: Vec<f64> = self.logit(w).iter().map(|z| logistic(*z)).collect();
        let (terms, sensitivities) = (self.terms(w, &albedo), self.sensitivities(w));
        let predictor = Predictor { parts: self.parts, terms: &terms, sensitivities: &sensitivities };
        let (conditions, beyond) = (self.conditions(w), self.beyond(w));
        let here = predictor.facets(&conditions, &beyond);
        let is_nominal =
            |number: &&Number| (number.effect.known)(&self.stated) == Known::Nominal && !number.matters();
        let numbers: Vec<&Number> = self.numbers.iter().filter(is_nominal).collect();
        let mut by_nominal = DMatrix::zeros(here.values.len(), numbers.len() + self.parts.eye.errors.len());
        for (mut column, number) in by_nominal.column_iter_mut().zip(&numbers) {
            let [at, shifted] = [0.0, STEP].map(|w| {
                let mut conditions = conditions.clone();
                (number.effect.set)(&mut conditions, number.at(w).0);
                predictor.shifted(&here, &conditions, &beyond, number.effect.whose)
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

    /// Errors of an instrument's reflectance that the facets do not determine: error by waveband; `None` if
    /// there are none.
    #[must_use]
    pub fn instrument_errors(&self, albedo: &[f64]) -> Option<DMatrix<f64>> {
        let own = match self.hypothesis.kind {
            SheetModel::Measured => self.hypothesis.imperfection.scale * self.parts.sheets.instrument.own,
            SheetModel::Matt | SheetModel::Family => return None,
        };
        let sd: Vec<f64> = albedo.iter().map(|albedo| own * albedo).collect();
        smooth_errors(&self.parts.eye.wavelengths_nm, &sd)
    }

    /// Effects on the residuals of a small shift of each corner.
    #[must_use]
    pub fn shifts(&self) -> Vec<DVector<f64>> {
        let shifts = corners::shifts(&self.parts.places, &self.parts.values);
        shifts.iter().map(|shift| self.whitening.of(shift)).collect()
    }

    /// The whitening of its residuals.
    #[must_use]
    pub fn whitening(&self) -> &Whitening {
        self.whitening
    }

    /// The Gaussian of logits of albedo.
    #[must_use]
    pub fn gaussian(&self) -> &Gaussian {
        self.gaussian
    }

    /// The values at `w`: facet by channel.
    #[must_use]
    pub fn values_at(&self, w: &DVector<f64>) -> DMatrix<f64> {
        self.predicted(w).values
    }

    /// The measured values: facet by channel.
    #[must_use]
    pub fn values(&self) -> &DMatrix<f64> {
        &self.parts.values
    }

    /// Residuals before whitening: facet by channel.
    #[must_use]
    pub fn left_over(&self, w: &DVector<f64>) -> DMatrix<f64> {
        &self.parts.values - self.predicted(w).values
    }
}

/// Errors of the camera's sensitivities, side by side.
fn curve_errors(Parts { eye, .. }: &Parts) -> DMatrix<f64> {
    let errors = eye.errors.iter().flat_map(|(_, error)| error.iter().copied());
    DMatrix::from_iterator(eye.wavelengths_nm.len(), eye.errors.len(), errors)
}

/// Factor by which light seems stronger to a sheet of an albedo that emits a fraction f of white times a
/// power of the albedo, and its derivative by albedo.
fn of_albedo(albedo: f64, f: f64, power: i32) -> (f64, f64) {
    let (from, power) = (albedo.max(DARKEST), power - 1);
    let slope = f64::from(power) * f * from.powi(power - 1);
    (1.0 + f * from.powi(power), if albedo > DARKEST { slope } else { 0.0 })
}

/// Values in the order of residuals, channel by channel.
fn in_order(values: &DMatrix<f64>) -> DVector<f64> {
    DVector::from_column_slice(values.as_slice())
}

impl Model for PhotographModel<'_> {
    type Second = ();

    fn unknowns(&self) -> usize {
        self.layout()[4]
    }

    fn residuals(&self, w: &DVector<f64>) -> DVector<f64> {
        self.whitening.of(&in_order(&self.left_over(w)))
    }

    fn linearise(&self, w: &DVector<f64>) -> Linearised<()> {
        let albedo: Vec<f64> = self.logit(w).iter().map(|z| logistic(*z)).collect();
        let terms = self.terms(w, &albedo);
        let beyond = self.beyond(w);
        let sensitivities = self.sensitivities(w);
        let predictor = Predictor { parts: self.parts, terms: &terms, sensitivities: &sensitivities };
        let conditions = self.conditions(w);
        let here = predictor.facets(&conditions, &beyond);
        let Predicted { values, lens, lights, .. } = &here;
        let [scene, sheet, camera, emission, end] = self.layout();
        let mut jacobian = DMatrix::zeros(values.len(), end);
        self.by_spectrum(&mut jacobian.columns_mut(0, scene), &albedo, &terms.slopes, &here);
        let Hypothesis { kind, imperfection, .. } = self.hypothesis;
        let telling = |(_, number): &(usize, &Number)| number.matters() && kind.has(number.unknown);
        for (n, Number { unknown, effect, .. }) in (scene..).zip(&self.numbers).filter(telling) {
            let mut shifted = w.clone();
            shifted[n] += STEP;
            let beyond = if unknown.is_of_sheet() {
                Cow::Owned(self.beyond(&shifted))
            } else {
                Cow::Borrowed(&beyond)
            };
            let moved = predictor.shifted(&here, &self.conditions(&shifted), &beyond, effect.whose);
            jacobian.column_mut(n).copy_from(&(in_order(&(moved - values)) / STEP));
        }
        // variations of the sheet and errors of the sensitivities enter linearly
        let sun = &lights[0];
        let variations = self.sheet_models.by_variation(kind, imperfection.scale * conditions.sun);
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
        let residuals = self.whitening.of(&in_order(&(&self.parts.values - values)));
        Linearised::new(residuals, self.whitening.of_all(&jacobian), ())
    }

    /// Omitted: the priors bound the unknowns, and the noise of photographs does not act as a constraint.
    fn curvature(&self, (): &(), _: &DVector<f64>) -> Option<DMatrix<f64>> {
        None
    }
}
