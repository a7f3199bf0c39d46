//! Numbers of eight bits in a container of more: a picture that a program converted, still with its curve.
//!
//! Without a statement on its curve, a container's depth implies one; here it would be the wrong one.

use std::path::Path;

use image::DynamicImage;

use crate::{Error, Result};

/// The steps of eight bits.
const STEPS: usize = 256;
/// So few distinct steps may be those of a drawing or a chart in any depth.
const FEW: usize = 16;
/// Units of 16 bits per step: all of their range, or bits shifted.
const UNITS: [u16; 2] = [257, 256];
/// Largest relative error of a number rounded to a half, which has 11 bits.
const HALF: f32 = 1.0 / 2048.0;

/// # Errors
/// [`Error::Picture`] if all samples of a deeper picture are steps of eight bits.
pub(super) fn refuse(path: &Path, picture: &DynamicImage) -> Result<()> {
    let (numbers, are_steps) = match picture {
        DynamicImage::ImageLuma16(samples) => ("16-bit numbers", are_integer_steps(samples)),
        DynamicImage::ImageLumaA16(samples) => ("16-bit numbers", are_integer_steps(samples)),
        DynamicImage::ImageRgb16(samples) => ("16-bit numbers", are_integer_steps(samples)),
        DynamicImage::ImageRgba16(samples) => ("16-bit numbers", are_integer_steps(samples)),
        DynamicImage::ImageRgb32F(samples) => ("floats", are_steps(samples, step_of_float)),
        DynamicImage::ImageRgba32F(samples) => ("floats", are_steps(samples, step_of_float)),
        _ => return Ok(()),
    };
    if !are_steps {
        return Ok(());
    }
    let problem = format!(
        "its {numbers} are those of 8 bits: it was converted from a JPEG or another 8-bit picture, \
         but does not state its curve"
    );
    let remedy = "give the RAW file, or state with --transfer srgb or linear how to read its numbers";
    Err(Error::picture(path, problem, remedy))
}

fn are_integer_steps(samples: &[u16]) -> bool {
    let step = |sample: u16, unit: u16| sample.is_multiple_of(unit).then_some((sample / unit).into());
    UNITS.into_iter().any(|unit| are_steps(samples, |sample| step(sample, unit)))
}

/// The step that this is when divided by 255, rounded to a float or a half.
fn step_of_float(sample: f32) -> Option<usize> {
    let steps = 255.0 * sample;
    let step = steps.round();
    let is_step = (0.0..=255.0).contains(&step) && (steps - step).abs() <= HALF * step;
    is_step.then_some(step as usize)
}

/// Whether all samples are steps, and more than a few of these occur.
fn are_steps<T: Copy>(samples: &[T], step: impl Fn(T) -> Option<usize>) -> bool {
    let mut occurs = [false; STEPS];
    for sample in samples {
        match step(*sample) {
            Some(step) => occurs[step] = true,
            None => return false,
        }
    }
    occurs.into_iter().filter(|occurs| *occurs).count() > FEW
}

#[cfg(test)]
mod tests {
    use half::f16;
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn conversions_of_eight_bits_are_found(mut bytes in prop::collection::vec(any::<u8>(), 100)) {
            bytes.extend(0..=FEW as u8);
            for unit in UNITS {
                let numbers: Vec<u16> = bytes.iter().map(|byte| u16::from(*byte) * unit).collect();
                prop_assert!(are_integer_steps(&numbers));
            }
            let floats: Vec<f32> = bytes.iter().map(|byte| f32::from(*byte) / 255.0).collect();
            let halves: Vec<f32> = floats.iter().map(|float| f16::from_f32(*float).to_f32()).collect();
            prop_assert!(are_steps(&floats, step_of_float) && are_steps(&halves, step_of_float));
        }

        /// Halves near 1 are themselves coarse: one in four is a step.
        #[test]
        fn deeper_numbers_are_others(numbers in prop::collection::vec(0.5..1.0_f32, 100)) {
            let halves: Vec<f32> = numbers.iter().map(|number| f16::from_f32(*number).to_f32()).collect();
            prop_assert!(!are_steps(&halves, step_of_float));
            let integers: Vec<u16> = numbers.iter().map(|number| (65535.0 * number) as u16).collect();
            prop_assert!(!are_integer_steps(&integers));
        }
    }

    #[test]
    fn a_few_tones_are_no_evidence() {
        let tones: Vec<u16> = (0..FEW as u16).map(|step| step * 257).collect();
        assert!(!are_integer_steps(&tones.repeat(99)));
        assert!(!are_integer_steps(&[]) && !are_steps(&[f32::NAN], step_of_float));
    }
}
