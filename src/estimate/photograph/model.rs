//! The facets of a photograph as a model of standard normal numbers: those behind the spectrum of the sheet's albedo, the unknowns
//! of the scene, the variations of a kind of sheet, and the errors of the camera's curves.

use std::borrow::Cow;

use nalgebra::{DMatrix, DVector};

use super::chebyshev::{chebyshev, nodes};
use super::conditions::{Conditions, Daylight};
use super::kinds::{Kind, Kinds};
use super::parts::{Ambient, Parts, Radiance};
use super::sheets::Departure;
use crate::estimate::gaussian::{Gaussian, logistic};
use crate::estimate::unknowns::{Expected, TABLE, Unknown};
use crate::solve::posterior::{Linearised, Model};

/// Step of the difference quotients by unknowns of the scene, in standard deviations.
const STEP: f64 = 1e-3;
/// Over so many nanometres what an instrument says is off alike.
const INSTRUMENT_NM: f64 = 60.0;
/// Of a value that is compared with a measured one, the least share of the brightest.
const DARKEST: f64 = 1e-6;

/// Values of the terms for a spectrum of albedo: functions of albedo that are 1 at one node and 0 at the others.
#[derive(Clone, Debug)]
struct Terms {
    /// Waveband by node.
    values: DMatrix<f64>,
    /// Their derivatives by albedo, node by waveband.
    slopes: DMatrix<f64>,
}

/// Facets as they are predicted, with what they are made of.
struct Predicted<'a> {
    /// Facet by channel.
    values: DMatrix<f64>,
    lens: Lens,
    /// Radiances and weights (channel by waveband) of the lights.
    lights: Vec<(Cow<'a, Radiance>, DMatrix<f64>)>,
}

/// What makes values of radiances.
struct Lens {
    /// Brightness of each facet and channel for radiance and weights of 1: exposure, gains, vignetting.
    scale: DMatrix<f64>,
    /// Share of a channel's mean that is spread over all facets.
    glare: f64,
}

impl Lens {
    /// Values of radiances through the camera's curves: facet by channel.
    fn seen(&self, radiances: &DMatrix<f64>) -> DMatrix<f64> {
        let mut values = radiances.component_mul(&self.scale);
        for mut channel in values.column_iter_mut() {
            let mean = channel.mean();
            channel.add_scalar_mut(self.glare * mean);
        }
        values
    }
}

/// Adds the product of two matrices, the second of few columns, which a general product is slow for.
fn add_product(sum: &mut DMatrix<f64>, a: &DMatrix<f64>, b: &DMatrix<f64>) {
    for (sum, shares) in sum.as_mut_slice().chunks_exact_mut(a.nrows()).zip(b.column_iter()) {
        for (column, share) in a.as_slice().chunks_exact(a.nrows()).zip(&shares) {
            sum.iter_mut().zip(column).for_each(|(sum, value)| *sum += share * value);
        }
    }
}

/// The model under one kind of sheet and one Gaussian of albedos.
pub struct PhotographModel<'a> {
    parts: &'a Parts,
    kinds: &'a Kinds<'a>,
    kind: Kind,
    gaussian: &'a Gaussian,
    whitening: &'a DMatrix<f64>,
    unknowns: Vec<Expected>,
    /// From values at the nodes to Chebyshev coefficients.
    coefficients: DMatrix<f64>,
}

/// A point of the model in its own units.
pub struct Point {
    /// Albedo of the sheet in every waveband: reflectance for light from all directions into all directions.
    pub albedo: Vec<f64>,
    /// Conditions.
    pub conditions: Conditions,
    /// How the sheet departs from a Lambertian one.
    pub departure: Departure,
    /// Exposure: value of a perfect white diffuser that faces the sun, in the sun alone.
    pub exposure: f64,
}

/// Unknowns of a photograph, of which something is known before. Those of a family stay at their priors in a sheet of another kind.
fn unknowns_of(parts: &Parts) -> Vec<Expected> {
    let expected = |unknown: &&'static Unknown| {
        let effect = unknown.photograph.as_ref()?;
        Some(Expected { unknown, prior: (effect.prior)(&parts.told)? })
    };
    TABLE.iter().filter_map(expected).collect()
}

