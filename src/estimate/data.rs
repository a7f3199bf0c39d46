//! Facet RGB as data to fit, compressed to what the noise lets through.
//!
//! All facets combine the same few terms of the reflectance, so hundreds of facet values hold a dozen numbers a channel
//! (the rank of the terms over reflectances from 0 to 1, seen through the noise); the rest is noise alone and is left out.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::error::{Error, Result};
use crate::estimate::Exposure;
use crate::forward::FacetModel;
use crate::solve::Eigen;

/// Facet RGB, and how far each may be off: facet by channel, none for a facet that was not measured.
pub struct Measured<'a> {
    /// Values.
    pub rgb: &'a [Option<Vec<f64>>],
    /// Standard deviations, positive.
    pub sd: &'a [Option<Vec<f64>>],
}

/// The problem of one sample: weighted, compressed data and the model that predicts them.
pub struct FacetData<'a> {
    model: &'a FacetModel,
    exposure: Exposure,
    values: DVector<f64>,
    channels: Vec<ChannelModel>,
    /// Sum of squares that no reflectance explains, and the number of facet values.
    outside: f64,
    count: usize,
    peak: f64,
    sums: SumRule,
}

/// What one channel's compressed data take of the terms, and the camera's weights: one of each a light.
struct ChannelModel {
    sources: Vec<DMatrix<f64>>,
    weights: Vec<DVector<f64>>,
}

/// The sum of all facet values: measured, and of the terms of each light.
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

/// Residuals with the derivatives of the model by the reflectance, a column a waveband.
pub struct LinearisedFacets {
    /// Data minus model.
    pub residuals: DVector<f64>,
    /// Derivatives of the model.
    pub jacobian: DMatrix<f64>,
    /// For [`FacetData::curvature`].
    pub second: SecondDerivatives,
}

/// What second derivatives at a reflectance are made of: exposure, and derivatives of the terms.
pub struct SecondDerivatives {
    exposure: f64,
    slopes: DMatrix<f64>,
    curvatures: DMatrix<f64>,
}

impl<'a> FacetData<'a> {
    /// Weights and compresses the facets of a sample; directions in which no reflectance moves the data by more than
    /// `cutoff` standard deviations are left out.
    ///
    /// # Errors
    /// [`Error::Field`] if facets, channels or values do not fit the scene, or no facet was measured.
    pub fn new(model: &'a FacetModel, measured: &Measured, exposure: Exposure, cutoff: f64) -> Result<Self> {
        let usable = usable_facets(model, measured)?;
        let channels = model.sources()[0].camera.channels();
        let samples = sample_terms(model);
        let (mut values, mut models, mut outside, mut peak) = (Vec::new(), Vec::new(), 0.0, 0.0_f64);
        for channel in 0..channels {
            let (data, sources) = weighted(model, measured, &usable, channel);
            let (kept, sources) = compress(&data, &sources, &samples, cutoff);
            outside += data.norm_squared() - kept.norm_squared();
            peak = peak.max(data.max());
            values.extend(kept.iter());
            let camera = model.sources().iter().map(|source| source.camera.channel(channel));
            models.push(ChannelModel { sources, weights: camera.map(DVector::from_column_slice).collect() });
        }
        let sums = SumRule {
            measured: usable.iter().filter_map(|facet| measured.rgb[*facet].as_ref()).flatten().sum(),
            sources: model.sources().iter().map(|source| sum_of_rows(&source.facets, &usable)).collect(),
        };
        let count = usable.len() * channels;
        Ok(Self {
            model,
            exposure,
            values: DVector::from_vec(values),
            channels: models,
            outside,
            count,
            peak,
            sums,
        })
    }

    /// Compressed data left of all facet values.
    fn len(&self) -> usize {
        self.values.len()
    }

    /// Root mean square of all residuals, those outside the compressed data included.
    #[must_use]
    pub fn rms(&self, residuals: &DVector<f64>) -> f64 {
        ((residuals.norm_squared() + self.outside.max(0.0)) / self.count as f64).sqrt()
    }

    /// Residuals at a reflectance.
    ///
    /// # Source
    /// Deeb et al., first term of eq. (36).
    #[must_use]
    pub fn residuals(&self, reflectance: &[f64]) -> Residuals {
        let [terms] = self.model.terms_of(reflectance);
        let (residuals, exposure, _) = self.compare(&terms);
        Residuals { residuals, exposure }
    }

