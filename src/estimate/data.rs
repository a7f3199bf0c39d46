//! Facet RGB as data to fit, compressed to what exceeds the noise.
//!
//! All facets combine the same few terms of the reflectance, so hundreds of facet values hold a dozen numbers
//! per channel (the rank of the terms over reflectances from 0 to 1, given the noise). The rest is pure noise
//! and omitted.

use std::borrow::Cow;

use nalgebra::{DMatrix, DVector, DVectorView};

use super::channels::Channels;
use super::compress::{Reach, channel_of, sum_of_rows};
use super::emission::terms::{ExcitingBounces, Made, made};
use super::emission::{EXCITING_PLACE, Emission, Fall, Sent, UNKNOWNS};
use super::gaussian::logistic;
use super::measured::{Measured, usable_facets};
use crate::camera::CameraResponse;
use crate::error::Result;
use crate::estimate::Exposure;
use crate::estimate::unknowns::{Amounts, Normal, SceneModel};
use crate::forward::Source;

/// The problem of one sample: weighted, compressed data and the model that predicts them.
///
/// A point of the model is a reflectance per waveband and a standard normal number for each unknown of the
/// scene.
#[derive(Clone)]
pub struct FacetData<'a> {
    scene: Cow<'a, SceneModel>,
    exposure: Exposure,
    values: DVector<f64>,
    channels: Channels,
    /// Sum of squares that no reflectance explains, and the number of facet values.
    outside: f64,
    count: usize,
    peak: f64,
    sums: SumRule,
    /// Possible emission of the sheet; `None` if it is not considered.
    emission: Option<Emission>,
    /// True if the sheet may fluoresce at all.
    may_fluoresce: bool,
}

/// The sum of all facet values: measured, and of the terms of each source.
#[derive(Clone)]
struct SumRule {
    measured: f64,
    sources: Vec<DVector<f64>>,
}

/// Data minus model, in units of the noise.
pub struct Residuals {
    /// Data minus model.
    pub residuals: DVector<f64>,
    /// The exposure used.
    pub exposure: f64,
}

/// Residuals and the derivatives of the model: a column per waveband for its reflectance, then one per
/// unknown of the scene.
pub struct LinearisedFacets {
    /// Data minus model.
    pub residuals: DVector<f64>,
    /// Derivatives of the model.
    pub jacobian: DMatrix<f64>,
    /// The exposure used.
    pub exposure: FittedExposure,
    /// Input of [`FacetData::curvature`].
    pub second: SecondDerivatives,
}

/// An exposure fitted to the facets.
pub struct FittedExposure {
    /// Value.
    pub value: f64,
    /// Its derivatives by reflectances and unknowns, columns as in the Jacobian.
    pub slopes: DVector<f64>,
    /// Its standard deviation if all else is known.
    pub sd: f64,
}

/// Ingredients of second derivatives at a point: exposure, amounts of the sources, the model of each source
/// at exposure 1, and derivatives of the terms.
pub struct SecondDerivatives {
    exposure: f64,
    amounts: Amounts,
    parts: DMatrix<f64>,
    slopes: DMatrix<f64>,
    curvatures: DMatrix<f64>,
    emitted: Option<Emitted>,
}

/// Emission of the sheet at a point.
struct Emitted {
    sent: Sent,
    exciting: ExcitingBounces,
    made: Made,
}

/// `Σ λᵢ∇²mᵢ`, which does not mix wavebands.
pub struct Curvature {
    /// `Σ λᵢ ∂mᵢ/∂r` per waveband.
    pub slopes: DVector<f64>,
    /// `Σ λᵢ ∂²mᵢ/∂r²` per waveband.
    pub reflectance: DVector<f64>,
    /// By reflectance and unknown: waveband by unknown.
    pub mixed: DMatrix<f64>,
    /// Unknown by unknown.
    pub unknowns: DMatrix<f64>,
}

/// Brightness used to weigh directions of the model, at least 1: the exposure or, if that is fitted, the
/// brightest facet. At an exposure below 1 a few more directions are kept than exceed the noise.
fn brightness(measured: &Measured, exposure: Exposure) -> f64 {
    match exposure {
        Exposure::Known(exposure) => exposure.max(1.0),
        Exposure::Free | Exposure::Expected(_) | Exposure::Sum => measured.rgb.greatest().max(1.0),
    }
}

/// Maximum number of steps to the best exposure, and the relative change at convergence: from the second on,
/// each step gains two digits.
const EXPOSURE_STEPS: usize = 20;
const EXPOSURE_TOLERANCE: f64 = 1e-12;

