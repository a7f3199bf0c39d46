//! Black level, white level and curve of a picture, which define its stored numbers.

use super::development::Development;
use super::transfer::Transfer;
use crate::{Error, Result};

/// How to interpret the stored numbers of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ReadOptions {
    /// The curve they follow.
    pub transfer: Transfer,
    /// The stored number for no light; by default 0.
    pub black_level: Option<f64>,
    /// The stored number for 1, at and above which a sample is clipped. By default 255 or 65535 for integers;
    /// for floats 1, without clipping.
    pub white_level: Option<f64>,
    /// White balance and matrix from camera RGB to linear sRGB, to be undone.
    pub development: Option<Development>,
}

/// The meaning of a stored number v: the curve's value at (v - black)/(white - black).
#[derive(Debug, Clone, Copy)]
pub(in crate::image) struct Scale {
    pub transfer: Transfer,
    pub black: f64,
    pub white: f64,
    clipped_from: f64,
    /// Integers of a developed picture up to this are clipped: its matrix yields negative numbers, stored as
    /// zero.
    clipped_to: f64,
    bits: u32,
}

/// The light of a clipped number.
const CLIPPED: f64 = f64::INFINITY;

impl Scale {
    /// Floats that are already linear light.
    pub const LINEAR: Self = Self {
        transfer: Transfer::Linear,
        black: 0.0,
        white: 1.0,
        clipped_from: f64::INFINITY,
        clipped_to: f64::NEG_INFINITY,
        bits: 32,
    };

    /// The scale of a picture of 8 or 16 bits (integers) or 32 (floats).
    pub fn new(options: &ReadOptions, bits: u32) -> Result<Self> {
        let full_scale = if bits == 32 { 1.0 } else { f64::from((1_u32 << bits) - 1) };
        let black = options.black_level.unwrap_or(0.0);
        let white = options.white_level.unwrap_or(full_scale);
        if !(black.is_finite() && white.is_finite() && white > black) {
            return Err(Error::usage(
                "--white-level",
                format!("the white level {white} is not above the black level {black}"),
                "give both in the file's own numbers, 0 to 255 or to 65535 for integers",
            ));
        }
        let clipped_from = match options.white_level {
            None if bits == 32 => f64::INFINITY,
            Some(white) if bits == 32 => white,
            _ => white.min(full_scale),
        };
        let clipped_to = if bits == 32 || options.development.is_none() { f64::NEG_INFINITY } else { 0.0 };
        let transfer = options.transfer.resolve(bits);
        Ok(Self { transfer, black, white, clipped_from, clipped_to, bits })
    }

    /// The same, but clipped at and above this stored number.
    pub fn ending_at(self, stored: f64) -> Self {
        Self { clipped_from: self.clipped_from.min(stored), ..self }
    }

    /// The same, with this stored number for no light. If it is above white, as for floats that are a
    /// sensor's numbers, white moves up with it.
    pub fn with_black(self, black: f64) -> Self {
        let white = if self.white > black { self.white } else { black + self.white - self.black };
        Self { black, white, ..self }
    }

    /// Whether a stored number is clipped.
    pub fn is_clipped(&self, stored: f64) -> bool {
        stored >= self.clipped_from
    }

    /// Linear light of a stored number; infinite if it is clipped, NaN if it is not finite.
    pub fn linear(&self, stored: f64) -> f64 {
        if !stored.is_finite() {
            f64::NAN
        } else if stored >= self.clipped_from || stored <= self.clipped_to {
            CLIPPED
        } else {
            self.transfer.to_linear((stored - self.black) / (self.white - self.black))
        }
    }

    /// Linear light of every integer of 8 or 16 bits; empty for floats.
    pub fn table(&self) -> Vec<f64> {
        let integers = if self.bits == 32 { 0 } else { 1_u32 << self.bits };
        (0..integers).map(|stored| self.linear(stored.into())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_in_stored_numbers() {
        let options =
            ReadOptions { black_level: Some(512.0), white_level: Some(15871.0), ..ReadOptions::default() };
        let scale = Scale::new(&options, 16).unwrap();
        let table = scale.table();
        assert_eq!((table[512], table[15871]), (0.0, CLIPPED));
        assert!((table[15870] - 15358.0 / 15359.0).abs() < 1e-15);
        assert!((table[0] + 512.0 / 15359.0).abs() < 1e-15, "noise below black must not be cut off");
    }

    #[test]
    fn floats_are_clipped_only_at_a_given_level() {
        assert!((Scale::new(&ReadOptions::default(), 32).unwrap().linear(1e9) - 1e9).abs() < 1.0);
        let options = ReadOptions { white_level: Some(2.0), ..ReadOptions::default() };
        let scale = Scale::new(&options, 32).unwrap();
        assert!((scale.linear(1.0) - 0.5).abs() < 1e-15 && scale.linear(2.0).is_infinite());
        assert!(scale.linear(f64::INFINITY).is_nan());
    }

    #[test]
    fn white_must_be_above_black() {
        let options =
            |black, white| ReadOptions { black_level: black, white_level: white, ..ReadOptions::default() };
        for bad in [options(Some(300.0), None), options(None, Some(f64::NAN)), options(Some(9.0), Some(9.0))]
        {
            assert_eq!(Scale::new(&bad, 8).unwrap_err().exit_status(), 2);
        }
    }
}
