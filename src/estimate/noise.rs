//! How far each facet may be off: its noise, and what the model leaves out.

use nalgebra::{DMatrix, DVector};

use crate::error::{Error, Result};
use crate::forward::{FacetModel, FacetValues};
use crate::solve::Eigen;

/// Noise that computed facets have all the same: what rounding and the scene's tolerance leave, relative to
/// the brightest.
const FLOOR: f64 = 1e-6;

/// Directions in which the terms move facets by less than the root of that share of the most are rounding.
const ROUNDING: f64 = 1e-13;

/// What an estimate takes facets to be worth.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// The part that is the facets' own.
    pub source: NoiseSource,
    /// Error of the model, relative to a facet's value.
    pub model_error: f64,
}

/// What tells the noise of facets.
#[derive(Clone, Debug, PartialEq)]
pub enum NoiseSource {
    /// All have this standard deviation, white being 1.
    Stated(f64),
    /// Each has its own.
    OfFacets(FacetValues),
    /// The facets, by what no reflectance explains of them.
    Unexplained,
}

impl Noise {
    /// Error of the model, relative to the facet's value, where none was given: what a real fold does that
    /// the model does not.
    #[must_use]
    pub fn model_error(is_photograph: bool) -> f64 {
        if is_photograph { 3e-4 } else { 0.0 }
    }

    /// Standard deviations of facets `rgb`.
    ///
    /// # Errors
    /// [`Error::Field`] if those of the noise are of another number of facets.
    pub fn deviations(&self, model: &FacetModel, rgb: &FacetValues) -> Result<FacetValues> {
        let of_channels = |noise: &[f64], channel: usize| noise.get(channel).copied().unwrap_or(0.0);
        match &self.source {
            NoiseSource::Stated(sd) => Ok(deviations(rgb, |_| *sd, self.model_error)),
            NoiseSource::OfFacets(sd) => {
                if sd.len() != rgb.len() {
                    let problem = format!("{} facets, but facet_rgb has {}", sd.len(), rgb.len());
                    return Err(Error::field("facet_sd", problem));
                }
                // facets of so few pixels that their noise is not known are no better than the others
                let most = match sd.channels() {
                    0 => unexplained(model, rgb),
                    channels => (0..channels).map(|channel| greatest(sd, channel)).collect(),
                };
                let noise = |[facet, channel]: [usize; 2]| {
                    sd.get(facet, channel).unwrap_or_else(|| of_channels(&most, channel))
                };
                Ok(deviations(rgb, noise, self.model_error))
            }
            NoiseSource::Unexplained => {
                let noise = unexplained(model, rgb);
                Ok(deviations(rgb, |[_, channel]| of_channels(&noise, channel), self.model_error))
            }
        }
    }
}

/// The greatest value of a channel.
fn greatest(values: &FacetValues, channel: usize) -> f64 {
    values.facets().flatten().map(|facet| facet[channel]).fold(0.0, f64::max)
}

/// Standard deviations of facets `rgb`: their noise as `noise_sd` has it for a facet and channel,
/// `model_error` relative to the facet's value, and a millionth of the brightest facet, in quadrature.
#[must_use]
pub fn deviations(rgb: &FacetValues, noise_sd: impl Fn([usize; 2]) -> f64, model_error: f64) -> FacetValues {
    let floor = FLOOR * rgb.greatest();
    rgb.map(|place, value| noise_sd(place).hypot(model_error * value).hypot(floor))
}

/// Noise of each channel, from the facets alone: the root mean square of what no reflectance explains.
///
/// All reflectances move the facets within the span of the model's terms; of hundreds of facets all but a
/// dozen directions are noise. Zero where the terms can be any facets.
#[must_use]
pub fn unexplained(model: &FacetModel, rgb: &FacetValues) -> Vec<f64> {
    let usable: Vec<usize> = (0..rgb.len().min(model.sources()[0].facets.nrows()))
        .filter(|facet| rgb.facet(*facet).is_some())
        .collect();
    let columns: Vec<DVector<f64>> = model
        .sources()
        .iter()
        .flat_map(|source| source.facets.column_iter())
        .map(|column| DVector::from_iterator(usable.len(), usable.iter().map(|facet| column[*facet])))
        .collect();
    let channels = model.sources()[0].camera.channels();
    if usable.is_empty() {
        return vec![0.0; channels];
    }
    let span = span(&columns);
    let freedom = usable.len() - span.ncols();
    let noise = |channel: usize| {
        let value = |facet: &usize| rgb.get(*facet, channel).unwrap_or(0.0);
        let data = DVector::from_iterator(usable.len(), usable.iter().map(value));
        let left = &data - &span * span.tr_mul(&data);
        if freedom == 0 { 0.0 } else { (left.norm_squared() / freedom as f64).sqrt() }
    };
    (0..channels).map(noise).collect()
}

/// Orthonormal vectors that the columns are made of, fewer than them by far: the terms of neighbouring folds
/// are much alike.
fn span(columns: &[DVector<f64>]) -> DMatrix<f64> {
    // By terms, not by facets: there are ten times as many of these.
    let (q, r) = DMatrix::from_columns(columns).qr().unpack();
    let Eigen { values, vectors } = Eigen::of_symmetric(&r * r.transpose());
    let least = ROUNDING * values.iter().copied().fold(0.0, f64::max);
    let kept: Vec<usize> = (0..values.len()).filter(|n| values[*n] > least).collect();
    q * vectors.select_columns(&kept)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::CameraResponse;
    use crate::forward::Lighting;
    use crate::geometry::{FacetGrid, Fold, Light};
    use crate::kernel::mesh::respond;
    use crate::spectrum::WavelengthGrid;

    #[test]
    fn facets_of_unknown_noise_are_not_believed_more_than_others() {
        let fold = Fold::new(50.0, 1.0, 1.0, FacetGrid { rows: 3, cols: 1 }).unwrap();
        let (response, _) = respond(&fold, 1e-3).unwrap();
        let grid = WavelengthGrid::new(vec![500.0, 600.0]).unwrap();
        let eye = CameraResponse::new(&grid, &[vec![1.0, 1.0]], &[1.0, 1.0]).unwrap();
        let light = Light::new(&fold, 0.0, 0.0, 0.0).unwrap();
        let model = FacetModel::one_sheet(&response, &Lighting { light, sun: eye.clone(), sky: eye });
        let rows = |values: [Option<f64>; 6]| {
            FacetValues::of_rows(&values.map(|value| value.map(|value| vec![value]))).unwrap()
        };
        let rgb = rows([0.5, 0.6, 0.4, 0.5, 0.6, 0.4].map(Some));
        let sd_of = |sd| {
            let noise = Noise { source: NoiseSource::OfFacets(rows(sd)), model_error: 0.0 };
            noise.deviations(&model, &rgb).unwrap()
        };
        let sd = sd_of([Some(0.01), None, Some(0.02), Some(0.01), Some(0.01), Some(0.01)]);
        assert!((sd.get(1, 0).unwrap() - 0.02).abs() < 1e-9, "{sd:?}");
        // where nothing is said of any, what no reflectance explains tells
        let noise = Noise { source: NoiseSource::Unexplained, model_error: 0.0 };
        assert_eq!(sd_of([None; 6]), noise.deviations(&model, &rgb).unwrap());
    }
}
