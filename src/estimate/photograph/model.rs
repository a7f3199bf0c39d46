//! The facets of a photograph as a model of standard normal numbers: those behind the spectrum of the sheet's albedo, the unknowns
//! of the scene, the variations of a kind of sheet, and the errors of the camera's curves.

use std::borrow::Cow;
use std::slice::ChunksExact;

use nalgebra::{DMatrix, DMatrixViewMut, DVector};
use pulp::Arch;

use super::chebyshev::{chebyshev, nodes};
use super::conditions::Conditions;
use super::error::Whitening;
use super::kinds::{Kind, Kinds};
use super::lens::Lens;
use super::lighting::Lighting;
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
    /// Node by waveband.
    values: DMatrix<f64>,
    /// Their derivatives by albedo, node by waveband.
    slopes: DMatrix<f64>,
}

/// Light on the facets, and what it counts in the channels: waveband by channel.
struct Light<'a> {
    radiance: Cow<'a, Radiance>,
    weights: DMatrix<f64>,
}

/// Facets as they are predicted, with what they are made of.
struct Predicted<'a> {
    /// Facet by channel.
    values: DMatrix<f64>,
    lens: Lens,
    /// The sun's first.
    lights: Vec<Light<'a>>,
}

impl Light<'_> {
    /// Radiance of a light of these weights in the channels, from that at the nodes: node by channel.
    fn to_channels(&self, terms: &Terms) -> DMatrix<f64> {
        let mut to_channels = DMatrix::zeros(terms.values.nrows(), self.weights.ncols());
        add_product(&mut to_channels, &terms.values, &self.weights);
        to_channels
    }
}

/// Columns as slices, over which the compiler makes faster loops than over matrices.
fn columns(matrix: &DMatrix<f64>) -> ChunksExact<'_, f64> {
    matrix.as_slice().chunks_exact(matrix.nrows())
}

/// Adds the product of two matrices, the second of few columns, which a general product is slow for; by the widest vectors there are.
fn add_product(sum: &mut DMatrix<f64>, a: &DMatrix<f64>, b: &DMatrix<f64>) {
    Arch::new().dispatch(|| {
        for (sum, shares) in sum.as_mut_slice().chunks_exact_mut(a.nrows()).zip(columns(b)) {
            for (column, share) in columns(a).zip(shares) {
                sum.iter_mut().zip(column).for_each(|(sum, value)| *sum += share * value);
            }
        }
    });
}

/// The model under one kind of sheet and one Gaussian of albedos.
pub struct PhotographModel<'a> {
    parts: &'a Parts,
    kinds: &'a Kinds<'a>,
    kind: Kind,
    gaussian: &'a Gaussian,
    whitening: &'a Whitening,
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
        whitening: &'a Whitening,
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
        Terms { values: &self.coefficients * values, slopes: &self.coefficients * slopes }
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
            exposure: Lighting::new(self.parts, &conditions).exposure(self.parts, &conditions),
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

    /// How the camera sees with the errors of its curves at `w`: waveband by channel.
    fn sensitivities(&self, w: &DVector<f64>) -> DMatrix<f64> {
        let Parts { eye, .. } = self.parts;
        let [.., camera, _] = self.layout();
        let mut sensitivities = eye.sensitivities.clone();
        for ((channel, error), size) in eye.errors.iter().zip(&w.as_slice()[camera..]) {
            let curve = &mut sensitivities.as_mut_slice()[channel * error.len()..];
            curve.iter_mut().zip(error.as_slice()).for_each(|(value, error)| *value += size * error);
        }
        sensitivities
    }

    /// The facets of a sheet that sends `beyond` more than a Lambertian one, through curves of these sensitivities.
    fn predicted(
        &self,
        w: &DVector<f64>,
        terms: &Terms,
        beyond: &Radiance,
        sensitivities: &DMatrix<f64>,
    ) -> Predicted<'a> {
        let (parts, conditions) = (self.parts, self.conditions(w));
        let lighting = Lighting::new(parts, &conditions);
        let light = |radiance, amount: f64, power: &DVector<f64>| {
            let mut weights = sensitivities.clone();
            for channel in weights.as_mut_slice().chunks_exact_mut(power.len()) {
                channel
                    .iter_mut()
                    .zip(power.as_slice())
                    .for_each(|(weight, power)| *weight *= amount * power);
            }
            Light { radiance, weights }
        };
        let mut lights = vec![light(Cow::Owned(self.sunlit(&conditions, beyond)), 1.0, &lighting.sun)];
        if parts.told.daylight.is_some() {
            let ambient = [&parts.sky, &parts.ground].into_iter().zip(&lighting.ambient);
            lights.extend(ambient.map(|(Ambient { radiance, .. }, (amount, power))| {
                light(Cow::Borrowed(radiance), *amount, power)
            }));
        }
        let lens = Lens::new(parts, &conditions, &lighting);
        let mut radiances = DMatrix::zeros(parts.places.len(), sensitivities.ncols());
        for light in &lights {
            add_product(&mut radiances, &light.radiance, &light.to_channels(terms));
        }
        Predicted { values: lens.seen(radiances), lens, lights }
    }

    /// [`Self::predicted`] from `w` alone.
    fn predicted_at(&self, w: &DVector<f64>) -> Predicted<'a> {
        let albedo: Vec<f64> = self.logit(w).iter().map(|z| logistic(*z)).collect();
        self.predicted(w, &self.terms(&albedo), &self.beyond(w), &self.sensitivities(w))
    }

    /// Sets derivatives of the values by the numbers of the spectrum, `slopes` being those of the terms by albedo: through all lights at once,
    /// whose terms are far fewer than wavebands.
    fn by_spectrum(
        &self,
        out: &mut DMatrixViewMut<f64>,
        albedo: &[f64],
        slopes: &DMatrix<f64>,
        lights: &[Light],
        lens: &Lens,
    ) {
        let ((terms, bands), facets) = (slopes.shape(), lens.scale.nrows());
        let of_channel = lights.len() * terms;
        // Term of a light in a channel by waveband.
        let mut by_logit = DMatrix::zeros(lens.scale.ncols() * of_channel, bands);
        for (band, (mut by_logit, slopes)) in by_logit.column_iter_mut().zip(columns(slopes)).enumerate() {
            let weights = (0..lens.scale.ncols())
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
        for (channel, scale) in lens.scale.column_iter().enumerate() {
            let mut out = out.rows_mut(channel * facets, facets);
            out.gemm(1.0, &radiances, &by_number.rows(channel * of_channel, of_channel), 0.0);
            out.column_iter_mut().for_each(|mut column| column.component_mul_assign(&scale));
        }
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
        &self.parts.values - self.predicted_at(w).values
    }
}

