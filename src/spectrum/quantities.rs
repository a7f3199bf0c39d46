//! What a spectrum must be to be used as a reflectance, an illuminant or a sensitivity.

use super::Spectrum;
use crate::error::{Error, Result};

/// Negative sensitivities up to this fraction of the peak are measurement noise about zero.
const NOISE_OF_PEAK: f64 = 1e-3;

/// What the channels of a camera see of each wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivities {
    /// The SPEC the camera was named by.
    pub name: String,
    /// Relative sensitivities, 0 or more, all on one scale; one or more channels, R, G and B in the built-in
    /// ones.
    pub channels: Vec<Spectrum>,
}

impl Sensitivities {
    /// The camera of these channels.
    ///
    /// # Errors
    /// [`Error::Spectrum`] if a sensitivity is below 0 by more than a thousandth of the camera's peak, which
    /// is taken for noise and set to 0, or zero throughout.
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
        2.0.. => "rescale it to fractions or percent",
        _ => "leave out fluorescent samples, rescale wrongly scaled ones",
    };
    Err(bad(spectrum.name(), format!("reflectance {value} is outside 0..1"), remedy))
}

/// Refuses values below 0: a sheet may send out more light than white does.
pub(super) fn check_radiance_factor(spectrum: &Spectrum) -> Result<()> {
    match spectrum.values().iter().find(|value| **value < 0.0) {
        Some(value) => {
            let problem = format!("{value} is below 0, where a part of white's light is wanted");
            Err(bad(spectrum.name(), problem, "set negative noise to 0"))
        }
        None => Ok(()),
    }
}

/// Refuses values below `least`, and darkness.
pub(super) fn check_power(spectrum: &Spectrum, least: f64) -> Result<()> {
    if let Some(value) = spectrum.values().iter().find(|value| **value < least) {
        return Err(bad(spectrum.name(), format!("{value} is below 0"), "give values of 0 or more"));
    }
    if !spectrum.values().iter().any(|value| *value > 0.0) {
        return Err(bad(
            spectrum.name(),
            "it is zero at every wavelength",
            "give a positive value somewhere",
        ));
    }
    Ok(())
}

/// An error about a spectrum.
pub(super) fn bad(name: &str, problem: impl Into<String>, remedy: impl Into<String>) -> Error {
    Error::Spectrum { name: name.to_owned(), problem: problem.into(), remedy: remedy.into() }
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
