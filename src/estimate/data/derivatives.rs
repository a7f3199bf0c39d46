//! The model of a sample's data at a point, with its derivatives.

use nalgebra::{DMatrix, DVector};

use super::FacetData;
use super::emitting::{Emitted, scaled_columns, scaled_rows};
use crate::estimate::Exposure;
use crate::estimate::emission::EXCITING_PLACE;
use crate::estimate::emission::terms::{Made, made};
use crate::estimate::unknowns::{Amounts, Normal};
use crate::solve::dense::dot_products;
use crate::solve::posterior::Evaluated;

/// The model of the data at a point.
pub struct Predicted {
    /// The exposure used.
    pub exposure: f64,
    pub(super) amounts: Amounts,
    /// The model of each source at exposure 1 and amount 1.
    parts: DMatrix<f64>,
}

/// Residuals and the derivatives of the model: a column per waveband for its reflectance, then one per
/// unknown of the scene.
pub struct LinearisedFacets {
    /// Data minus model.
    pub residuals: DVector<f64>,
    /// Derivatives of the model.
    pub jacobian: DMatrix<f64>,
    /// The exposure.
    pub exposure: FittedExposure,
    /// Input of [`FacetData::curvature`].
    pub second: SecondDerivatives,
}

/// How an exposure that is fitted to the facets depends on all else.
pub struct FittedExposure {
    /// Its derivatives by reflectances and unknowns, columns as in the Jacobian.
    pub slopes: DVector<f64>,
    /// Its standard deviation if all else is known.
    pub sd: f64,
}

/// Ingredients of second derivatives at a point: the model, and derivatives of the terms.
pub struct SecondDerivatives {
    predicted: Predicted,
    slopes: DMatrix<f64>,
    curvatures: DMatrix<f64>,
    emitted: Option<Emitted>,
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

impl FacetData<'_> {
    /// Residuals at a point.
    ///
    /// # Source
    /// Deeb et al., first term of eq. (36).
    #[must_use]
    pub fn residuals(&self, reflectance: &[f64], unknowns: &[f64]) -> Evaluated<Predicted> {
        let mut terms = self.scene.facets().terms_of(reflectance);
        if let Some((emission, w)) = self.emits(unknowns) {
            let poles = self.signed_poles();
            let exciting = emission.exciting_bounces(&poles, w);
            let how = (emission.power_of_reflectance(), exciting.factors.as_slice());
            let made = made(reflectance, &terms, &poles, how);
            terms += scaled_rows(&made, emission.at(w).fraction.as_slice());
        }
        let (amounts, parts) = (self.scene.amounts(unknowns), self.channels.parts_of(&terms));
        let now = amounts.values();
        let values = &parts * &now;
        let exposure = self.exposure_of(&values, || self.sum_of(&terms, &now).sum());
        let residuals = self.left_over(exposure, &values);
        Evaluated { residuals, ingredients: Predicted { exposure, amounts, parts } }
    }

    /// Residuals at a point, with the derivatives of the model.
    #[must_use]
    pub fn linearise(&self, reflectance: &[f64], unknowns: &[f64]) -> LinearisedFacets {
        self.derivatives(reflectance, unknowns, self.residuals(reflectance, unknowns))
    }