impl Model for PhotographModel<'_> {
    type Second = ();

    fn unknowns(&self) -> usize {
        self.layout()[3]
    }

    fn residuals(&self, w: &DVector<f64>) -> DVector<f64> {
        self.whitening
            .of(&(Self::in_order(&self.parts.values) - Self::in_order(&self.predicted_at(w).values)))
    }

    fn linearise(&self, w: &DVector<f64>) -> Linearised<()> {
        let albedo: Vec<f64> = self.logit(w).iter().map(|z| logistic(*z)).collect();
        let terms = self.terms(&albedo);
        let beyond = self.beyond(w);
        let sensitivities = self.sensitivities(w);
        let Predicted { values, lens, lights } = self.predicted(w, &terms, &beyond, &sensitivities);
        let ordered = Self::in_order(&values);
        let [scene, sheet, camera, end] = self.layout();
        let mut jacobian = DMatrix::zeros(values.len(), end);
        self.by_spectrum(&mut jacobian.columns_mut(0, scene), &albedo, &terms.slopes, &lights, &lens);
        for (n, expected) in (scene..).zip(&self.unknowns) {
            if self.kind.has(expected.unknown) {
                let mut beside = w.clone();
                beside[n] += STEP;
                let moved = if expected.unknown.is_of_sheet() {
                    self.predicted(&beside, &terms, &self.beyond(&beside), &sensitivities)
                } else {
                    self.predicted(&beside, &terms, &beyond, &sensitivities)
                };
                let moved = Self::in_order(&moved.values);
                jacobian.column_mut(n).copy_from(&((moved - &ordered) / STEP));
            }
        }
        // variations of the sheet and errors of the curves enter in proportion
        let to_channels = lights[0].to_channels(&terms);
        for (n, change) in (sheet..).zip(self.kinds.by_variation(self.kind)) {
            let mut radiances = DMatrix::zeros(values.nrows(), values.ncols());
            add_product(&mut radiances, &change, &to_channels);
            jacobian.column_mut(n).copy_from_slice(lens.seen(radiances).as_slice());
        }
        let given = lights[0].radiance.as_ref() * terms.values;
        let power = Lighting::new(self.parts, &self.conditions(w)).sun;
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
            residuals: self.whitening.of(&(Self::in_order(&self.parts.values) - ordered)),
            jacobian: self.whitening.of_all(&jacobian),
            second: (),
        }
    }

    /// Left out: the priors bound the unknowns, and the noise of photographs is no constraint.
    fn curvature(&self, (): &(), _: &DVector<f64>) -> Option<DMatrix<f64>> {
        None
    }
}
