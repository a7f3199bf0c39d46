//! From spectra of light to a camera's values, and sensitivities of cameras that were not measured.

mod from_chart;
mod measured;
mod predicted;
mod stand_in;

pub use from_chart::{ChartCamera, ChartPatch};
pub use measured::{KnownSensitivities, known_sensitivities, sensitivity_error};
pub use predicted::{ColourMatrix, PREDICTED_ERROR, PredictedLeftOut, Predictor};
pub use stand_in::{LeftOut, StandIn, StandIns, Why};

use crate::error::{Error, Result};
use crate::spectrum::WavelengthGrid;

/// The response of each channel of a camera to each waveband under one illuminant, or several, one picture
/// each.
///
/// `weights[c][l]` is `w_l C_c(λ_l) I(λ_l)`, including the trapezoid rule over the grid, scaled so that a
/// perfect white diffuser facing the light gives 1 in the reference channel. The channels of several pictures
/// follow each other.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraResponse {
    weights: Vec<Vec<f64>>,
    /// One per picture, counted from that picture's first channel.
    reference_channels: Vec<usize>,
}

impl CameraResponse {
    /// The response of `sensitivities` (channel by waveband) to `illuminant` (power per waveband) on `grid`;
    /// the reference channel is the one with the largest value of white.
    ///
    /// # Source
    /// Deeb et al., eqs. (17) and (18).
    ///
    /// # Errors
    /// [`Error::Numeric`] if a channel does not respond to the illuminant.
    ///
    /// # Example
    /// ```
    /// use vfold::camera::CameraResponse;
    /// use vfold::spectrum::WavelengthGrid;
    /// let grid = WavelengthGrid::uniform(400.0, 700.0, 100.0)?;
    /// let response = CameraResponse::new(&grid, &[vec![1.0; 4], vec![0.5; 4]], &[1.0; 4])?;
    /// assert_eq!(response.white(), [1.0, 0.5]);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(grid: &WavelengthGrid, sensitivities: &[Vec<f64>], illuminant: &[f64]) -> Result<Self> {
        let response = Self::unscaled(grid, sensitivities, illuminant);
        let white = response.white();
        if let Some(blind) = white.iter().position(|white| !(*white > 0.0 && white.is_finite())) {
            return Err(Error::Numeric(format!(
                "camera channel {blind} does not respond to the illuminant on {grid}; check both spectra"
            )));
        }
        let strongest = (0..white.len()).max_by(|a, b| white[*a].total_cmp(&white[*b])).unwrap_or(0);
        Ok(response.with_reference(strongest))
    }

    /// A response with these weights; channel 0 is the reference.
    #[must_use]
    pub fn from_weights(weights: Vec<Vec<f64>>) -> Self {
        Self { weights, reference_channels: vec![0] }
    }

    /// Combines the responses to several illuminants, with the channels of all.
    ///
    /// # Example
    /// ```
    /// use vfold::camera::CameraResponse;
    /// let red = CameraResponse::from_weights(vec![vec![0.75, 0.25], vec![0.25, 0.25]]);
    /// let blue = CameraResponse::from_weights(vec![vec![0.0, 0.25], vec![0.25, 0.75]]);
    /// assert_eq!(CameraResponse::of_pictures([red, blue]).white(), [1.0, 0.5, 0.25, 1.0]);
    /// ```
    #[must_use]
    pub fn of_pictures(pictures: impl IntoIterator<Item = Self>) -> Self {
        let (mut weights, mut reference_channels) = (Vec::new(), Vec::new());
        for picture in pictures {
            weights.extend(picture.weights);
            reference_channels.extend(picture.reference_channels);
        }
        Self { weights, reference_channels }
    }

    /// The response to another light, scaled in each picture to give 1 in its reference channel.
    ///
    /// # Errors
    /// [`Error::Numeric`] if that channel does not respond to it.
    pub fn to_other_light(
        &self,
        grid: &WavelengthGrid,
        sensitivities: &[Vec<f64>],
        light: &[f64],
    ) -> Result<Self> {
        let picture = |channel: &usize| Self::unscaled(grid, sensitivities, light).with_reference(*channel);
        let other = Self::of_pictures(self.reference_channels.iter().map(picture));
        if other.white().iter().all(|white| white.is_finite()) {
            Ok(other)
        } else {
            Err(Error::Numeric(
                "the camera's strongest channel does not respond to one of the lights; \
                 check --illuminant and --sky-illuminant"
                    .to_owned(),
            ))
        }
    }

    fn unscaled(grid: &WavelengthGrid, sensitivities: &[Vec<f64>], light: &[f64]) -> Self {
        let width = grid.trapezoid_weights_nm();
        let channel = |sensitivity: &Vec<f64>| {
            sensitivity.iter().zip(light).zip(&width).map(|((c, i), w)| c * i * w).collect()
        };
        Self { weights: sensitivities.iter().map(channel).collect(), reference_channels: vec![0] }
    }

    fn with_reference(mut self, channel: usize) -> Self {
        let scale = self.white()[channel].recip();
        self.weights.iter_mut().flatten().for_each(|weight| *weight *= scale);
        self.reference_channels = vec![channel];
        self
    }

    /// Channel values of a perfect white diffuser facing the light.
    #[must_use]
    pub fn white(&self) -> Vec<f64> {
        self.weights.iter().map(|channel| channel.iter().sum()).collect()
    }

    /// Channel values of a flat sheet of this reflectance, one number per waveband, facing the light.
    #[must_use]
    pub fn of_flat(&self, reflectance: &[f64]) -> Vec<f64> {
        let value = |channel: &Vec<f64>| channel.iter().zip(reflectance).map(|(w, r)| w * r).sum();
        self.weights.iter().map(value).collect()
    }

    /// The channel in which white is 1; with several pictures, that of the first.
    #[must_use]
    pub fn reference_channel(&self) -> usize {
        self.reference_channels[0]
    }

    /// Number of channels of all pictures together.
    #[must_use]
    pub fn channels(&self) -> usize {
        self.weights.len()
    }

    /// Number of wavebands.
    #[must_use]
    pub fn bands(&self) -> usize {
        self.weights[0].len()
    }

    /// Whether any channel responds to a waveband.
    #[must_use]
    pub fn sees(&self, band: usize) -> bool {
        self.weights.iter().any(|channel| channel[band] != 0.0)
    }

    /// Weights of one channel, one number per waveband.
    #[must_use]
    pub fn channel(&self, channel: usize) -> &[f64] {
        &self.weights[channel]
    }
}
