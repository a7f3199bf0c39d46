//! Sheet models as they appear in photographs of one sheet.

use nalgebra::{DMatrix, DVector};

use super::conditions::Conditions;
use super::parts::{Parts, Radiance, lagrange};
use super::priors::Priors;
use super::sheets::{
    BODY_ROUGHNESSES_DEG, Departure, INSTRUMENT_SHARED, SHEEN, SPECULAR_ROUGHNESSES, SPECULAR_WEIGHTS, Sheets,
};
use crate::estimate::unknowns::Unknown;
use crate::solve::Eigen;
use crate::solve::dense::rms;

/// Number of principal components of measured sheets.
const VARIATIONS: usize = 8;
/// Radiance added to the brightness of the facets in comparisons of departures.
const FLOOR: f64 = 0.05;
/// Limit on a sheet's mean departure from a Lambertian one, relative to the brightness of the facets. Larger
/// departures are scaled down to it: the sheets were measured far from grazing directions.
const MOST: f64 = 0.6;

/// The assumed sheet model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SheetModel {
    /// Perfectly matte, or nearly so.
    Matt,
    /// A formula, whose parameters are among the conditions.
    Family,
    /// Like the measured sheets.
    Measured,
}

/// The known sheet models, as they appear in one photograph.
pub struct SheetModels<'a> {
    priors: &'a Priors,
    sheets: &'a Sheets,
    /// The mean of measured sheets.
    measured: Departure,
    /// Principal components of measured sheets, scaled to a standard deviation: differences of departures.
    variations: Vec<Departure>,
}

impl SheetModel {
    /// All models.
    pub const ALL: [Self; 3] = [Self::Matt, Self::Family, Self::Measured];

    /// Logarithm of the prior probability of the model.
    #[must_use]
    pub fn ln_share(self, priors: &Priors) -> f64 {
        let share = match self {
            Self::Matt => priors.matt_share,
            Self::Family | Self::Measured => 0.5 * (1.0 - priors.matt_share),
        };
        share.ln()
    }

    /// Standard deviation of its variations, relative to that of measured sheets about their mean.
    fn variation(self, priors: &Priors) -> f64 {
        match self {
            Self::Measured => priors.measured_variation,
            Self::Matt | Self::Family => priors.formula_variation,
        }
    }

    /// True if an unknown affects sheets of this model: only the formula has parameters.
    #[must_use]
    pub fn has(self, unknown: &Unknown) -> bool {
        match self {
            Self::Family => true,
            Self::Matt | Self::Measured => !unknown.is_of_sheet(),
        }
    }
}

impl<'a> SheetModels<'a> {
    /// For photographs of one sheet: the principal components of measured sheets are common to all of them.
    #[must_use]
    pub fn of(photographs: &'a [Parts]) -> Vec<Self> {
        let bounded = bounded(photographs);
        let principal_components = principal_components(photographs, &bounded);
        let of = |(parts, measured): (&'a Parts, &Vec<Departure>)| {
            let mean = vec![1.0 / measured.len() as f64; measured.len()];
            Self {
                priors: parts.stated.priors,
                sheets: &parts.sheets,
                measured: sum(measured, &mean),
                variations: principal_components.iter().map(|shares| variation(measured, shares)).collect(),
            }
        };
        photographs.iter().zip(&bounded).map(of).collect()
    }

    /// Number of variations of a sheet model: those visible in the facets, then the error of an instrument.
    #[must_use]
    pub fn variation_count(&self) -> usize {
        self.variations.len() + 1
    }

