//! Parameters of the scene that are fitted along with the spectrum, one file each, listed in [`TABLE`].
//!
//! A new parameter is a file with an [`Unknown`] and a row of the table: without one of its parts it does not
//! compile, without the row it does not pass the lints. The values of `vestimate --fit` and their help, the
//! records with their schema, residuals and messages follow from the two.
//!
//! Facets are sums over sources (a lamp on a fold). An unknown changes the amounts of sources ([`Factor`]) or
//! replaces some sources by others ([`Sources`]), so a source's amount is a product of one function of each
//! unknown. Nonlinear effects (the angle of the fold, the colour of the sky) are interpolated between three
//! sources.

mod angle;
mod body_roughness;
mod bow;
mod bow_difference;
mod cloud;
mod crease;
mod elevation;
mod even_sky;
mod exposure;
mod factor;
mod fall_off;
mod first_gain;
mod fold_model;
mod ground;
mod ground_redness;
mod last_gain;
mod nearness;
mod scene_model;
mod sheen;
mod sky;
mod sky_colour;
mod sources;
mod specular_roughness;
mod specular_weight;
mod sun;
mod sun_colour;
mod tilt;
mod unknown;
mod veiling_glare;
mod vignetting;

pub use angle::ANGLE;
use body_roughness::BODY_ROUGHNESS;
use bow::BOW;
use bow_difference::BOW_DIFFERENCE;
use cloud::CLOUD;
use crease::CREASE;
use elevation::ELEVATION;
pub use even_sky::EVEN_SKY;
pub use exposure::EXPOSURE;
pub use factor::Factor;
use fall_off::FALL_OFF;
use first_gain::FIRST_GAIN;
use ground::GROUND;
use ground_redness::GROUND_REDNESS;
use last_gain::LAST_GAIN;
use nearness::NEARNESS;
pub use scene_model::{Amounts, Expected, SceneModel};
use sheen::SHEEN;
pub use sky::SKY;
pub use sky_colour::SKY_COLOUR;
pub use sources::{FoldInLight, Lamp, Sources, State};
use specular_roughness::SPECULAR_ROUGHNESS;
use specular_weight::SPECULAR_WEIGHT;
use sun::SUN;
pub use sun_colour::SUN_COLOUR;
pub use tilt::TILT;
pub use unknown::{AUTO, Fitted, Flag, Known, NONE, Role, Symptom, Unknown, Whose};
use veiling_glare::VEILING_GLARE;
use vignetting::VIGNETTING;

pub use super::normal::{Expectation, Normal, Scale};

/// All unknowns, in the order of the records.
pub static TABLE: &[&Unknown] = &[
    &EXPOSURE,
    &ANGLE,
    &TILT,
    &SKY,
    &SKY_COLOUR,
    &SUN_COLOUR,
    &GROUND,
    &GROUND_REDNESS,
    &EVEN_SKY,
    &SUN,
    &CLOUD,
    &ELEVATION,
    &SPECULAR_WEIGHT,
    &SPECULAR_ROUGHNESS,
    &BODY_ROUGHNESS,
    &SHEEN,
    &CREASE,
    &BOW,
    &BOW_DIFFERENCE,
    &NEARNESS,
    &FALL_OFF,
    &VIGNETTING,
    &VEILING_GLARE,
    &FIRST_GAIN,
    &LAST_GAIN,
];

/// Names of fields in records of earlier versions, with the current ones.
const EARLIER_NAMES: [(&str, &str); 4] = [
    ("fuzz", "sheen"),
    ("gloss", "specular_weight"),
    ("gloss_roughness", "specular_roughness"),
    ("glare", "veiling_glare"),
];

/// The unknown with this name in records, including those of earlier versions.
#[must_use]
pub fn named(name: &str) -> Option<&'static Unknown> {
    let earlier = EARLIER_NAMES.iter().find(|(earlier, _)| *earlier == name);
    let name = earlier.map_or(name, |(_, today)| today);
    TABLE.iter().copied().find(|unknown| unknown.name == name)
}

/// The values of `vestimate --fit`, each once.
pub fn flags() -> impl Iterator<Item = &'static Flag> {
    let is_first = |(n, flag): &(usize, &Flag)| !TABLE[..*n].iter().any(|one| one.flag == *flag);
    let all = TABLE.iter().map(|unknown| unknown.flag).enumerate();
    all.filter(is_first).map(|(_, flag)| flag)
}

/// The unknowns selected by `asked`, in the order of the table.
#[must_use]
pub fn of_flags(asked: &[&Flag]) -> Vec<&'static Unknown> {
    TABLE.iter().copied().filter(|unknown| asked.contains(&unknown.flag)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_unknowns_apart() {
        for (n, unknown) in TABLE.iter().enumerate() {
            assert_eq!(TABLE.iter().position(|one| one == unknown), Some(n));
            assert_eq!(named(unknown.name), Some(*unknown));
        }
    }

    #[test]
    fn unknowns_of_one_flag_are_fitted_together() {
        assert!(flags().all(|flag| flags().filter(|other| other.value == flag.value).count() == 1));
        assert_eq!(of_flags(&[SKY.flag, EXPOSURE.flag]), [&EXPOSURE, &SKY, &SKY_COLOUR]);
    }
}
