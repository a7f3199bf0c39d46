//! Exposure of a photograph in the sun, inferred from the camera's settings.

use crate::estimate::photograph::priors::Priors;
use crate::estimate::unknowns::Normal;
use crate::spectrum::Sun;

/// Solar illuminance outside the atmosphere, klx, and the decrease of its logarithm per air mass in a clear
/// one.
const BEYOND_KLX: f64 = 127.5;
const EXTINCTION: f64 = 0.21;
/// Standard deviation of that extinction per air mass.
const EXTINCTION_SD: f64 = 0.1;
/// Assumed position of the sun if none is stated, degrees from the zenith.
const ZENITH_DEG: f64 = 45.0;

/// Logarithm of the value of a perfect white diffuser facing an unclouded sun, for a camera that gives it
/// `white_per_klx` under 1000 lx; a position of the sun is taken from `illuminant`. A low sun is less
/// certain, as its path through the air is long.
///
/// # Source
/// Illuminating Engineering Society of North America, *Lighting Handbook*, 9th ed. (2000), chapter 8: direct
/// illuminance under a clear sky.
#[must_use]
pub fn in_the_sun(white_per_klx: f64, illuminant: &str, priors: &Priors) -> Option<Normal> {
    let stated = illuminant.strip_prefix("sun:").and_then(|words| Sun::parse(words).ok());
    let air_mass = stated.or_else(|| Sun::at_zenith_deg(ZENITH_DEG).ok())?.air_mass();
    let ln_klx = BEYOND_KLX.ln() - EXTINCTION * air_mass;
    let sd = priors.exposure_metered_sd.hypot(EXTINCTION_SD * air_mass);
    Some(Normal { mean: white_per_klx.ln() + ln_klx, sd })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;

    fn klx(illuminant: &str) -> Normal {
        let Normal { mean, sd } = in_the_sun(1.0, illuminant, &Priors::USUAL).unwrap();
        Normal { mean: mean.exp(), sd }
    }

    /// Illuminance on a plane facing the sun, from tables of clear days: 100 klx at 60° above the horizon,
    /// about 60 klx at 15°.
    #[test]
    fn a_high_sun_gives_a_hundred_thousand_lux() {
        assert!((klx("sun:30deg").mean - 100.0).abs() < 3.0, "{:?}", klx("sun:30deg"));
        assert!((klx("sun:75deg").mean - 60.0).abs() < 5.0, "{:?}", klx("sun:75deg"));
        assert!(klx("sun:75deg").sd > 1.3 * klx("sun:30deg").sd);
        assert_eq!(klx("D65"), klx("sun:45deg"));
    }
}
