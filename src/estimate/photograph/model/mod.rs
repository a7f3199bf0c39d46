//! The facets of a photograph as a model of standard normal numbers: those of the spectrum of the sheet's
//! albedo, the unknowns of the scene, the variations of a sheet model, and the errors of the camera's
//! sensitivities.

mod derivatives;
mod emission;

use nalgebra::{DMatrix, DVector};

use super::chebyshev::{nodes, weights};
use super::conditions::{Conditions, StatedScene};
use super::corners;
use super::day::Day;
use super::error::Whitening;
use super::hypotheses::Hypothesis;
use super::imperfection::Imperfection;
use super::lighting::Lighting;
use super::number::Number;
use super::parts::Parts;
use super::prediction::{Predicted, Predictor, Terms};
use super::sheet_models::{SheetModel, SheetModels};
use super::sheets::{Departure, INSTRUMENT_OWN, SPECULAR_ROUGHNESSES};
use crate::estimate::emission::{Emission, Fall};
use crate::estimate::gaussian::{Gaussian, logistic};
use crate::estimate::smooth_errors::smooth_errors;

/// The model under one hypothesis and one Gaussian of albedos.
pub struct PhotographModel<'a> {
    pub(in crate::estimate::photograph) parts: &'a Parts,
    sheet_models: &'a SheetModels<'a>,
    hypothesis: Hypothesis,
    /// The emission of the sheet; `None` without any.
    emission: Option<&'a Emission>,
    pub(in crate::estimate::photograph) gaussian: &'a Gaussian,
    /// Of its residuals.
    pub(in crate::estimate::photograph) whitening: &'a Whitening,
    /// The stated properties of the photograph that are used.
    stated: StatedScene,
    /// The unknowns of the scene.
    pub numbers: Vec<Number>,
    /// Errors of the camera's sensitivities: waveband by error.
    curve_errors: DMatrix<f64>,
}

/// Facets at a point of the model, with what they are computed from.
pub struct Ingredients<'a> {
    /// Albedo per waveband.
    albedo: Vec<f64>,
    terms: Terms,
    /// Waveband by channel.
    sensitivities: DMatrix<f64>,
    conditions: Conditions,
    /// The sheet's departure from a Lambertian one.
    beyond: Departure,
    facets: Predicted<'a>,
}

/// A point of the model in its own units.
pub struct Point {
    /// Albedo of the sheet per waveband: reflectance for light from all directions into all directions.
    pub albedo: Vec<f64>,
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
            curve_errors: curve_errors(parts),
        }
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
            specular_roughness: SPECULAR_ROUGHNESSES[1],
            body_roughness_deg: 0.0,
            sheen: 0.0,
        };
        let [first, ..] = self.layout();
        for (n, number) in self.numbers.iter().enumerate().filter(|(_, number)| number.matters) {
            (number.unknown.set)(&mut conditions, number.at(w[first + n]).0);
        }
        conditions
    }

    fn reflected_terms(&self, albedo: &[f64]) -> Terms {
        if self.hypothesis.has_bounces() {
            let (values, slopes) = weights(albedo);
            return Terms { values, slopes };
        }
        // in a dark sheet light bounces once. A Lambertian sheet's radiance per unit of albedo is smoother
        // than the radiance itself and stays finite; specular reflection does not vanish with albedo, and
        // only the slope is determined
        let (values, slopes) = weights(&[0.0]);
        let once = if self.hypothesis.imperfection.is_ideal() {
            let nodes = nodes();
            values.component_div(&DMatrix::from_column_slice(nodes.len(), 1, &nodes))
        } else {
            slopes
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
        Point {
            albedo: self.logit(w).iter().map(|z| logistic(*z)).collect(),
            departure: self.departure(w, &conditions),
            exposure: Lighting::new(self.parts, &conditions).exposure(self.parts, &conditions),
        }
    }

    /// The sheet's departure from a Lambertian one at `w`, under the conditions there.
    fn departure(&self, w: &DVector<f64>, conditions: &Conditions) -> Departure {
        let Hypothesis { kind, imperfection, .. } = self.hypothesis;
        let [_, sheet, camera, ..] = self.layout();
        match imperfection {
            Imperfection::Ideal => Departure::none(&self.parts.sun.even),
            _ => self.sheet_models.departure(kind, conditions, &w.as_slice()[sheet..camera]),
        }
    }

    /// The camera's sensitivities with their errors at `w`: waveband by channel.
    fn sensitivities(&self, w: &DVector<f64>) -> DMatrix<f64> {
        let Parts { eye, .. } = self.parts;
        let [_, _, camera, emission, _] = self.layout();
        let mut sensitivities = eye.sensitivities.clone();
        if self.hypothesis.imperfection.is_ideal() {
            return sensitivities;
        }
        for ((channel, error), size) in eye.errors.iter().zip(&w.as_slice()[camera..emission]) {
            let curve = &mut sensitivities.as_mut_slice()[channel * error.len()..];
            curve.iter_mut().zip(error.as_slice()).for_each(|(value, error)| *value += size * error);
        }
        sensitivities
    }

    /// The facets at `w`.
    fn ingredients(&self, w: &DVector<f64>) -> Ingredients<'a> {
        let albedo: Vec<f64> = self.logit(w).iter().map(|z| logistic(*z)).collect();
        let (terms, sensitivities) = (self.terms(w, &albedo), self.sensitivities(w));
        let conditions = self.conditions(w);
        let beyond = self.departure(w, &conditions);
        let predictor = Predictor { parts: self.parts, terms: &terms, sensitivities: &sensitivities };
        let facets = predictor.facets(&conditions, &beyond);
        Ingredients { albedo, terms, sensitivities, conditions, beyond, facets }
    }

    /// Errors of an instrument's reflectance that the facets do not determine: error by waveband; `None` if
    /// there are none.
    #[must_use]
    pub fn instrument_errors(&self, albedo: &[f64]) -> Option<DMatrix<f64>> {
        let own = match self.hypothesis.kind {
            SheetModel::Measured => INSTRUMENT_OWN,
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

    /// Residuals at the point of these ingredients if another camera took the photograph, whose parts are
    /// otherwise the same, with the same errors of its sensitivities.
    #[must_use]
    pub fn residuals_by(
        &self,
        camera: &Parts,
        Ingredients { terms, facets, sensitivities, .. }: &Ingredients,
    ) -> DVector<f64> {
        let sensitivities = &camera.eye.sensitivities + (sensitivities - &self.parts.eye.sensitivities);
        let predictor = Predictor { parts: camera, terms, sensitivities: &sensitivities };
        let left = &self.parts.values - predictor.seen(facets);
        self.whitening.of(&DVector::from_column_slice(left.as_slice()))
    }

    /// The values at `w`: facet by channel.
    #[must_use]
    pub fn values_at(&self, w: &DVector<f64>) -> DMatrix<f64> {
        self.ingredients(w).facets.values
    }
}

/// Errors of the camera's sensitivities, side by side.
fn curve_errors(Parts { eye, .. }: &Parts) -> DMatrix<f64> {
    let errors = eye.errors.iter().flat_map(|(_, error)| error.iter().copied());
    DMatrix::from_iterator(eye.wavelengths_nm.len(), eye.errors.len(), errors)
}
