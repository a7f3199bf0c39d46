//! From radiances of facets to values: the camera, and light that varies along the crease.

use nalgebra::DMatrix;

use super::conditions::Conditions;
use super::corners::width;
use super::lighting::Lighting;
use super::parts::{Parts, Place};

/// Exposure, gains, fall-off of the light, vignetting and glare.
pub struct Lens {
    /// Value of each facet and channel for radiance 1: facet by channel.
    scale: DMatrix<f64>,
    /// Share of a channel's mean that is spread over all facets.
    veiling_glare: f64,
}

impl Lens {
    /// For a photograph taken under these conditions in this light.
    #[must_use]
    pub fn new(parts: &Parts, conditions: &Conditions, lighting: &Lighting) -> Self {
        let brightness = lighting.exposure(parts, conditions) * lighting.gains(parts, conditions);
        let width = width(&parts.places);
        let uneven = |place: &Place| {
            (1.0 + conditions.fall_off * (0.5 - place.along / width))
                * (1.0 - conditions.vignetting * place.off_centre)
        };
        let mut scale = DMatrix::zeros(parts.places.len(), brightness.len());
        for (column, brightness) in scale.as_mut_slice().chunks_exact_mut(parts.places.len()).zip(&brightness)
        {
            for (scale, place) in column.iter_mut().zip(&parts.places) {
                *scale = brightness * uneven(place);
            }
        }
        Self { scale, veiling_glare: conditions.veiling_glare }
    }

    /// Converts radiances to values: facet by channel.
    #[must_use]
    pub fn seen(&self, mut radiances: DMatrix<f64>) -> DMatrix<f64> {
        let facets = radiances.nrows();
        for (channel, radiances) in radiances.as_mut_slice().chunks_exact_mut(facets).enumerate() {
            self.see(channel, radiances);
        }
        radiances
    }

    /// Converts the radiances of all facets in one channel to values.
    pub fn see(&self, channel: usize, radiances: &mut [f64]) {
        let facets = radiances.len();
        let mut sum = 0.0;
        for (value, scale) in radiances.iter_mut().zip(&self.scale.as_slice()[channel * facets..]) {
            *value *= scale;
            sum += *value;
        }
        let spread = self.veiling_glare * sum / facets as f64;
        radiances.iter_mut().for_each(|value| *value += spread);
    }
}
