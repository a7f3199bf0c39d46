//! The priors on photographs: what is known of them before one is looked at.

use crate::estimate::unknowns::{Expectation, Normal};

/// Declares the numbers, each once: a field, its usual value, and a row of the table of all.
macro_rules! priors {
    ($($(#[$doc:meta])* $name:ident: $usual:expr,)*) => {
        /// Every number that the model of a photograph is made of and that is neither physics nor geometry
        /// nor numerics.
        ///
        /// Means and standard deviations of unknowns are on the [scale](crate::estimate::unknowns::Scale) of
        /// each.
        ///
        /// # Example
        /// ```
        /// use vfold::estimate::photograph::priors::Priors;
        /// let careful = Priors { angle_sd_deg: 0.3, ..Priors::USUAL };
        /// assert!(careful.angle_sd_deg < Priors::USUAL.angle_sd_deg);
        /// assert!(Priors::NUMBERS.len() <= 60);
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Priors {
            $($(#[$doc])* pub $name: f64,)*
        }

        impl Priors {
            /// Those about photographs as people take them.
            pub const USUAL: Self = Self { $($name: $usual,)* };
            /// All of them by name, to be varied.
            pub const NUMBERS: &'static [(&'static str, fn(&mut Self) -> &mut f64)] =
                &[$((stringify!($name), |priors: &mut Self| &mut priors.$name),)*];
        }
    };
}

priors! {
    /// How far an angle is off that somebody measured, degrees: a protractor, and a sheet that springs back.
    /// Of one that comes with a standard deviation of its own that counts.
    angle_sd_deg: 1.2,
    /// How far a sheet is turned off the sun that was turned to it with care, degrees.
    tilt_sd_deg: 2.0,
    /// Logarithm of an exposure that was stated.
    exposure_stated_sd: 0.02,
    /// Of one by a chart or a card, which is uneven, not quite where the sheet is, nor turned as it was said
    /// to be.
    exposure_shown_sd: 0.04,
    /// Of one that nobody states: people expose so that white that faces the sun lies within a third and
    /// three times the white level of the picture in nineteen cases of twenty.
    exposure_sd: 0.55,
    /// Of one that the camera's settings and the height of the sun tell: a round number, measured on no
    /// camera; ISO 12232 lets makers state several kinds of sensitivity, and apertures and lenses are not
    /// quite what they are called.
    exposure_metered_sd: 0.3,
    /// How heavy the tails are of what was stated, now and then by mistake; 0: those of a normal number.
    stated_tail: 0.5,

    /// The reciprocal colour temperature of direct sunlight, 1e-6/K, whatever kind of daylight was said: 5000
    /// K to 5800 K.
    sun_mired: 187.0,
    /// As much as a tenth more or less aerosol (optical depth at 500 nm) makes of it.
    sun_mired_sd: 7.0,
    /// Logarithm of the gain of the first and the last channel: cameras of one model differ by 2 %.
    gain_sd: 0.015,
    /// By how much two laboratories differ that measure the same model of a camera, relative to the highest
    /// point of a curve.
    sensitivity_sd: 0.02,
    /// Over so many nanometres they are off alike.
    sensitivity_step_nm: 40.0,

    /// How widely the [amounts](Priors::amount) vary of what an ideal fold does not have.
    amount_sd: 1.0,
    /// How heavy the tails are of these amounts: an otherwise careful photograph may have much of one.
    amount_tail: 1.0,
    /// Irradiance by the sky of an open horizontal plane, direct sun being 1: what a clear one gives.
    sky: 0.12,
    /// The same in haze or under thin cloud: a third to two thirds of the light is diffuse.
    hazy_sky: 0.6,
    /// Amount of light from a sky that is alike in all directions, in a computed scene of which nobody stated
    /// it.
    even_sky: 0.4,
    /// How far these are off, as a part of them.
    sky_sd: 0.5,
    /// How far one is off that was stated, likewise.
    sky_stated_sd: 0.25,
    /// How many photographs are taken in haze or under thin cloud; as many on an overcast day, and half as
    /// many in the shade.
    dull_share: 0.1,
    /// Light on a sheet that faces the open sky where the sun is hidden, that of the sun on one that faces it
    /// being 1: 0.1 to 0.3.
    hidden_light: 0.17,
    /// Logarithm of that.
    hidden_light_sd: 0.5,
    /// Reciprocal colour temperature of a blue sky, 1e-6/K: 9500 K, two of three between 8000 K and 11800 K.
    sky_mired: 105.0,
    /// See `sky_mired`.
    sky_mired_sd: 20.0,
    /// Reciprocal colour temperature of a sky that is not clear, 1e-6/K.
    cloud_mired: 156.0,
    /// In haze: thin cloud has the sun's colour, haze is bluer, 5600 K to 7700 K. Widened with a picture of
    /// `../shared/faults` in view.
    hazy_mired_sd: 25.0,
    /// On an overcast day: 5800 K to 7000 K.
    overcast_mired_sd: 9.0,
    /// Share of a hazy sky's light that is an overcast sky's, and the standard deviation of it.
    hazy_cloud: 0.3,
    /// Amount of sunlight that comes through clouds or past what throws a shadow: irradiance of a plane that
    /// faces the sun, that of an open horizontal plane by the sky being 1.
    hidden_sun: 0.025,
    /// How far above the horizon the fold opens, degrees: towards the sun, towards the photographer, or
    /// upwards on a table.
    elevation_deg: 45.0,
    /// See `elevation_deg`.
    elevation_sd_deg: 14.0,
    /// Amount of light that the ground reflects: a table, grass, sand have 0.1 to 0.4.
    ground: 0.115,
    /// Rise of the ground's reflectance to 700 nm: earth and wood are brown, they reflect half as much again
    /// in the red.
    ground_redness: 0.4,
    /// See `ground_redness`.
    ground_redness_sd: 0.3,
    /// Radius of the crease, in depths of a panel: folded sheets have 0 to 3 %.
    crease_radius: 0.006,
    /// Bow of both panels, degrees: sheets that are held at their edges turn by a few.
    bow_sd_deg: 1.5,
    /// Bow of one panel beside the other, degrees: those of one sheet bow much alike.
    bow_difference_sd_deg: 0.7,
    /// Share of light that the lens loses in the corners: 0 to 30 %.
    vignetting: 0.12,
    /// Share of light that the lens spreads over the picture: 0 to 2 %.
    veiling_glare: 0.006,
    /// Strength of the surface's reflection: matte papers and paints have up to a bare surface of it.
    specular_weight: 0.16,
    /// Logarithm of the roughness of the surface: matte ones have 0.3 to 0.6.
    ln_specular_roughness: -0.85,
    /// See `ln_specular_roughness`.
    ln_specular_roughness_sd: 0.18,
    /// Roughness of the body, degrees: paper and paint have 0 to 20.
    body_roughness_deg: 10.5,
    /// Fibres: paper and paint have next to none, cloth some, felt up to 1.
    sheen: 0.1,

    /// How many sheets are perfectly matt, or nearly so; of the others half are of the family, half like
    /// those that were measured.
    matt_share: 0.05,
    /// How far a sheet is from the mean of those that were measured, in standard deviations of these: more
    /// than one, as they are few.
    measured_variation: 2.2,
    /// How far sheets that a formula describes vary beyond its numbers, in the same unit.
    formula_variation: 0.3,

    /// What no unknown explains, relative to predicted values, in all channels alike. Where its sizes come
    /// from: docs/model.md.
    discrepancy_shared: 0.01,
    /// As much more where all light is the sky's: root mean square of what the types 1, 3 and 5 of overcast
    /// skies leave within panels (`benches/skies.rs`).
    discrepancy_sky: 0.016,
    /// Panel 0 beside panel 1, likewise: what all six types leave between panels, of which half are brighter
    /// about the hidden sun.
    discrepancy_sky_aside: 0.07,
    /// In each channel by itself.
    discrepancy_own: 0.006,
    /// In each facet by itself.
    discrepancy_white: 0.008,
    /// In the facets at the crease, which is not as sharp, nor as round, as the model has it.
    discrepancy_at_crease: 0.05,
    /// In those at the outer sides: an edge is not straight, nor sharp, so that some of the background is
    /// taken for the sheet.
    discrepancy_at_outer_side: 0.047,
    /// How far a corner is from where it is marked, in depths of a panel.
    corner: 0.0125,
    /// Length over which the discrepancy is correlated, in depths of a panel.
    discrepancy_length: 0.8,

    /// How many photographs are of an ideal fold in a scene exactly as stated: computed ones.
    ideal_share: 0.04,
    /// How many stated numbers are mistaken.
    mistake_share: 0.05,
    /// How many photographs are of no fold, in each of two ways.
    no_fold_share: 0.01,
    /// Power of the shares that classes of spectra have of all spectra: people fold paper and cloth more
    /// often than painted chips, of which most is known.
    class_share_power: 0.45,
}

/// Where [`Scale::Positive`](crate::estimate::unknowns::Scale) has the value 1: the logarithm of e - 1.
const ONE: f64 = 0.541_324_854_612_918;

impl Priors {
    /// Logarithm of an exposure that nobody states.
    #[must_use]
    pub const fn exposure(&self) -> Normal {
        Normal { mean: 0.0, sd: self.exposure_sd }
    }

    /// How uneven the sun's light is over the panels: by a quarter of what no unknown explains.
    #[must_use]
    pub const fn unevenness(&self) -> Normal {
        Normal { mean: 0.0, sd: 0.25 * self.discrepancy_shared }
    }

    /// What is known of something that an ideal fold does not have, of which half of all photographs have
    /// less than `amount`: some next to nothing, a few several times as much.
    #[must_use]
    pub const fn amount(&self, amount: f64) -> Expectation {
        Expectation { unit: amount, normal: Normal { mean: ONE, sd: self.amount_sd } }
    }
}