impl<'a> FacetData<'a> {
    /// Weights and compresses the facets of a sample, omitting directions in which no reflectance moves the
    /// data by more than `cutoff` standard deviations.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if facets, channels or values do not fit the scene, or no facet was measured.
    pub fn new(scene: &'a SceneModel, measured: &Measured, exposure: Exposure, cutoff: f64) -> Result<Self> {
        let model = scene.facets();
        let usable = usable_facets(model, measured)?;
        let channels = model.sources()[0].camera.channels();
        let cutoff = cutoff / brightness(measured, exposure);
        let (mut values, mut maps, mut outside, mut peak) = (Vec::new(), Vec::new(), 0.0, 0.0_f64);
        for channel in 0..channels {
            let [data, weights] = channel_of(measured, &usable, channel);
            let data = data.component_mul(&weights);
            let is_uniform = weights.max() <= weights.min();
            let (kept, sources) = if is_uniform && usable.len() == measured.rgb.len() {
                scene.reach().compressed(&data, weights[0], cutoff)
            } else {
                let weighted = |source: &Source| {
                    let mut facets = source.facets.select_rows(&usable);
                    facets.column_iter_mut().for_each(|mut term| term.component_mul_assign(&weights));
                    facets
                };
                let sources: Vec<_> = model.sources().iter().map(weighted).collect();
                Reach::of(model, &sources.iter().collect::<Vec<_>>()).compressed(&data, 1.0, cutoff)
            };
            outside += data.norm_squared() - kept.norm_squared();
            peak = peak.max(data.max());
            values.extend(kept.iter());
            maps.push(sources);
        }
        let sums = SumRule {
            measured: usable
                .iter()
                .filter_map(|facet| measured.rgb.facet(*facet))
                .map(|facet| facet.sum())
                .sum(),
            sources: model.sources().iter().map(|source| sum_of_rows(&source.facets, &usable)).collect(),
        };
        let count = usable.len() * channels;
        Ok(Self {
            scene: Cow::Borrowed(scene),
            exposure,
            values: DVector::from_vec(values),
            channels: Channels::new(&maps, model.sources().iter().map(|source| &source.camera)),
            outside,
            count,
            peak,
            sums,
            emission: None,
            may_fluoresce: true,
        })
    }

    /// The same data for a sheet that is known not to emit light.
    #[must_use]
    pub fn without_fluorescence(self) -> Self {
        Self { may_fluoresce: false, ..self }
    }

    /// The same data for a sheet that may emit light, with the unknowns of the emission after those of the
    /// scene. `None` if the exposure is determined by sums, or a part of the surface is known.
    #[must_use]
    pub fn emitting(&self, emission: &Emission) -> Option<Self> {
        self.may_emit().then(|| Self { emission: Some(emission.clone()), ..self.clone() })
    }

    fn may_emit(&self) -> bool {
        self.may_fluoresce && self.exposure != Exposure::Sum && self.scene.facets().signed_poles().is_some()
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

    /// The possible emission of the sheet; `None` if it is not considered.
    #[must_use]
    pub fn emission(&self) -> Option<&Emission> {
        self.emission.as_ref()
    }

    /// Number of unknowns, including those of the emission.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.scene.unknowns().len() + self.emission.as_ref().map_or(0, Emission::unknowns)
    }