    /// The same, given the residuals there.
    ///
    /// # Source
    /// For an unknown exposure: Kaufman's approximation to the derivatives of variable projection (*BIT* 15,
    /// 1975, p. 49). The prior on its logarithm is one more datum, which depends on nothing but the exposure.
    #[must_use]
    pub fn derivatives(
        &self,
        reflectance: &[f64],
        unknowns: &[f64],
        at: Evaluated<Predicted>,
    ) -> LinearisedFacets {
        let [terms, mut slopes, mut curvatures] = self.scene.facets().derivatives_of(reflectance);
        let emitted = self.emitted(reflectance, unknowns, [&terms, &slopes, &curvatures]);
        if let Some(Emitted { sent, made, .. }) = &emitted {
            slopes += scaled_rows(&made.slopes, sent.fraction.as_slice());
            curvatures += scaled_rows(&made.curvatures, sent.fraction.as_slice());
        }
        let Evaluated { residuals, ingredients: predicted } = at;
        let Predicted { exposure, amounts, parts } = &predicted;
        let (now, by_unknown) = (amounts.values(), amounts.slopes());
        let exposed = *exposure * &now;
        let (bands, scene) = (slopes.nrows(), by_unknown.ncols());
        let mut jacobian = self.channels.columns_of(&slopes, &exposed, self.unknowns());
        jacobian.columns_mut(bands, scene).gemm(*exposure, parts, &by_unknown, 0.0);
        if let Some(Emitted { sent, exciting, made: Made { terms, .. } }) = &emitted {
            let column = |terms: &DMatrix<f64>| self.channels.parts_of(terms) * &exposed;
            for (n, by) in sent.slopes.column_iter().enumerate() {
                let column = column(&scaled_rows(terms, by.as_slice()));
                jacobian.column_mut(bands + scene + n).copy_from(&column);
            }
            let by_exciting = scaled_columns(terms, &exciting.slopes);
            let column = column(&scaled_rows(&by_exciting, sent.fraction.as_slice()));
            jacobian.column_mut(bands + scene + EXCITING_PLACE).copy_from(&column);
        }
        // Effect of a relative change of the exposure.
        let mut by_exposure = parts * exposed;
        if let Exposure::Expected(Normal { sd, .. }) = self.exposure {
            let data = by_exposure.len();
            by_exposure = by_exposure.push(sd.recip());
            jacobian = jacobian.insert_row(data, 0.0);
        }
        let square = by_exposure.norm_squared().max(f64::MIN_POSITIVE);
        let (relative, sd) = match self.exposure {
            Exposure::Known(_) => (DVector::zeros(jacobian.ncols()), 0.0),
            Exposure::Free | Exposure::Expected(_) => {
                (dot_products(&jacobian, &by_exposure) / square, exposure / square.sqrt())
            }
            // with sums no emission is considered, which these terms lack
            Exposure::Sum => (self.shares_of_sum(&terms, &slopes, &now, &by_unknown), 0.0),
        };
        // Effect of a change of the spectrum beyond what a change of exposure compensates.
        jacobian.ger(-1.0, &by_exposure, &relative, 1.0);
        LinearisedFacets {
            residuals,
            jacobian,
            exposure: FittedExposure { slopes: -*exposure * relative, sd },
            second: SecondDerivatives { predicted, slopes, curvatures, emitted },
        }
    }

    /// `Σ λᵢ∇²mᵢ` at the exposure of that point.
    #[must_use]
    pub fn curvature(&self, at: &SecondDerivatives, multipliers: &DVector<f64>) -> Curvature {
        let multipliers = &self.of_facets(multipliers).into_owned();
        let Predicted { exposure, amounts, parts } = &at.predicted;
        let (now, by_unknown) = (amounts.values(), amounts.slopes());
        let mixed = by_unknown
            .column_iter()
            .map(|amounts| *exposure * self.channels.along(multipliers, &at.slopes, &amounts.into_owned()));
        let mut mixed: Vec<_> = mixed.collect();
        let scene = self.scene.unknowns().len();
        let mut unknowns = DMatrix::zeros(self.unknowns(), self.unknowns());
        unknowns
            .view_mut((0, 0), (scene, scene))
            .copy_from(&(*exposure * amounts.curvature(&parts.tr_mul(multipliers))));
        if let Some(Emitted { sent, exciting, made: Made { terms, slopes, .. } }) = &at.emitted {
            let along = |terms: &DMatrix<f64>, amounts: &DVector<f64>| {
                *exposure * self.channels.along(multipliers, terms, amounts)
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
            slopes: *exposure * self.channels.along(multipliers, &at.slopes, &now),
            reflectance: *exposure * self.channels.along(multipliers, &at.curvatures, &now),
            mixed: if mixed.is_empty() {
                DMatrix::zeros(at.slopes.nrows(), 0)
            } else {
                DMatrix::from_columns(&mixed)
            },
            unknowns,
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