    /// Change of the facets, at the albedo nodes, for each of the visible variations, in this amount of
    /// sunlight.
    pub fn by_variation(&self, kind: SheetModel, sun: f64) -> impl Iterator<Item = Radiance> + '_ {
        self.variations.iter().map(move |own| sun * kind.variation(self.priors) * &own.radiance)
    }

    /// Departure of a sheet from a Lambertian one for these sizes of its variations.
    #[must_use]
    pub fn departure(&self, kind: SheetModel, conditions: &Conditions, variations: &[f64]) -> Departure {
        let mut sum = match kind {
            SheetModel::Measured => {
                let mut mean = self.measured.clone();
                mean.reflectance[0] += INSTRUMENT_SHARED * variations.last().copied().unwrap_or(0.0);
                mean
            }
            // for these two the formula gives the instrument's reading
            SheetModel::Matt => Departure::none(&self.measured.radiance),
            SheetModel::Family => self.family(conditions),
        };
        for (own, size) in self.variations.iter().zip(variations) {
            sum.add(kind.variation(self.priors) * size, own, [0.0, 0.0]);
        }
        sum
    }

    fn family(&self, conditions: &Conditions) -> Departure {
        let shares = [
            lagrange(SPECULAR_WEIGHTS, conditions.specular_weight),
            lagrange(SPECULAR_ROUGHNESSES, conditions.specular_roughness),
            lagrange(BODY_ROUGHNESSES_DEG, conditions.body_roughness_deg),
        ];
        let mut sum = Departure::none(&self.measured.radiance);
        for (n, departure) in self.sheets.families.iter().enumerate() {
            let share = shares[0][n / 9] * shares[1][n / 3 % 3] * shares[2][n % 3];
            sum.add(share, departure, [1.0, 0.0]);
        }
        let [low, high] = SHEEN;
        let [_, shares @ ..] = lagrange([0.0, low, high], conditions.sheen);
        for (share, change) in shares.into_iter().zip(&self.sheets.sheen) {
            sum.add(share, change, [0.0, 0.0]);
        }
        sum
    }
}

/// The sum of departures, weighted by `shares`.
fn sum(all: &[Departure], shares: &[f64]) -> Departure {
    let mut sum = all[0].less(&all[0]);
    all.iter().zip(shares).for_each(|(one, share)| sum.add(*share, one, [0.0; 2]));
    sum
}

/// The same for a principal component. Tables are too uncertain to tell how their differences change with the
/// fold.
fn variation(all: &[Departure], shares: &[f64]) -> Departure {
    Departure { changes: None, ..sum(all, shares) }
}

/// Measured sheets in each photograph, scaled so that none departs too far in any of them.
fn bounded(photographs: &[Parts]) -> Vec<Vec<Departure>> {
    let count = photographs.first().map_or(0, |parts| parts.sheets.measured.len());
    let share = |sheet: usize| {
        let size = |parts: &Parts| rms(&relative(&parts.sheets.measured[sheet], &parts.sun.even));
        (MOST / photographs.iter().map(size).fold(0.0, f64::max)).min(1.0)
    };
    let shares: Vec<f64> = (0..count).map(share).collect();
    let bounded = |(one, share): (&Departure, &f64)| {
        let mut bounded = Departure::none(&one.radiance);
        bounded.add(*share, one, [1.0, 0.0]);
        bounded
    };
    let of = |parts: &Parts| parts.sheets.measured.iter().zip(&shares).map(bounded).collect();
    photographs.iter().map(of).collect()
}

fn relative(departure: &Departure, lambertian: &Radiance) -> DVector<f64> {
    let relative = departure.radiance.zip_map(lambertian, |beyond, radiance| beyond / (radiance + FLOOR));
    DVector::from_iterator(relative.len(), relative.iter().copied())
}

/// Principal components of measured sheets, scaled to a standard deviation: weights of each sheet, which add
/// up to zero.
///
/// # Source
/// Bishop, *Pattern Recognition and Machine Learning* (2006), section 12.1.4 (fewer points than dimensions).
fn principal_components(photographs: &[Parts], measured: &[Vec<Departure>]) -> Vec<Vec<f64>> {
    let columns = |(parts, measured): (&Parts, &Vec<Departure>)| {
        DMatrix::from_columns(&measured.iter().map(|one| relative(one, &parts.sun.even)).collect::<Vec<_>>())
    };
    let of_photographs: Vec<DMatrix<f64>> = photographs.iter().zip(measured).map(columns).collect();
    let count = of_photographs.first().map_or(0, DMatrix::ncols);
    let mut products = DMatrix::zeros(count, count);
    for mut columns in of_photographs {
        let middle = columns.column_mean();
        columns.column_iter_mut().for_each(|mut column| column -= &middle);
        products += columns.tr_mul(&columns);
    }
    let Eigen { values, vectors } = Eigen::of_symmetric(products);
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
    let scale = 1.0 / (count as f64).sqrt();
    let shares = |n: &usize| {
        let own = vectors.column(*n);
        let middle = own.mean();
        own.iter().map(|share| scale * (share - middle)).collect()
    };
    order.iter().take(VARIATIONS.min(count.saturating_sub(1))).map(shares).collect()
}
