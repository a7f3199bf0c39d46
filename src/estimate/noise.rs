//! Uncertainty of each facet: its noise, and the error of the model.

use nalgebra::{DMatrix, DVector};

use crate::error::{Error, Result, counted};
use crate::forward::{FacetModel, FacetValues};
use crate::solve::Eigen;

/// Noise assigned to computed facets, relative to the brightest: rounding errors and the scene's tolerance.
const FLOOR: f64 = 1e-6;

/// Directions in which the terms move facets by less than the root of this share of the largest are rounding
/// errors.
const ROUNDING: f64 = 1e-13;

/// The noise that an estimate assumes.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// The noise of the facets themselves.
    pub source: NoiseSource,
    /// Error of the model, relative to a facet's value.
    pub model_error: f64,
}

/// Source of the facets' noise.
#[derive(Clone, Debug, PartialEq)]
pub enum NoiseSource {
    /// The same standard deviation for all, relative to white.
    Stated(f64),
    /// An individual standard deviation for each.
    OfFacets(FacetValues),
    /// Inferred from the part of the facets that no reflectance explains.
    Unexplained,
}

impl Noise {
    /// Default error of the model, relative to a facet's value: effects of a real fold that the model lacks.
    #[must_use]
    pub fn model_error(is_photograph: bool) -> f64 {
        if is_photograph { 3e-4 } else { 0.0 }
    }

    /// Standard deviations of facets `rgb`.
    ///
    /// # Errors
    /// [`Error::Field`] if the standard deviations belong to another number of facets.
    pub fn deviations(&self, model: &FacetModel, rgb: &FacetValues) -> Result<FacetValues> {
        let of_channels = |noise: &[f64], channel: usize| noise.get(channel).copied().unwrap_or(0.0);
        match &self.source {
            NoiseSource::Stated(sd) => Ok(deviations(rgb, |_| *sd, self.model_error)),
            NoiseSource::OfFacets(sd) => {
                if sd.len() != rgb.len() {
                    let problem = format!("{}, but facet_rgb has {}", counted(sd.len(), "facet"), rgb.len());
                    return Err(Error::field("facet_sd", problem));
                }
                // facets with too few pixels to determine their noise are as uncertain as the noisiest one
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

/// Standard deviations of facets `rgb`: `noise_sd` of a facet and channel, `model_error` relative to the
/// facet's value, and a millionth of the brightest facet, in quadrature.
#[must_use]
pub fn deviations(rgb: &FacetValues, noise_sd: impl Fn([usize; 2]) -> f64, model_error: f64) -> FacetValues {
    let floor = FLOOR * rgb.greatest();
    rgb.map(|place, value| noise_sd(place).hypot(model_error * value).hypot(floor))
}

/// Noise of each channel, inferred from the facets alone: the root mean square of what no reflectance
/// explains.
///
/// All reflectances move the facets within the span of the model's terms; among hundreds of facets, all but a
/// dozen directions are noise. Zero if the terms span all facets.
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

/// Orthonormal basis of the columns' span, which is much smaller than their number: the terms of neighbouring
/// folds are very similar.
fn span(columns: &[DVector<f64>]) -> DMatrix<f64> {
    // Works in the space of terms rather than facets, of which there are ten times as many.
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
        // where no facet has a known noise, it is inferred from what no reflectance explains
        let noise = Noise { source: NoiseSource::Unexplained, model_error: 0.0 };
        assert_eq!(sd_of([None; 6]), noise.deviations(&model, &rgb).unwrap());
    }
}
