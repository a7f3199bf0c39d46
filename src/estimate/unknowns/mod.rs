//! Parameters of the scene that are fitted along with the spectrum, listed in [`TABLE`].
//!
//! Those that an ideal fold has too have a file each; those that occur only in photographs of real sheets
//! share one for each part of the scene.
//!
//! A new parameter is an [`Unknown`] and a row of the table: without one of its parts it does not compile,
//! without the row it does not pass the lints. The values of `vestimate --fit` and their help, the records
//! with their schema, residuals and messages follow from the two.
//!
//! Facets are sums over sources (a lamp on a fold). An unknown changes the amounts of sources ([`Factor`]) or
//! replaces some sources by others ([`Sources`]), so a source's amount is a product of one function of each
//! unknown. Nonlinear effects (the angle of the fold, the colour of the sky) are interpolated between three
//! sources.

mod angle;
mod exposure;
mod factor;
mod fall_off;
mod fold_model;
mod lens;
mod scene_model;
mod shape;
mod sheet;
mod sky;
mod sky_colour;
mod sources;
mod sun_colour;
mod surroundings;
mod tilt;
mod unknown;

pub use angle::ANGLE;
pub use exposure::EXPOSURE;
pub use factor::Factor;
use fall_off::{FALL_OFF, NEARNESS};
use lens::{FIRST_GAIN, LAST_GAIN, VEILING_GLARE, VIGNETTING};
pub use scene_model::{Amounts, Expected, SceneModel};
use shape::{BOW, BOW_DIFFERENCE, CREASE};
use sheet::{BODY_ROUGHNESS, SHEEN, SPECULAR_ROUGHNESS, SPECULAR_WEIGHT};
pub use sky::SKY;
pub use sky_colour::SKY_COLOUR;
pub use sources::{FoldInLight, Lamp, Sources, State};
pub use sun_colour::SUN_COLOUR;
pub use surroundings::EVEN_SKY;
use surroundings::{CLOUD, ELEVATION, GROUND, GROUND_REDNESS, SUN};
pub use tilt::TILT;
pub use unknown::{AUTO, Fitted, Flag, Known, NONE, Role, SUPPORTED, Symptom, Unknown, Whose};

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