impl<'a> PhotographModel<'a> {
    /// The model; `whitening` makes residuals of all values, channel by channel and in each facet by facet, standard normal.
    #[must_use]
    pub fn new(
        parts: &'a Parts,
        kinds: &'a Kinds,
        kind: Kind,
        gaussian: &'a Gaussian,
        whitening: &'a DMatrix<f64>,
    ) -> Self {
        let count = parts.sun.even.ncols();
        let chebyshev = chebyshev(&nodes(count), count).0;
        let coefficients = chebyshev.try_inverse().unwrap_or_else(|| DMatrix::identity(count, count));
        Self { parts, kinds, kind, gaussian, whitening, unknowns: unknowns_of(parts), coefficients }
    }

    /// The unknowns of the scene.
    #[must_use]
    pub fn scene_unknowns(&self) -> &[Expected] {
        &self.unknowns
    }

    /// Where the unknowns of the scene begin, the variations of the sheet, the errors of the camera, and how many numbers there are.
    #[must_use]
    pub fn layout(&self) -> [usize; 4] {
        let scene = self.gaussian.basis().ncols();
        let sheet = scene + self.unknowns.len();
        let camera = sheet + self.kinds.variation_count();
        [scene, sheet, camera, camera + self.parts.eye.errors.len()]
    }

    /// Conditions at `w`.
    fn conditions(&self, w: &DVector<f64>) -> Conditions {
        let told = &self.parts.told;
        let mut conditions = Conditions {
            exposure: told.exposure_guess,
            gains: [1.0; 2],
            angle_deg: told.angle_deg,
            tilt_deg: told.tilt_deg,
            sun_mired: None,
            sky: 0.0,
            sky_mired: None,
            ground: 0.0,
            ground_redness: 0.0,
            crease_radius: 0.0,
            bow_deg: 0.0,
            bow_difference_deg: 0.0,
            vignetting: 0.0,
            glare: 0.0,
            gloss: 0.0,
            gloss_roughness: 0.42,
            body_roughness_deg: 0.0,
            fuzz: 0.0,
        };
        let [first, ..] = self.layout();
        for (n, expected) in self.unknowns.iter().enumerate() {
            if let Some(effect) = &expected.unknown.photograph {
                (effect.set)(&mut conditions, expected.at(w[first + n]).0);
            }
        }
        conditions
    }

    fn terms(&self, albedo: &[f64]) -> Terms {
        let (values, slopes) = chebyshev(albedo, self.coefficients.nrows());
        Terms { values: (&self.coefficients * values).transpose(), slopes: &self.coefficients * slopes }
    }

    /// Logits of albedo.
    fn logit(&self, w: &DVector<f64>) -> DVector<f64> {
        self.gaussian.logit_at(&w.rows(0, self.gaussian.basis().ncols()).into_owned())
    }

    /// What `w` means.
    #[must_use]
    pub fn point(&self, w: &DVector<f64>) -> Point {
        let conditions = self.conditions(w);
        let [_, sheet, camera, _] = self.layout();
        let variations: Vec<f64> = w.rows(sheet, camera - sheet).iter().copied().collect();
        Point {
            albedo: self.logit(w).iter().map(|z| logistic(*z)).collect(),
            departure: self.kinds.departure(self.kind, &conditions, &variations),
            exposure: self.exposure(&conditions, self.white(&conditions, &self.powers(&conditions)).as_ref()),
            conditions,
        }
    }

