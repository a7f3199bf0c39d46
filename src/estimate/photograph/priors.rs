//! The priors on photographs.

use crate::estimate::unknowns::{Expectation, Normal};

/// Declares each number once: a field, its usual value, and a row in the table of all.
macro_rules! priors {
    ($($(#[$doc:meta])* $name:ident: $usual:expr,)*) => {
        /// All numbers in the model of a photograph that belong to neither physics, geometry nor numerics.
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
            /// The priors on usual photographs.
            pub const USUAL: Self = Self { $($name: $usual,)* };
            /// All numbers by name, to be varied.
            pub const NUMBERS: &'static [(&'static str, fn(&mut Self) -> &mut f64)] =
                &[$((stringify!($name), |priors: &mut Self| &mut priors.$name),)*];
        }
    };
}

priors! {
    /// Standard deviation of a measured angle, degrees: a protractor, and a sheet that springs back; with its
    /// tails, that of `train`. A stated standard deviation takes precedence.
    angle_sd_deg: 0.8,
    /// Standard deviation of the tilt of a sheet that was turned to the sun with care, degrees.
    tilt_sd_deg: 2.0,
    /// Of the logarithm of a stated exposure.
    exposure_stated_sd: 0.02,
    /// The same by a chart or a card, which is uneven, and not exactly in the place and orientation of the
    /// sheet.
    exposure_shown_sd: 0.04,
    /// The same if not stated: nineteen of twenty photographs are exposed so that white facing the sun lies
    /// between a third and three times the picture's white level.
    exposure_sd: 0.55,
    /// The same from the camera's settings and the height of the sun: a round number, measured on no camera.
    /// ISO 12232 lets makers state several kinds of sensitivity, and apertures and lenses deviate from their
    /// nominal values.
    exposure_metered_sd: 0.3,
    /// Heaviness of the tails for stated values, which now and then are blunders; 0: normal. 5° off in the
    /// angle are three standard deviations.
    stated_tail: 0.75,

    /// Reciprocal colour temperature of direct sunlight, 1e-6/K, whatever CIE daylight was stated: 4900 K to
    /// 5900 K.
    sun_mired: 187.0,
    /// Standard deviation: that of the suns of `train`. A tenth more or less aerosol (optical depth at
    /// 500 nm) makes 7.
    sun_mired_sd: 9.5,
    /// Logarithm of the gains of the first and the last channel: cameras of one model differ by 2 %.
    gain_sd: 0.015,
    /// Difference between measurements of one camera model by two laboratories, relative to the peak of a
    /// sensitivity.
    sensitivity_sd: 0.02,
    /// Range over which such errors are alike, nm.
    sensitivity_step_nm: 40.0,

    /// Spread of the [amounts](Priors::amount) of effects that an ideal fold lacks.
    amount_sd: 1.0,
    /// Heaviness of the tails of these amounts: an otherwise careful photograph may have much of one.
    amount_tail: 1.0,
    /// Irradiance from a clear sky on an open horizontal plane, relative to direct sun.
    sky: 0.12,
    /// The same in haze or under thin cloud: a third to two thirds of the light is diffuse.
    hazy_sky: 0.6,
    /// Amount of uniform skylight in a picture of an ideal fold for which none was stated.
    even_sky: 0.4,
    /// Standard deviation of skylight, as a share of it.
    sky_sd: 0.5,
    /// The same if it was stated.
    sky_stated_sd: 0.25,
    /// Share of photographs taken in haze or under thin cloud; as many on an overcast day, and half as many
    /// in the shade.
    dull_share: 0.1,
    /// Light on a sheet facing the open sky with the sun hidden, relative to that of the sun on one facing
    /// it: 0.1 to 0.3.
    hidden_light: 0.17,
    /// Standard deviation of its logarithm.
    hidden_light_sd: 0.5,
    /// Reciprocal colour temperature of a blue sky, 1e-6/K: 9500 K, two in three between 8000 K and 11800 K.
    sky_mired: 105.0,
    /// See `sky_mired`.
    sky_mired_sd: 20.0,
    /// Reciprocal colour temperature of a sky that is not clear, 1e-6/K.
    cloud_mired: 156.0,
    /// Standard deviation in haze: thin cloud has the sun's colour, haze is bluer; two in three between
    /// 5500 K and 7600 K. Widened with a picture of `../shared/faults` in view.
    hazy_mired_sd: 25.0,
    /// Standard deviation on an overcast day: two in three between 6100 K and 6800 K.
    overcast_mired_sd: 9.0,
    /// Share of a hazy sky's light with the distribution of an overcast sky, and its standard deviation.
    hazy_cloud: 0.3,
    /// Amount of sunlight that passes clouds or an object casting a shadow: irradiance of a plane facing the
    /// sun, relative to the sky's on an open horizontal plane.
    hidden_sun: 0.025,
    /// Elevation of the direction in which the fold opens, degrees: towards the sun, towards the
    /// photographer, or upwards on a table.
    elevation_deg: 45.0,
    /// See `elevation_deg`.
    elevation_sd_deg: 14.0,
    /// Reflectance of the ground: a table, grass or sand has 0.1 to 0.4.
    ground: 0.105,
    /// Rise of the ground's reflectance to 700 nm: earth and wood are brown, and reflect half as much again
    /// in the red, stone and cloth may be grey.
    ground_redness: 0.4,
    /// That of the grounds of `train`.
    ground_redness_sd: 0.47,
    /// Radius of the crease, in panel depths: folded sheets have 0 to 3 %.
    crease_radius: 0.006,
    /// Bow of both panels, degrees: sheets held at their edges turn by a few.
    bow_sd_deg: 1.5,
    /// Difference in bow between the panels, degrees: those of one sheet bow similarly.
    bow_difference_sd_deg: 0.7,
    /// Share of light lost by the lens in the corners: 0 to 30 %.
    vignetting: 0.12,
    /// Share of light spread over the picture by the lens: 0 to 2 %.
    veiling_glare: 0.0045,
    /// Specular weight: matte papers and paints have up to that of a bare surface.
    specular_weight: 0.16,
    /// Logarithm of the specular roughness: matte surfaces have 0.3 to 0.6.
    ln_specular_roughness: -0.85,
    /// See `ln_specular_roughness`.
    ln_specular_roughness_sd: 0.18,
    /// Body roughness, degrees: paper and paint have 0 to 20.
    body_roughness_deg: 10.5,
    /// Sheen: paper and paint have almost none, cloth some, felt up to 1.
    sheen: 0.1,

    /// Share of sheets that are perfectly matte, or nearly so; half of the others are described by the
    /// formula, half are like the measured ones.
    matt_share: 0.05,
    /// Distance of a sheet from the mean of the measured ones, in their standard deviations: more than one,
    /// as they are few.
    measured_variation: 2.2,
    /// Variation of sheets described by the formula beyond its parameters, in the same unit.
    formula_variation: 0.3,

    /// The model error, relative to predicted values, common to all channels. For the origin of its sizes see
    /// docs/model.md.
    discrepancy_shared: 0.0125,
    /// Addition if all light is the sky's: root mean square differences of overcast skies of types 1, 3 and 5
    /// within panels (`benches/skies.rs`).
    discrepancy_sky: 0.016,
    /// The same between panels 0 and 1: differences of all six types, half of them brighter around the
    /// hidden sun.
    discrepancy_sky_aside: 0.07,
    /// In each channel by itself.
    discrepancy_own: 0.005,
    /// In each facet by itself.
    discrepancy_white: 0.008,
    /// In the facets at the crease, which is not as sharp, or as round, as in the model.
    discrepancy_at_crease: 0.05,
    /// In the facets at the outer sides: an edge is not straight or sharp, so that some background counts as
    /// sheet.
    discrepancy_at_outer_side: 0.073,
    /// Displacement of a corner from its mark, in panel depths.
    corner: 0.0155,
    /// Correlation length of the model error, in panel depths.
    discrepancy_length: 1.0,

    /// Share of photographs of an ideal fold in a scene exactly as stated: computed ones.
    ideal_share: 0.04,
    /// Share of stated numbers that are mistaken.
    mistake_share: 0.05,
    /// Share of photographs that show no fold, for each of two hypotheses.
    no_fold_share: 0.01,
    /// Tempering of the class probabilities, a power: people fold paper and cloth more often than painted
    /// chips, which dominate the known spectra.
    class_share_power: 0.45,
}

/// Where [`Scale::Positive`](crate::estimate::unknowns::Scale) has the value 1: the logarithm of e - 1.
const ONE: f64 = 0.541_324_854_612_918;

impl Priors {
    /// Logarithm of an unstated exposure.
    #[must_use]
    pub const fn exposure(&self) -> Normal {
        Normal { mean: 0.0, sd: self.exposure_sd }
    }

    /// Logarithm of the odds that a statement is right: other values must make data more probable by more.
    #[must_use]
    pub fn ln_odds_of_statement(&self) -> f64 {
        ((1.0 - self.mistake_share) / self.mistake_share).ln()
    }

    /// Unevenness of sunlight over the panels: a quarter of the shared model error.
    #[must_use]
    pub const fn unevenness(&self) -> Normal {
        Normal { mean: 0.0, sd: 0.25 * self.discrepancy_shared }
    }

    /// Prior of an effect that an ideal fold lacks and that is below `amount` in half of all photographs: in
    /// some almost absent, in a few several times as large.
    #[must_use]
    pub const fn amount(&self, amount: f64) -> Expectation {
        Expectation { unit: amount, normal: Normal { mean: ONE, sd: self.amount_sd }, tail: 0.0 }
    }
}
