//! What files state their spectra to be: `SpectralQuantity` of IES TM-27, `units` of rawtoaces, `MEAS_TYPE`
//! of Argyll CMS.

use crate::spectrum::names::What;

/// The quantity of a spectrum, as stated by a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Reflectance,
    Transmittance,
    Absorptance,
    /// The power of a light: flux, irradiance and the like.
    Power,
    Sensitivity,
}

/// Parts of words that denote quantities, in lower case.
const WORDS: [(&str, Quantity); 18] = [
    ("reflect", Quantity::Reflectance),
    ("r-factor", Quantity::Reflectance),
    ("transmi", Quantity::Transmittance),
    ("t-factor", Quantity::Transmittance),
    ("absor", Quantity::Absorptance),
    ("density", Quantity::Absorptance),
    ("flux", Quantity::Power),
    ("intensity", Quantity::Power),
    ("radiance", Quantity::Power),
    ("exitance", Quantity::Power),
    ("power", Quantity::Power),
    ("emission", Quantity::Power),
    ("emissive", Quantity::Power),
    ("ambient", Quantity::Power),
    ("sensitiv", Quantity::Sensitivity),
    ("responsiv", Quantity::Sensitivity),
    ("response", Quantity::Sensitivity),
    ("efficiency", Quantity::Sensitivity),
];

impl Quantity {
    /// From the name in a file; `None` if that may be anything, such as `relative` and `other`.
    pub fn called(text: &str) -> Option<Self> {
        let text = text.to_lowercase();
        WORDS.iter().find(|(word, _)| text.contains(word)).map(|(_, quantity)| *quantity)
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Reflectance => "reflectances",
            Self::Transmittance => "transmittances",
            Self::Absorptance => "absorptances",
            Self::Power => "the power of a light",
            Self::Sensitivity => "sensitivities",
        }
    }

    pub fn suits(self, what: What) -> bool {
        self == match what {
            What::Cameras => Self::Sensitivity,
            What::Illuminants => Self::Power,
            What::Reflectances => Self::Reflectance,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All quantities in the schemas of TM-27-20 and rawtoaces 1.0.0.
    #[test]
    fn the_quantities_of_the_schemas_are_told_apart() {
        for (words, want) in [
            (&["flux", "intensity", "irradiance", "radiance", "exitance"][..], Some(Quantity::Power)),
            (&["reflectance", "R-Factor", "REFLECTIVE"], Some(Quantity::Reflectance)),
            (&["transmittance", "T-Factor", "TRANSMISSIVE"], Some(Quantity::Transmittance)),
            (&["absorptance"], Some(Quantity::Absorptance)),
            (&["relative", "other", ""], None),
        ] {
            for word in words {
                assert_eq!(Quantity::called(word), want, "{word}");
            }
        }
    }
}
