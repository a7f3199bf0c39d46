//! Facet RGB as data to fit, compressed to what the noise lets through.
//!
//! All facets combine the same few terms of the reflectance, so hundreds of facet values hold a dozen numbers a channel
//! (the rank of the terms over reflectances from 0 to 1, seen through the noise); the rest is noise alone and is left out.

use nalgebra::{DMatrix, DVector};

use crate::error::{Error, Result};
use crate::estimate::Exposure;
use crate::forward::FacetModel;

/// Reflectances (and, with a card, wavebands) at which the terms are sampled to find their rank.
const RANK_SAMPLES: usize = 96;

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
    sums: SumRule,
}

/// What one channel's compressed data take of the terms, a matrix a light.
struct ChannelModel {
    sources: Vec<DMatrix<f64>>,
}

/// The sum of all facet values: measured, and of the terms of each light.
struct SumRule {
    measured: f64,
    sources: Vec<DVector<f64>>,
}

/// Data minus model and its derivatives, a column a waveband, in units of the noise.
pub struct Residuals {
    /// Data minus model.
    pub residuals: DVector<f64>,
    /// Derivatives of the model.
    pub jacobian: DMatrix<f64>,
    /// The exposure used.
    pub exposure: f64,
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
        let (mut values, mut models, mut outside) = (Vec::new(), Vec::new(), 0.0);
        for channel in 0..channels {
            let column = |of: &[Option<Vec<f64>>], facet: usize| {
                of[facet].as_ref().map_or(f64::NAN, |rgb| rgb[channel])
            };
            let weight: Vec<f64> = usable.iter().map(|facet| column(measured.sd, *facet).recip()).collect();
            let data = DVector::from_iterator(
                usable.len(),
                usable.iter().zip(&weight).map(|(facet, w)| w * column(measured.rgb, *facet)),
            );
            let sources = model.sources().iter().map(|source| {
                DMatrix::from_fn(usable.len(), model.terms(), |row, term| {
                    weight[row] * source.facets[(usable[row], term)]
                })
            });
            let (kept, compressed) = compress(&data, sources.collect(), &samples, cutoff);
            outside += data.norm_squared() - kept.norm_squared();
            values.extend(kept.iter());
            models.push(ChannelModel { sources: compressed });
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
            sums,
        })
    }

    /// Compressed data left of all facet values.
    #[must_use]
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether nothing is left: no reflectance changes any facet by more than the noise.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Size of the data in units of their noise: root mean square over all facet values.
    #[must_use]
    pub fn signal_to_noise(&self) -> f64 {
        ((self.values.norm_squared() + self.outside.max(0.0)) / self.count as f64).sqrt()
    }

    /// Root mean square of all residuals, those outside the compressed data included.
    #[must_use]
    pub fn rms(&self, residuals: &DVector<f64>) -> f64 {
        ((residuals.norm_squared() + self.outside.max(0.0)) / self.count as f64).sqrt()
    }

    /// Residuals at a reflectance, with derivatives.
    ///
    /// # Source
    /// Deeb et al., first term of eq. (36).
    #[must_use]
    pub fn residuals(&self, reflectance: &[f64]) -> Residuals {
        let at = self.predict(reflectance);
        let exposure = self.exposure_of(&at);
        let residuals = &self.values - exposure * &at.values;
        let mut jacobian = exposure * &at.slopes;
        match self.exposure {
            Exposure::Known(_) => {}
            // What a change of the spectrum does beyond what a change of exposure undoes (Kaufman's approximation).
            Exposure::Free => {
                let along = at.slopes.tr_mul(&at.values) / at.values.norm_squared();
                jacobian.ger(-exposure, &at.values, &along, 1.0);
            }
            Exposure::Sum => jacobian.ger(-exposure / at.sum, &at.values, &at.sum_slopes, 1.0),
        }
        Residuals { residuals, jacobian, exposure }
    }

    fn exposure_of(&self, at: &Prediction) -> f64 {
        match self.exposure {
            Exposure::Known(exposure) => exposure,
            Exposure::Free => at.values.dot(&self.values) / at.values.norm_squared().max(f64::MIN_POSITIVE),
            Exposure::Sum => self.sums.measured / at.sum.max(f64::MIN_POSITIVE),
        }
    }

    /// The model at exposure 1.
    fn predict(&self, reflectance: &[f64]) -> Prediction {
        let (terms, bands) = (self.model.terms(), reflectance.len());
        let mut at = Prediction {
            values: DVector::zeros(self.len()),
            slopes: DMatrix::zeros(self.len(), bands),
            sum: 0.0,
            sum_slopes: DVector::zeros(bands),
        };
        let (mut value, mut slope) = (DVector::zeros(terms), DVector::zeros(terms));
        for (band, r) in reflectance.iter().enumerate() {
            self.model.terms_at(*r, band, value.as_mut_slice(), slope.as_mut_slice());
            let mut row = 0;
            for (channel, models) in self.channels.iter().enumerate() {
                for ((source, compressed), sums) in
                    self.model.sources().iter().zip(&models.sources).zip(&self.sums.sources)
                {
                    let weight = source.camera.channel(channel)[band];
                    let rows = compressed.nrows();
                    at.values.rows_mut(row, rows).gemv(weight, compressed, &value, 1.0);
                    at.slopes
                        .view_mut((row, band), (rows, 1))
                        .column_mut(0)
                        .gemv(weight, compressed, &slope, 1.0);
                    at.sum += weight * sums.dot(&value);
                    at.sum_slopes[band] += weight * sums.dot(&slope);
                }
                row += models.sources[0].nrows();
            }
        }
        at
    }
}

/// Model values and their derivatives at exposure 1.
struct Prediction {
    values: DVector<f64>,
    slopes: DMatrix<f64>,
    sum: f64,
    sum_slopes: DVector<f64>,
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

fn sum_of_rows(matrix: &DMatrix<f64>, rows: &[usize]) -> DVector<f64> {
    rows.iter().fold(DVector::zeros(matrix.ncols()), |sum, row| sum + matrix.row(*row).transpose())
}

/// The terms at Chebyshev points of [0, 1]: term by sample.
fn sample_terms(model: &FacetModel) -> DMatrix<f64> {
    let mut samples = DMatrix::zeros(model.terms(), RANK_SAMPLES);
    let mut slopes = vec![0.0; model.terms()];
    for (n, mut column) in samples.column_iter_mut().enumerate() {
        let r = (std::f64::consts::FRAC_PI_4 * (2 * n + 1) as f64 / RANK_SAMPLES as f64).sin().powi(2);
        // 37 shares no factor with the usual numbers of wavebands: every reflectance meets another part of a card's spectrum.
        model.terms_at(r, 37 * n % model.bands(), column.as_mut_slice(), &mut slopes);
    }
    samples
}

/// Rotates data and models to the directions that reflectance can move by more than the noise.
fn compress(
    data: &DVector<f64>,
    sources: Vec<DMatrix<f64>>,
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
    let directions = nalgebra::SymmetricEigen::new(&reach * reach.transpose());
    let kept: Vec<_> = directions
        .eigenvalues
        .iter()
        .zip(directions.eigenvectors.column_iter())
        .filter(|(square, _)| **square > cutoff * cutoff)
        .map(|(_, direction)| direction)
        .collect();
    if kept.is_empty() {
        return (DVector::zeros(0), sources.iter().map(|source| source.rows(0, 0).into_owned()).collect());
    }
    let rotation = DMatrix::from_columns(&kept);
    let values = rotation.tr_mul(&q.tr_mul(data));
    (values, sources.iter().map(|source| rotation.tr_mul(source)).collect())
}