    /// The emission of the sheet with its unknowns; `None` without any.
    fn emits<'w>(&self, unknowns: &'w [f64]) -> Option<(&Emission, &'w [f64])> {
        let emission = self.emission.as_ref().filter(|emission| emission.unknowns() > 0)?;
        Some((emission, &unknowns[self.scene.unknowns().len()..]))
    }

    /// The emission of the sheet at a point, given the terms of reflected light and their derivatives; `None`
    /// without any.
    fn emitted(&self, reflectance: &[f64], unknowns: &[f64], terms: [&DMatrix<f64>; 3]) -> Option<Emitted> {
        let ((emission, w), poles) = (self.emits(unknowns)?, self.signed_poles());
        let exciting = emission.exciting_bounces(&poles, w);
        let made = Made::of(reflectance, terms, &poles, (emission.power_of_reflectance(), &exciting));
        Some(Emitted { sent: emission.at(w), exciting, made })
    }

    /// Signed poles, one per term.
    fn signed_poles(&self) -> Vec<f64> {
        self.scene.facets().signed_poles().unwrap_or_default()
    }

    /// Number of compressed data, and of the facet values behind them.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.values.len(), self.count)
    }

    /// Number of the camera's channels in all lights together.
    #[must_use]
    pub fn channels(&self) -> usize {
        self.channels.count()
    }

    /// Root mean square of all facet residuals, including those outside the compressed data.
    #[must_use]
    pub fn rms(&self, residuals: &DVector<f64>) -> f64 {
        let of_facets = self.of_facets(residuals).norm_squared();
        ((of_facets + self.outside.max(0.0)) / self.count as f64).sqrt()
    }

    /// The residuals without that of the expected exposure.
    fn of_facets<'r>(&self, residuals: &'r DVector<f64>) -> DVectorView<'r, f64> {
        residuals.rows(0, self.values.len())
    }

    /// Residuals relative to the data, both without the noise that no reflectance can explain.
    #[must_use]
    pub fn unexplained(&self, residuals: &DVector<f64>) -> f64 {
        self.of_facets(residuals).norm() / self.values.norm().max(f64::MIN_POSITIVE)
    }

    /// The scene and its unknowns.
    #[must_use]
    pub fn scene(&self) -> &SceneModel {
        &self.scene
    }

    /// The same data with one unknown of the scene fixed at this value.
    #[must_use]
    pub fn with_known(&self, unknown: usize, value: f64) -> Self {
        let scene = self.scene.clone().into_owned().with_known(unknown, value);
        Self { scene: Cow::Owned(scene), ..self.clone() }
    }

    /// The same data in another light, given the camera's response to it. The facets' weights of the terms,
    /// and hence the compression, are unchanged.
    #[must_use]
    pub fn in_light(&self, camera: &CameraResponse) -> Self {
        let (scene, channels) = (self.scene.in_light(camera), self.channels.in_light(camera));
        let (values, sums, emission) = (self.values.clone(), self.sums.clone(), self.emission.clone());
        Self { scene: Cow::Owned(scene), channels, values, sums, emission, ..*self }
    }

    /// The same data with a prior on the logarithm of the exposure, if it was entirely unknown.
    #[must_use]
    pub fn expecting(self, exposure: Normal) -> Self {
        Self { exposure: self.exposure.or_expected(Some(exposure)), ..self }
    }

    /// True if the exposure is fitted to the facets.
    #[must_use]
    pub fn fits_exposure(&self) -> bool {
        matches!(self.exposure, Exposure::Free | Exposure::Expected(_))
    }

    /// Distance of an exposure from the expected one in standard deviations; 0 if none was expected.
    fn exposure_off(&self, exposure: f64) -> f64 {
        match self.exposure {
            Exposure::Expected(Normal { mean, sd }) => (exposure.ln() - mean) / sd,
            Exposure::Known(_) | Exposure::Free | Exposure::Sum => 0.0,
        }
    }

    /// Residuals at a point.
    ///
    /// # Source
    /// Deeb et al., first term of eq. (36).
    #[must_use]
    pub fn residuals(&self, reflectance: &[f64], unknowns: &[f64]) -> Residuals {
        let mut terms = self.scene.facets().terms_of(reflectance);
        if let Some((emission, w)) = self.emits(unknowns) {
            let poles = self.signed_poles();
            let exciting = emission.exciting_bounces(&poles, w);
            let how = (emission.power_of_reflectance(), exciting.factors.as_slice());
            let made = made(reflectance, &terms, &poles, how);
            terms += scaled_rows(&made, emission.at(w).fraction.as_slice());
        }
        let amounts = self.scene.amounts(unknowns).values();
        let values = self.channels.parts_of(&terms) * &amounts;
        let exposure = self.exposure_of(&values, || self.sum_of(&terms, &amounts).sum());
        Residuals { residuals: self.left_over(exposure, &values), exposure }
    }

    /// Residuals at a point, with the derivatives of the model.
    ///
    /// # Source
    /// For an unknown exposure: Kaufman's approximation to the derivatives of variable projection (*BIT* 15,
    /// 1975, p. 49). The prior on its logarithm is one more datum, which depends on nothing but the exposure.
    #[must_use]
    pub fn linearise(&self, reflectance: &[f64], unknowns: &[f64]) -> LinearisedFacets {
        let [mut terms, mut slopes, mut curvatures] = self.scene.facets().derivatives_of(reflectance);
        let emitted = self.emitted(reflectance, unknowns, [&terms, &slopes, &curvatures]);
        if let Some(Emitted { sent, made, .. }) = &emitted {
            terms += scaled_rows(&made.terms, sent.fraction.as_slice());
            slopes += scaled_rows(&made.slopes, sent.fraction.as_slice());
            curvatures += scaled_rows(&made.curvatures, sent.fraction.as_slice());
        }
        let (amounts, parts) = (self.scene.amounts(unknowns), self.channels.parts_of(&terms));
        let (now, by_unknown) = (amounts.values(), amounts.slopes());
        let values = &parts * &now;
        let exposure = self.exposure_of(&values, || self.sum_of(&terms, &now).sum());
        let (bands, scene) = (slopes.nrows(), by_unknown.ncols());
        let mut jacobian = self.channels.columns_of(&slopes, &now, self.unknowns());
        jacobian.columns_mut(bands, scene).gemm(1.0, &parts, &by_unknown, 0.0);
        if let Some(Emitted { sent, exciting, made: Made { terms, .. } }) = &emitted {
            let column = |terms: &DMatrix<f64>| self.channels.parts_of(terms) * &now;
            for (n, by) in sent.slopes.column_iter().enumerate() {
                let column = column(&scaled_rows(terms, by.as_slice()));
                jacobian.column_mut(bands + scene + n).copy_from(&column);
            }
            let by_exciting = scaled_columns(terms, &exciting.slopes);
            let column = column(&scaled_rows(&by_exciting, sent.fraction.as_slice()));
            jacobian.column_mut(bands + scene + EXCITING_PLACE).copy_from(&column);
        }
        jacobian *= exposure;
        // Effect of a relative change of the exposure.
        let mut by_exposure = exposure * &values;
        if let Exposure::Expected(Normal { sd, .. }) = self.exposure {
            by_exposure = by_exposure.push(sd.recip());
            jacobian = jacobian.insert_row(values.len(), 0.0);
        }
        let square = by_exposure.norm_squared().max(f64::MIN_POSITIVE);
        let (relative, sd) = match self.exposure {
            Exposure::Known(_) => (DVector::zeros(jacobian.ncols()), 0.0),
            Exposure::Free | Exposure::Expected(_) => {
                (jacobian.tr_mul(&by_exposure) / square, exposure / square.sqrt())
            }
            Exposure::Sum => (self.shares_of_sum(&terms, &slopes, &now, &by_unknown), 0.0),
        };
        // Effect of a change of the spectrum beyond what a change of exposure compensates.
        jacobian.ger(-1.0, &by_exposure, &relative, 1.0);
        LinearisedFacets {
            residuals: self.left_over(exposure, &values),
            jacobian,
            exposure: FittedExposure { value: exposure, slopes: -exposure * relative, sd },
            second: SecondDerivatives { exposure, amounts, parts, slopes, curvatures, emitted },
        }
    }

    /// `Σ λᵢ∇²mᵢ` at the exposure of that point.
    #[must_use]
    pub fn curvature(&self, at: &SecondDerivatives, multipliers: &DVector<f64>) -> Curvature {
        let multipliers = &self.of_facets(multipliers).into_owned();
        let (now, by_unknown) = (at.amounts.values(), at.amounts.slopes());
        let mixed = by_unknown
            .column_iter()
            .map(|amounts| at.exposure * self.channels.along(multipliers, &at.slopes, &amounts.into_owned()));
        let mut mixed: Vec<_> = mixed.collect();
        let scene = self.scene.unknowns().len();
        let mut unknowns = DMatrix::zeros(self.unknowns(), self.unknowns());
        unknowns
            .view_mut((0, 0), (scene, scene))
            .copy_from(&(at.exposure * at.amounts.curvature(&at.parts.tr_mul(multipliers))));
        if let Some(Emitted { sent, exciting, made: Made { terms, slopes, .. } }) = &at.emitted {
            let along = |terms: &DMatrix<f64>, amounts: &DVector<f64>| {
                at.exposure * self.channels.along(multipliers, terms, amounts)
            };
            let by_fraction = along(terms, &now);
            let count = sent.slopes.ncols();
            unknowns.view_mut((scene, scene), (count, count)).copy_from(&sent.curvature(&by_fraction));
            let of_slopes = along(slopes, &now);
            mixed.extend(sent.slopes.column_iter().map(|by| by.component_mul(&of_slopes)));
            let [by_exciting, slopes_by_exciting] =
                [terms, slopes].map(|terms| scaled_columns(terms, &exciting.slopes));
            for (n, amounts) in by_unknown.column_iter().enumerate() {
                let amounts = amounts.into_owned();
                let mut both = sent.slopes.tr_mul(&along(terms, &amounts));
                both[EXCITING_PLACE] = sent.fraction.dot(&along(&by_exciting, &amounts));
                unknowns.view_mut((scene, n), (count, 1)).copy_from(&both);
                unknowns.view_mut((n, scene), (1, count)).tr_copy_from(&both);
            }
            let mut of_exciting = sent.slopes.tr_mul(&along(&by_exciting, &now));
            of_exciting[EXCITING_PLACE] =
                sent.fraction.dot(&along(&scaled_columns(terms, &exciting.bends), &now));
            let place = scene + EXCITING_PLACE;
            unknowns.view_mut((scene, place), (count, 1)).copy_from(&of_exciting);
            unknowns.view_mut((place, scene), (1, count)).tr_copy_from(&of_exciting);
            mixed[place] = sent.fraction.component_mul(&along(&slopes_by_exciting, &now));
        }
        Curvature {
            slopes: at.exposure * self.channels.along(multipliers, &at.slopes, &now),
            reflectance: at.exposure * self.channels.along(multipliers, &at.curvatures, &now),
            mixed: if mixed.is_empty() {
                DMatrix::zeros(at.slopes.nrows(), 0)
            } else {
                DMatrix::from_columns(&mixed)
            },
            unknowns,
        }
    }

    /// The largest datum in units of its noise.
    #[must_use]
    pub fn peak(&self) -> f64 {
        self.peak
    }

    fn exposure_of(&self, values: &DVector<f64>, sum: impl Fn() -> f64) -> f64 {
        match self.exposure {
            Exposure::Known(exposure) => exposure,
            Exposure::Free => self.best_exposure(values),
            Exposure::Expected(prior) => self.expected_exposure(values, prior),
            Exposure::Sum => self.sums.measured / sum().max(f64::MIN_POSITIVE),
        }
    }

    /// The exposure that fits the facets best.
    fn best_exposure(&self, values: &DVector<f64>) -> f64 {
        values.dot(&self.values) / values.norm_squared().max(f64::MIN_POSITIVE)
    }

    /// The exposure that best fits the facets and its prior together, by Gauss-Newton steps in its logarithm.
    fn expected_exposure(&self, values: &DVector<f64>, Normal { mean, sd }: Normal) -> f64 {
        let (square, product) = (values.norm_squared(), values.dot(&self.values));
        let best = self.best_exposure(values);
        let mut ln_exposure = if best > 0.0 { best.ln() } else { mean };
        for _ in 0..EXPOSURE_STEPS {
            let exposure = ln_exposure.exp();
            let gradient = exposure * (product - exposure * square) - (ln_exposure - mean) / (sd * sd);
            let step = gradient / (exposure * exposure * square + (sd * sd).recip());
            ln_exposure += step.clamp(-1.0, 1.0);
            if step.abs() < EXPOSURE_TOLERANCE {
                break;
            }
        }
        ln_exposure.exp()
    }

    /// Data minus model, given `values` of the model at exposure 1, followed by the deviation from the
    /// expected exposure, if there is one.
    fn left_over(&self, exposure: f64, values: &DVector<f64>) -> DVector<f64> {
        let of_facets = &self.values - exposure * values;
        match self.exposure {
            Exposure::Expected(_) => of_facets.push(-self.exposure_off(exposure)),
            Exposure::Known(_) | Exposure::Free | Exposure::Sum => of_facets,
        }
    }

    /// Sum over all facets and channels, per waveband.
    fn sum_of(&self, terms: &DMatrix<f64>, amounts: &DVector<f64>) -> DVector<f64> {
        self.channels.sum_of(terms, &self.sums.sources, amounts)
    }

    /// Derivatives of the logarithm of that sum, columns as in the Jacobian.
    fn shares_of_sum(
        &self,
        terms: &DMatrix<f64>,
        slopes: &DMatrix<f64>,
        amounts: &DVector<f64>,
        by_unknown: &DMatrix<f64>,
    ) -> DVector<f64> {
        let by_reflectance = self.sum_of(slopes, amounts);
        let by_unknown =
            by_unknown.column_iter().map(|amounts| self.sum_of(terms, &amounts.into_owned()).sum());
        let all: Vec<f64> = by_reflectance.iter().copied().chain(by_unknown).collect();
        DVector::from_vec(all) / self.sum_of(terms, amounts).sum().max(f64::MIN_POSITIVE)
    }
}

/// Multiplies each column by a factor.
fn scaled_columns(matrix: &DMatrix<f64>, factors: &[f64]) -> DMatrix<f64> {
    let mut scaled = matrix.clone();
    scaled.column_iter_mut().zip(factors).for_each(|(mut column, factor)| column.scale_mut(*factor));
    scaled
}

/// Multiplies each row by a factor.
fn scaled_rows(matrix: &DMatrix<f64>, factors: &[f64]) -> DMatrix<f64> {
    let mut scaled = matrix.clone();
    for column in scaled.as_mut_slice().chunks_exact_mut(factors.len().max(1)) {
        column.iter_mut().zip(factors).for_each(|(value, factor)| *value *= factor);
    }
    scaled
}
