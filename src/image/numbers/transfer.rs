//! From stored numbers to linear light.

use crate::Error;

/// Relation of stored numbers to light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Transfer {
    /// As the file states; otherwise [`Transfer::Srgb`] for eight bits, [`Transfer::Linear`] for greater
    /// depths.
    #[default]
    Auto,
    /// Proportional.
    Linear,
    /// The curve of sRGB, [`srgb_to_linear`].
    Srgb,
}

impl Transfer {
    /// The meaning of [`Transfer::Auto`] at this depth.
    pub(super) fn resolve(self, bits: u32) -> Self {
        match self {
            Self::Auto if bits == 8 => Self::Srgb,
            Self::Auto => Self::Linear,
            chosen => chosen,
        }
    }

    /// Linear light of a stored value scaled to [0, 1].
    pub(in crate::image) fn to_linear(self, stored: f64) -> f64 {
        if self == Self::Srgb { srgb_to_linear(stored) } else { stored }
    }

    /// Derivative of light with respect to the stored value, at this linear light.
    pub(in crate::image) fn slope(self, light: f64) -> f64 {
        match self {
            Self::Srgb if light > 0.04045 / 12.92 => 2.4 / 1.055 * light.powf(1.4 / 2.4),
            Self::Srgb => 1.0 / 12.92,
            Self::Auto | Self::Linear => 1.0,
        }
    }

    /// The name on the command line and in records.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Linear => "linear",
            Self::Srgb => "srgb",
        }
    }
}

impl std::str::FromStr for Transfer {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        [Self::Auto, Self::Linear, Self::Srgb]
            .into_iter()
            .find(|transfer| transfer.name() == name)
            .ok_or_else(|| {
                Error::usage(
                    "--transfer",
                    format!("'{name}' is not a transfer curve"),
                    "write auto, linear or srgb",
                )
            })
    }
}

/// Linear light of an sRGB value, both 1 at white.
///
/// Values outside [0, 1] follow the same formula: the linear part below zero, the power above one.
///
/// # Source
/// IEC 61966-2-1:1999, section 5.2.
///
/// # Example
/// ```
/// use vfold::image::srgb_to_linear;
/// assert!((srgb_to_linear(0.5) - 0.214041140482232).abs() < 1e-14);
/// ```
#[must_use]
pub fn srgb_to_linear(value: f64) -> f64 {
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// colour-science 0.4.7, `colour.models.eotf_sRGB(code / 255)`.
    #[test]
    fn srgb_agrees_with_colour_science() {
        for (code, linear) in [
            (0, 0.0),
            (1, 0.0003035269835488375),
            (10, 0.003035269835488375),
            (11, 0.003346535763899161),
            (64, 0.05126945837404324),
            (118, 0.181164244249860),
            (188, 0.5028864580325687),
            (254, 0.9911020971138298),
            (255, 1.0),
        ] {
            let got = srgb_to_linear(f64::from(code) / 255.0);
            assert!((got - linear).abs() < 1e-14, "{code}: {got} {linear}");
        }
    }

    #[test]
    fn slopes_are_those_of_the_curve() {
        for stored in [0.01, 0.03, 0.1, 0.5, 0.9] {
            let [below, above] = [-1e-6, 1e-6].map(|step| srgb_to_linear(stored + step));
            let got = Transfer::Srgb.slope(srgb_to_linear(stored));
            assert!((got / ((above - below) / 2e-6) - 1.0).abs() < 1e-8, "{stored}: {got}");
        }
    }

    #[test]
    fn auto_follows_the_depth() {
        assert_eq!([8, 16, 32].map(|bits| Transfer::Auto.resolve(bits).name()), ["srgb", "linear", "linear"]);
        assert_eq!(Transfer::Linear.resolve(8), Transfer::Linear);
        assert_eq!("srgb".parse::<Transfer>().unwrap(), Transfer::Srgb);
        assert_eq!("sRGB".parse::<Transfer>().unwrap_err().exit_status(), 2);
    }
}
