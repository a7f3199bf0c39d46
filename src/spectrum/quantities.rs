//! Requirements on a spectrum used as a reflectance, an illuminant or a sensitivity.

use super::Spectrum;
use crate::error::{Error, Result};

/// Negative sensitivities up to this fraction of the peak are noise around zero.
const NOISE_OF_PEAK: f64 = 1e-3;

/// Spectral sensitivities of the channels of a camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivities {
    /// The SPEC of the camera.
    pub name: String,
    /// Relative sensitivities, 0 or more, on a common scale; one or more channels, R, G and B in built-in
    /// cameras.
    pub channels: Vec<Spectrum>,
}

impl Sensitivities {
    /// A camera with these channels.
    ///
    /// # Errors
    /// [`Error::Spectrum`] if a channel is zero throughout, or a sensitivity is below 0 by more than a
    /// thousandth of the camera's peak. Smaller negative values are noise and set to 0.
    ///
    /// # Example
    /// ```
    /// use vfold::spectrum::{Sensitivities, Spectrum};
    /// let channel = Spectrum::new("Y", vec![400.0, 700.0], vec![1.0, -0.0005])?;
    /// assert_eq!(Sensitivities::new("grey", vec![channel])?.channels[0].values(), [1.0, 0.0]);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(name: &str, mut channels: Vec<Spectrum>) -> Result<Self> {
        let peak = channels.iter().flat_map(Spectrum::values).copied().fold(0.0, f64::max);
        for channel in &mut channels {
            check_power(channel, -NOISE_OF_PEAK * peak)?;
            channel.values.iter_mut().for_each(|value| *value = value.max(0.0));
        }
        Ok(Self { name: name.to_owned(), channels })
    }
}

/// Refuses values outside 0..1.
pub(super) fn check_reflectance(spectrum: &Spectrum) -> Result<()> {
    let Some(&value) = spectrum.values().iter().find(|value| !(0.0..=1.0).contains(*value)) else {
        return Ok(());
    };
    let remedy = match value {
        ..0.0 => "set negative noise to 0",
        2.0.. => "give fractions from 0 to 1, or a file in percent with --percent",
        _ => "leave out fluorescent samples, or rescale wrongly scaled ones",
    };
    Err(Error::spectrum(spectrum.name(), format!("reflectance {value} is outside 0..1"), remedy))
}

/// Refuses values below 0; a sheet may send out more light than white.
pub(super) fn check_radiance_factor(spectrum: &Spectrum) -> Result<()> {
    match spectrum.values().iter().find(|value| **value < 0.0) {
        Some(value) => {
            let problem = format!("{value} is below 0, but a fraction of white's light is needed");
            Err(Error::spectrum(spectrum.name(), problem, "set negative noise to 0"))
        }
        None => Ok(()),
    }
}

/// Refuses values below `least`, and spectra without any power.
pub(super) fn check_power(spectrum: &Spectrum, least: f64) -> Result<()> {
    if let Some(value) = spectrum.values().iter().find(|value| **value < least) {
        return Err(Error::spectrum(
            spectrum.name(),
            format!("{value} is below 0"),
            "give values of 0 or more",
        ));
    }
    if !spectrum.values().iter().any(|value| *value > 0.0) {
        return Err(Error::spectrum(
            spectrum.name(),
            "it is zero at every wavelength",
            "give a positive value somewhere",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sensor_noise_below_zero_is_cut() {
        let camera = |lowest| {
            let channel = Spectrum::new("R", vec![400.0, 700.0], vec![lowest, 1.0]).unwrap();
            Sensitivities::new("camera", vec![channel])
        };
        assert_eq!(camera(-0.0009).unwrap().channels[0].values(), [0.0, 1.0]);
        assert!(camera(-0.0011).is_err());
    }
}