    /// Sunlight on the facets, of which a sheet that is not Lambertian sends `beyond` more.
    fn sunlit(&self, conditions: &Conditions, beyond: &Radiance) -> Radiance {
        let sun = &self.parts.sun;
        let (sin, cos) = conditions.tilt_deg.to_radians().sin_cos();
        let mut radiance = cos * &sun.even + sin * &sun.odd;
        sun.angle_deg.add_to(&mut radiance, conditions.angle_deg - self.parts.told.angle_deg);
        sun.crease_radius.add_to(&mut radiance, conditions.crease_radius);
        sun.bow_deg.add_to(&mut radiance, conditions.bow_deg);
        sun.bow_difference_deg.add_to(&mut radiance, conditions.bow_difference_deg);
        radiance + beyond
    }

    /// What the facets have more than those of a Lambertian sheet.
    fn beyond(&self, w: &DVector<f64>) -> Radiance {
        let [_, sheet, camera, _] = self.layout();
        let variations: Vec<f64> = w.rows(sheet, camera - sheet).iter().copied().collect();
        self.kinds.departure(self.kind, &self.conditions(w), &variations).radiance
    }

    /// Powers of sun, sky and ground, the sun giving 1 in the reference channel, the others for an irradiance of 1 by the sky in
    /// that channel and for a reflectance of the ground of 1.
    fn powers(&self, conditions: &Conditions) -> [DVector<f64>; 3] {
        let eye = &self.parts.eye;
        let sun = conditions.sun_mired.zip(self.parts.told.daylight).map_or_else(
            || eye.sun.clone(),
            |(mired, said)| {
                let ratio = Daylight::power(&eye.daylight, mired)
                    .component_div(&Daylight::power(&eye.daylight, said.mired()));
                eye.sun.component_mul(&ratio)
            },
        );
        let sky = conditions
            .sky_mired
            .map_or_else(|| eye.sky.clone(), |mired| Daylight::power(&eye.daylight, mired));
        let white = |power: &DVector<f64>| eye.sensitivities.row(eye.reference).transpose().dot(power);
        let (sun, sky) = (&sun / white(&sun), &sky / white(&sky));
        let redness = |nm: &f64| (1.0 + conditions.ground_redness * (nm - 550.0) / 150.0).max(0.0);
        let ground =
            DVector::from_iterator(sun.len(), eye.wavelengths_nm.iter().map(redness)).component_mul(&sun);
        [sun, sky, ground]
    }

    /// Irradiance by sky and ground of open planes that face them.
    fn ambient(&self, conditions: &Conditions) -> [f64; 2] {
        let sky = conditions.sky.max(0.0);
        [sky, conditions.ground * (self.parts.sun_height + sky)]
    }

    /// What a chart or a card that faces the sun receives in light of these powers, channel by channel, the light of the sun as it was said
    /// being 1; none if there is neither.
    fn white(&self, conditions: &Conditions, [sun, sky, ground]: &[DVector<f64>; 3]) -> Option<DVector<f64>> {
        let (parts, [sky_amount, ground_amount]) = (self.parts, self.ambient(conditions));
        let eye = &parts.eye;
        parts.told.by_chart.then(|| {
            let said = &eye.sensitivities * &eye.sun;
            let said = &said / said[eye.reference];
            let light = sun + sky_amount * parts.sky.open * sky + ground_amount * parts.ground.open * ground;
            (&eye.sensitivities * light).component_div(&said)
        })
    }

    /// The exposure, a chart or card receiving `white`.
    fn exposure(&self, conditions: &Conditions, white: Option<&DVector<f64>>) -> f64 {
        conditions.exposure / white.map_or(1.0, |white| white[self.parts.eye.reference])
    }