    /// Residuals at a reflectance, with the derivatives of the model.
    ///
    /// # Source
    /// A free exposure: Kaufman's approximation to the derivatives of variable projection (*BIT* 15, 1975, p. 49).
    #[must_use]
    pub fn linearise(&self, reflectance: &[f64]) -> LinearisedFacets {
        let [terms, slopes, curvatures] = self.model.terms_of(reflectance);
        let (residuals, exposure, values) = self.compare(&terms);
        let mut jacobian = exposure * self.columns_of(&slopes);
        match self.exposure {
            Exposure::Known(_) => {}
            // What a change of the spectrum does beyond what a change of exposure undoes.
            Exposure::Free => {
                let along = jacobian.tr_mul(&values) / values.norm_squared().max(f64::MIN_POSITIVE);
                jacobian.ger(-1.0, &values, &along, 1.0);
            }
            Exposure::Sum => {
                let shares = self.sum_of(&slopes) / self.sum_of(&terms).sum().max(f64::MIN_POSITIVE);
                jacobian.ger(-exposure, &values, &shares, 1.0);
            }
        }
        let second = SecondDerivatives { exposure, slopes, curvatures };
        LinearisedFacets { residuals, jacobian, second }
    }

    /// `Σ λᵢ ∂mᵢ/∂r` and `Σ λᵢ ∂²mᵢ/∂r²` a waveband, at the exposure of that reflectance.
    #[must_use]
    pub fn curvature(&self, at: &SecondDerivatives, multipliers: &DVector<f64>) -> [DVector<f64>; 2] {
        [&at.slopes, &at.curvatures].map(|of_terms| at.exposure * self.along(multipliers, of_terms))
    }

    /// The largest datum in units of its noise.
    #[must_use]
    pub fn peak(&self) -> f64 {
        self.peak
    }

    /// Residuals, exposure, and the model at exposure 1.
    fn compare(&self, terms: &DMatrix<f64>) -> (DVector<f64>, f64, DVector<f64>) {
        let values = self.values_of(terms);
        let exposure = self.exposure_of(&values, || self.sum_of(terms).sum());
        (&self.values - exposure * &values, exposure, values)
    }

    fn exposure_of(&self, values: &DVector<f64>, sum: impl Fn() -> f64) -> f64 {
        match self.exposure {
            Exposure::Known(exposure) => exposure,
            Exposure::Free => values.dot(&self.values) / values.norm_squared().max(f64::MIN_POSITIVE),
            Exposure::Sum => self.sums.measured / sum().max(f64::MIN_POSITIVE),
        }
    }

    /// Model of the compressed data at exposure 1.
    fn values_of(&self, terms: &DMatrix<f64>) -> DVector<f64> {
        let mut values = DVector::zeros(self.len());
        self.each_part(|rows, compressed, weights| {
            values.rows_mut(rows.start, rows.len()).gemv(1.0, compressed, &(terms * weights), 1.0);
        });
        values
    }

    /// The same a waveband: its sum over the columns is [`FacetData::values_of`].
    fn columns_of(&self, terms: &DMatrix<f64>) -> DMatrix<f64> {
        let mut columns = DMatrix::zeros(self.len(), terms.ncols());
        self.each_part(|rows, compressed, weights| {
            let mut part = compressed * terms;
            part.column_iter_mut().zip(weights.iter()).for_each(|(mut column, weight)| column *= *weight);
            let mut target = columns.rows_mut(rows.start, rows.len());
            target += part;
        });
        columns
    }

    /// `Σ λᵢ` times the model a waveband, without forming its columns.
    fn along(&self, multipliers: &DVector<f64>, of_terms: &DMatrix<f64>) -> DVector<f64> {
        let mut along = DVector::zeros(of_terms.ncols());
        self.each_part(|rows, compressed, weights| {
            let by_term = compressed.tr_mul(&multipliers.rows(rows.start, rows.len()));
            along += of_terms.tr_mul(&by_term).component_mul(weights);
        });
        along
    }

    /// Sum over all facets and channels, a waveband.
    fn sum_of(&self, terms: &DMatrix<f64>) -> DVector<f64> {
        let mut sum = DVector::zeros(terms.ncols());
        for channel in &self.channels {
            for (weights, facets) in channel.weights.iter().zip(&self.sums.sources) {
                sum += terms.tr_mul(facets).component_mul(weights);
            }
        }
        sum
    }

    /// Visits every channel under every light: its rows of the compressed data, what they take of the terms, and the
    /// camera's weights a waveband.
    fn each_part(&self, mut visit: impl FnMut(Range<usize>, &DMatrix<f64>, &DVector<f64>)) {
        let mut start = 0;
        for channel in &self.channels {
            let end = start + channel.sources[0].nrows();
            for (compressed, weights) in channel.sources.iter().zip(&channel.weights) {
                visit(start..end, compressed, weights);
            }
            start = end;
        }
    }
}

