//! How much light excites brighteners, and where they absorb it.

use nalgebra::DVector;

use super::bands::BRIGHTENER;

/// Wavelength below which a brightener absorbs (A. E. Siegrist et al., "Optical brighteners"), and the
/// distance from it, at 400 nm, over which the logits fall by the amount of the fall.
const FALL_NM: f64 = 430.0;
const FALL_WITHIN_NM: f64 = 30.0;
/// Wavelength from which on power below [`FALL_NM`] stands for all that excites brighteners, and that power
/// relative to the power near the peak of emission in daylight of 6500 K. Incandescent lamps have two thirds
/// of it, and of daylight's ultraviolet, fluorescent lamps three tenths to a half, white LEDs a tenth at
/// most, unless violet ones excite their phosphors.
const EXCITING_NM: f64 = 400.0;
const EXCITING_DAYLIGHT: f64 = 0.9;
/// Lights of less than this share of it are taken to excite no brightener: a usual one would emit less than
/// two per cent of white at the peak.
const LEAST_EXCITATION: f64 = 0.2;
/// Standard deviation of the weights with which power near a wavelength is averaged, nm: wide enough for
/// the lines of a lamp to count alike in wavebands of 5 and of 20 nm.
const NEAR_SD_NM: f64 = 8.0;

/// How much of light with this `power` excites brighteners, relative to daylight, at most 1.
pub(super) fn excitation(wavelengths_nm: &DVector<f64>, power: &DVector<f64>) -> f64 {
    let absorbed = wavelengths_nm.map(|nm| if nm < EXCITING_NM { 0.0 } else { (FALL_NM - nm).max(0.0) });
    let at_peak = power_near(BRIGHTENER.peak_nm(), wavelengths_nm, power);
    let exciting = power.dot(&absorbed) / absorbed.sum();
    // wavebands that begin further on say nothing
    if absorbed.sum() > 0.0 { (exciting / at_peak / EXCITING_DAYLIGHT).min(1.0) } else { 1.0 }
}

/// True if light of this `excitation` excites brighteners at all.
pub(super) fn is_enough(excitation: f64) -> bool {
    excitation >= LEAST_EXCITATION
}

/// Mean of `power` near a wavelength, or of the nearest wavebands.
pub(super) fn power_near(nm: f64, wavelengths_nm: &DVector<f64>, power: &DVector<f64>) -> f64 {
    let squares = wavelengths_nm.map(|own_nm| ((own_nm - nm) / NEAR_SD_NM).powi(2));
    let nearest = squares.min();
    let weights = squares.map(|square| (-0.5 * (square - nearest)).exp());
    power.dot(&weights) / weights.sum()
}

/// Change of the logits of reflectance per unit of a band's fall.
pub(super) fn falling(wavelengths_nm: &DVector<f64>) -> DVector<f64> {
    wavelengths_nm.map(|nm| -(FALL_NM - nm).max(0.0) / FALL_WITHIN_NM)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Outside, WavelengthGrid, spec};

    #[test]
    fn lamps_excite_alike_on_fine_and_coarse_wavebands() {
        let of = |light: &str, step_nm: f64| {
            let count = (300.0 / step_nm).round() as usize;
            let grid =
                WavelengthGrid::new((0..=count).map(|n| 400.0 + step_nm * n as f64).collect()).unwrap();
            let power = spec::illuminant(light).unwrap().on(&grid, Outside::Zero).unwrap();
            excitation(&grid.wavelengths_nm().to_vec().into(), &power.into())
        };
        for step_nm in [5.0, 10.0, 20.0] {
            let [daylight, tungsten] = ["D65", "A"].map(|light| of(light, step_nm));
            assert!(daylight > 0.87 && (0.6..0.75).contains(&tungsten), "{step_nm}: {daylight}, {tungsten}");
            for tube in ["FL2", "FL7", "FL11", "FL12"] {
                let [fine, own] = [5.0, step_nm].map(|step_nm| of(tube, step_nm));
                assert!(is_enough(own) && (own / fine - 1.0).abs() < 0.1, "{tube}, {step_nm} nm: {own}");
            }
            for led in ["LED-B1", "LED-B3", "LED-B5", "LED-RGB1"] {
                assert!(!is_enough(of(led, step_nm)), "{led}, {step_nm} nm");
            }
        }
    }
}
