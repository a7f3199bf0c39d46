//! Values of flags.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use vfold::estimate::Exposure;
use vfold::estimate::unknowns::{self, Flag, NONE};

/// The built-in prior, the default.
pub const SHEETS: &str = "sheets";
/// The set with known classes, and the default basis of the methods for flat sheets.
pub const MUNSELL: &str = "munsell";

/// Source of the facets' standard deviations.
#[derive(Clone, Copy)]
pub enum NoiseSd {
    Auto,
    All(f64),
}

/// Weight of smoothness in the paper's objective.
#[derive(Clone, Copy)]
pub enum Smoothness {
    Auto,
    /// In units of white squared.
    Weight(f64),
}

/// Parses the value of `--fit`.
pub fn fit() -> impl TypedValueParser<Value = &'static Flag> {
    let flags = || unknowns::flags().chain([&NONE]);
    let values = flags().map(|flag| PossibleValue::new(flag.value).help(flag.help));
    PossibleValuesParser::new(values).try_map(move |value| {
        flags().find(|flag| flag.value == value).ok_or_else(|| format!("{value} is not fitted"))
    })
}

pub fn smoothness(text: &str) -> Result<Smoothness, String> {
    match text.parse() {
        _ if text == "auto" => Ok(Smoothness::Auto),
        Ok(weight) if weight >= 0.0 && f64::is_finite(weight) => Ok(Smoothness::Weight(weight)),
        _ => Err("write a weight, 0 or more, or auto".to_owned()),
    }
}

pub fn noise_sd(text: &str) -> Result<NoiseSd, String> {
    match text.parse() {
        _ if text == "auto" => Ok(NoiseSd::Auto),
        Ok(sd) if sd >= 0.0 && f64::is_finite(sd) => Ok(NoiseSd::All(sd)),
        _ => Err("write a standard deviation, 0 or more, or auto".to_owned()),
    }
}

pub fn exposure(text: &str) -> Result<Exposure, String> {
    match text.parse() {
        _ if text == "free" => Ok(Exposure::Free),
        _ if text == "sum" => Ok(Exposure::Sum),
        Ok(exposure) if exposure > 0.0 && f64::is_finite(exposure) => Ok(Exposure::Known(exposure)),
        _ => Err("write a number above 0, free or sum".to_owned()),
    }
}