    /// The facets of a sheet that sends `beyond` more than a Lambertian one.
    fn predicted(&self, w: &DVector<f64>, terms: &Terms, beyond: &Radiance) -> Predicted<'a> {
        let (parts, conditions) = (self.parts, self.conditions(w));
        let [.., camera, _] = self.layout();
        let mut sensitivities = parts.eye.sensitivities.clone();
        let channels = sensitivities.nrows();
        for ((channel, error), size) in parts.eye.errors.iter().zip(w.rows(camera, w.len() - camera).iter()) {
            for (sensitivity, error) in sensitivities.row_mut(*channel).iter_mut().zip(error.iter()) {
                *sensitivity += size * error;
            }
        }
        let weighted = |amount: f64, power: &DVector<f64>| {
            let mut weights = sensitivities.clone();
            for (weights, power) in weights.as_mut_slice().chunks_exact_mut(channels).zip(power.iter()) {
                weights.iter_mut().for_each(|weight| *weight *= amount * power);
            }
            weights
        };
        let powers = self.powers(&conditions);
        let (white, amounts) = (self.white(&conditions, &powers), self.ambient(&conditions));
        let [sun, sky, ground] = powers;
        let ambient =
            |light: &'a Ambient, amount, power| (Cow::Borrowed(&light.radiance), weighted(amount, power));
        let mut lights = vec![(Cow::Owned(self.sunlit(&conditions, beyond)), weighted(1.0, &sun))];
        if parts.told.daylight.is_some() {
            lights.push(ambient(&parts.sky, amounts[0], &sky));
            lights.push(ambient(&parts.ground, amounts[1], &ground));
        }
        let mut gains = DVector::from_element(channels, 1.0);
        if let Some(white) = &white {
            // a chart makes the channels those of the light that was said, in the light that there is
            gains = white.map(|value| white[parts.eye.reference] / value);
        }
        if gains.len() == 3 {
            gains[0] *= conditions.gains[0];
            gains[2] *= conditions.gains[1];
        }
        let exposure = self.exposure(&conditions, white.as_ref());
        let scale = DMatrix::from_fn(parts.places.len(), channels, |facet, c| {
            exposure * gains[c] * (1.0 - conditions.vignetting * parts.places[facet].off_centre)
        });
        let lens = Lens { scale, glare: conditions.glare };
        let mut radiances = DMatrix::zeros(parts.places.len(), channels);
        for (light, weights) in &lights {
            add_product(&mut radiances, light, &terms.values.tr_mul(&weights.transpose()));
        }
        Predicted { values: lens.seen(&radiances), lens, lights }
    }

    /// Values in the order of residuals, channel by channel, as they are compared.
    fn in_order(values: &DMatrix<f64>) -> DVector<f64> {
        let most = values.max();
        DVector::from_iterator(values.len(), values.iter().map(|value| value.max(DARKEST * most)))
    }

    /// What an instrument says beyond what the facets tell, waveband for waveband: error by waveband, none if nothing.
    #[must_use]
    pub fn instrument_errors(&self, albedo: &[f64]) -> Option<DMatrix<f64>> {
        let wavelengths_nm = &self.parts.eye.wavelengths_nm;
        let own = match self.kind {
            Kind::Measured => self.parts.sheets.instrument.own,
            Kind::Matt | Kind::Family => return None,
        };
        let (first, last) = (wavelengths_nm.first()?, wavelengths_nm.last()?);
        let count = ((last - first) / INSTRUMENT_NM).ceil() as usize + 1;
        let bump = |n: usize, nm: f64| (-((nm - first) / INSTRUMENT_NM - n as f64).powi(2)).exp();
        let all = |nm: f64| (0..count).map(|n| bump(n, nm).powi(2)).sum::<f64>().sqrt();
        Some(DMatrix::from_fn(count, albedo.len(), |n, band| {
            let nm = wavelengths_nm[band];
            own * albedo[band] * bump(n, nm) / all(nm)
        }))
    }

    /// The Gaussian of logits of albedo.
    #[must_use]
    pub fn gaussian(&self) -> &Gaussian {
        self.gaussian
    }

    /// The values that were measured: facet by channel.
    #[must_use]
    pub fn values(&self) -> &DMatrix<f64> {
        &self.parts.values
    }

    /// Residuals before they are whitened: facet by channel.
    #[must_use]
    pub fn left_over(&self, w: &DVector<f64>) -> DMatrix<f64> {
        let albedo: Vec<f64> = self.logit(w).iter().map(|z| logistic(*z)).collect();
        &self.parts.values - self.predicted(w, &self.terms(&albedo), &self.beyond(w)).values
    }
}