/// Facets with a value in every channel; checks the shapes on the way.
fn usable_facets(model: &FacetModel, measured: &Measured) -> Result<Vec<usize>> {
    let (facets, channels) = (model.sources()[0].facets.nrows(), model.sources()[0].camera.channels());
    for (name, rows) in [("facet_rgb", measured.rgb), ("facet_sd", measured.sd)] {
        if rows.len() != facets {
            return Err(Error::field(name, format!("{} facets, but the scene has {facets}", rows.len())));
        }
        if let Some(odd) = rows.iter().flatten().find(|row| row.len() != channels) {
            return Err(Error::field(
                name,
                format!("{} channels, but the scene's camera has {channels}", odd.len()),
            ));
        }
    }
    let usable: Vec<usize> =
        (0..facets).filter(|f| measured.rgb[*f].is_some() && measured.sd[*f].is_some()).collect();
    if usable.is_empty() {
        return Err(Error::field("facet_rgb", "no facet was measured; check corners and clipping"));
    }
    if usable.iter().filter_map(|f| measured.rgb[*f].as_ref()).flatten().sum::<f64>() <= 0.0 {
        return Err(Error::field("facet_rgb", "no light in any facet; check exposure and black level"));
    }
    Ok(usable)
}

/// One channel of the usable facets in units of their noise: the data, and what they take of the terms of each light.
fn weighted(
    model: &FacetModel,
    measured: &Measured,
    usable: &[usize],
    channel: usize,
) -> (DVector<f64>, Vec<DMatrix<f64>>) {
    let column =
        |of: &[Option<Vec<f64>>], facet: usize| of[facet].as_ref().map_or(f64::NAN, |rgb| rgb[channel]);
    let weight: Vec<f64> = usable.iter().map(|facet| column(measured.sd, *facet).recip()).collect();
    let data = usable.iter().zip(&weight).map(|(facet, weight)| weight * column(measured.rgb, *facet));
    let entry = |facets: &DMatrix<f64>, row: usize, term| weight[row] * facets[(usable[row], term)];
    let sources = model.sources().iter().map(|source| {
        DMatrix::from_fn(usable.len(), model.terms(), |row, term| entry(&source.facets, row, term))
    });
    (DVector::from_iterator(usable.len(), data), sources.collect())
}

fn sum_of_rows(matrix: &DMatrix<f64>, rows: &[usize]) -> DVector<f64> {
    rows.iter().fold(DVector::zeros(matrix.ncols()), |sum, row| sum + matrix.row(*row).transpose())
}

/// The terms over all reflectances: term by sample. Chebyshev points of [0, 1], shuffled over the wavebands, so that a card's
/// spectrum meets dark and bright ones everywhere.
fn sample_terms(model: &FacetModel) -> DMatrix<f64> {
    let bands = model.bands();
    // 37 shares no factor with the usual numbers of wavebands.
    let place = |band: usize| (37 * band % bands) as f64 + 0.5;
    let chebyshev = |band: usize| (std::f64::consts::FRAC_PI_2 * place(band) / bands as f64).sin().powi(2);
    let [samples] = model.terms_of(&(0..bands).map(chebyshev).collect::<Vec<_>>());
    samples
}

/// Rotates data and models to the directions that reflectance can move by more than the noise.
fn compress(
    data: &DVector<f64>,
    sources: &[DMatrix<f64>],
    samples: &DMatrix<f64>,
    cutoff: f64,
) -> (DVector<f64>, Vec<DMatrix<f64>>) {
    // First to the span of the terms, then to the span of what they do over all reflectances.
    let columns: Vec<_> = sources.iter().flat_map(|source| source.column_iter()).collect();
    let q = DMatrix::from_columns(&columns).qr().q();
    let sources: Vec<_> = sources.iter().map(|source| q.tr_mul(source)).collect();
    let reach: Vec<_> = sources.iter().map(|source| source * samples).collect();
    let reach =
        DMatrix::from_columns(&reach.iter().flat_map(|reach| reach.column_iter()).collect::<Vec<_>>());
    let directions = Eigen::of_symmetric(&reach * reach.transpose());
    // Below that share of the largest, squares of singular values are rounding.
    let largest = directions.values.iter().copied().fold(0.0, f64::max);
    let least = (cutoff * cutoff).max(1e-15 * largest);
    let kept: Vec<_> = directions
        .values
        .iter()
        .zip(directions.vectors.column_iter())
        .filter(|(square, _)| **square > least)
        .map(|(_, direction)| direction)
        .collect();
    if kept.is_empty() {
        return (DVector::zeros(0), sources.iter().map(|source| source.rows(0, 0).into_owned()).collect());
    }
    let rotation = DMatrix::from_columns(&kept);
    let values = rotation.tr_mul(&q.tr_mul(data));
    (values, sources.iter().map(|source| rotation.tr_mul(source)).collect())
}