impl Model for PhotographModel<'_> {
    type Second = ();

    fn unknowns(&self) -> usize {
        self.layout()[3]
    }

    fn residuals(&self, w: &DVector<f64>) -> DVector<f64> {
        let albedo: Vec<f64> = self.logit(w).iter().map(|z| logistic(*z)).collect();
        let predicted = self.predicted(w, &self.terms(&albedo), &self.beyond(w));
        self.whitening * (Self::in_order(&self.parts.values) - Self::in_order(&predicted.values))
    }

    fn linearise(&self, w: &DVector<f64>) -> Linearised<()> {
        let albedo: Vec<f64> = self.logit(w).iter().map(|z| logistic(*z)).collect();
        let terms = self.terms(&albedo);
        let beyond = self.beyond(w);
        let Predicted { values, lens, lights } = self.predicted(w, &terms, &beyond);
        let ordered = Self::in_order(&values);
        let [scene, sheet, camera, end] = self.layout();
        let mut by_logit = DMatrix::<f64>::zeros(values.len(), albedo.len());
        for (radiance, weights) in &lights {
            let slopes = radiance.as_ref() * &terms.slopes;
            for (band, mut column) in by_logit.column_iter_mut().enumerate() {
                let (slopes, change) = (slopes.column(band), albedo[band] * (1.0 - albedo[band]));
                let of_channels = column.as_mut_slice().chunks_exact_mut(values.nrows());
                for ((entries, scale), weight) in
                    of_channels.zip(lens.scale.column_iter()).zip(weights.column(band).iter())
                {
                    let weight = weight * change;
                    for ((entry, scale), slope) in entries.iter_mut().zip(scale.iter()).zip(slopes.iter()) {
                        *entry += weight * scale * slope;
                    }
                }
            }
        }
        let mut jacobian = DMatrix::zeros(values.len(), end);
        jacobian.columns_mut(0, scene).gemm(1.0, &by_logit, self.gaussian.basis(), 0.0);
        for (n, expected) in (scene..).zip(&self.unknowns) {
            if self.kind.has(expected.unknown) {
                let mut beside = w.clone();
                beside[n] += STEP;
                let moved = if expected.unknown.is_of_sheet() {
                    self.predicted(&beside, &terms, &self.beyond(&beside))
                } else {
                    self.predicted(&beside, &terms, &beyond)
                };
                let moved = Self::in_order(&moved.values);
                jacobian.column_mut(n).copy_from(&((moved - &ordered) / STEP));
            }
        }
        // variations of the sheet and errors of the curves enter in proportion
        let (radiance, weights) = &lights[0];
        let to_channels = terms.values.tr_mul(&weights.transpose());
        for (n, change) in (sheet..).zip(self.kinds.by_variation(self.kind)) {
            let mut radiances = DMatrix::zeros(values.nrows(), values.ncols());
            add_product(&mut radiances, &change, &to_channels);
            jacobian.column_mut(n).copy_from_slice(lens.seen(&radiances).as_slice());
        }
        let given = radiance.as_ref() * terms.values.transpose();
        let [power, ..] = self.powers(&self.conditions(w));
        let errors: Vec<_> =
            self.parts.eye.errors.iter().map(|(_, error)| error.component_mul(&power)).collect();
        if !errors.is_empty() {
            let seen = given * DMatrix::from_columns(&errors);
            for (n, (channel, _)) in self.parts.eye.errors.iter().enumerate() {
                let seen = seen.column(n).component_mul(&lens.scale.column(*channel));
                jacobian.view_mut((channel * seen.len(), camera + n), (seen.len(), 1)).copy_from(&seen);
            }
        }
        Linearised {
            residuals: self.whitening * (Self::in_order(&self.parts.values) - ordered),
            jacobian: self.whitening * jacobian,
            second: (),
        }
    }

    /// Left out: the priors bound the unknowns, and the noise of photographs is no constraint.
    fn curvature(&self, (): &(), _: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::zeros(self.unknowns(), self.unknowns())
    }
}
