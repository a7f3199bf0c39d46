//! The sun and the sky of a cloudless day.
//!
//! R. Bird, C. Riordan, "Simple solar spectral model for direct and diffuse irradiance on horizontal and
//! tilted planes at the earth's surface for cloudless atmospheres", *Journal of Climate and Applied
//! Meteorology* 25 (1986), p. 87; equation numbers refer to the preceding report, SERI/TR-215-2436 (1984).
//! Where the report and NREL's program `spectrl2_2.c` differ, the program is followed, as in pvlib.

use super::Spectrum;
use super::sun::Sun;
use super::tables::builtin;
use crate::error::Result;

/// The atmosphere between the sun and the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClearSky {
    /// Position of the sun, and the day.
    pub sun: Sun,
    /// Pressure at the ground, Pa.
    pub pressure_pa: f64,
    /// Optical depth of the aerosol at 500 nm.
    pub turbidity: f64,
    /// Water vapour, cm of water.
    pub water_cm: f64,
    /// Ozone, atm cm.
    pub ozone_atm_cm: f64,
    /// Albedo of the surrounding ground.
    pub ground_albedo: f64,
}

/// Reference pressure of the air mass, Pa.
const SEA_LEVEL_PA: f64 = 101_300.0;
/// Angstrom's exponent of a rural aerosol.
const ANGSTROM: f64 = 1.14;
/// Single scattering albedo of the aerosol at 400 nm, and its variation with wavelength.
const SCATTERING: f64 = 0.945;
const SCATTERING_VARIATION: f64 = 0.095;
/// Mean cosine of the aerosol's scattering angle.
const ASYMMETRY: f64 = 0.65;
/// Air mass for light that the sky returns to the ground.
const BACK_AIR_MASS: f64 = 1.8;

impl ClearSky {
    /// Sea level, ground of albedo 0.2, and the U.S. Standard Atmosphere as in ASTM G173: turbidity 0.1 at
    /// 500 nm, 1.42 cm of water and 0.344 atm cm of ozone.
    #[must_use]
    pub fn usual(sun: Sun) -> Self {
        Self {
            sun,
            pressure_pa: SEA_LEVEL_PA,
            turbidity: 0.1,
            water_cm: 1.42,
            ozone_atm_cm: 0.344,
            ground_albedo: 0.2,
        }
    }

    /// Direct light on a plane facing the sun, W/(m² nm), 300..840 nm; eq. 2-1.
    ///
    /// # Errors
    /// Only if the embedded table is damaged.
    ///
    /// # Example
    /// ```
    /// use vfold::spectrum::{ClearSky, Sun};
    /// let sky = ClearSky::usual(Sun::at_zenith_deg(40.0)?);
    /// let at = |spectrum: vfold::spectrum::Spectrum, nm: f64| {
    ///     spectrum.values()[spectrum.wavelengths_nm().iter().position(|x| *x == nm).unwrap()]
    /// };
    /// assert!((at(sky.direct()?, 550.0) - 1.4253).abs() < 1e-4); // pvlib has the same
    /// assert!((at(sky.diffuse()?, 550.0) - 0.2084).abs() < 1e-4);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn direct(&self) -> Result<Spectrum> {
        self.spectrum("sun", |band| self.direct_at(band))
    }

    /// Light of the sky on level ground, W/(m² nm), 300..840 nm; eq. 3-1.
    ///
    /// # Errors
    /// As [`ClearSky::direct`].
    pub fn diffuse(&self) -> Result<Spectrum> {
        self.spectrum("sky", |band| self.diffuse_at(band))
    }

    fn spectrum(&self, name: &str, value: impl Fn(&Band) -> f64) -> Result<Spectrum> {
        let table = builtin("share/clear-sky.csv", include_str!("../../share/clear-sky.csv"))?;
        let band = |(k, nm): (usize, &f64)| {
            let [sun, water, ozone, mixed] = [0, 1, 2, 3].map(|column: usize| table[column].values()[k]);
            Band { nm: *nm, sun, water, ozone, mixed }
        };
        let bands = table[0].wavelengths_nm.iter().enumerate().map(band);
        let values = bands.map(|band| value(&band)).collect();
        Ok(Spectrum::from_table(name.to_owned(), table[0].wavelengths_nm.clone(), values).linear())
    }

    fn direct_at(&self, band: &Band) -> f64 {
        let passed = self.passed(band, self.sun.air_mass());
        band.sun * self.sun.nearness() * passed.rayleigh * passed.aerosol() * passed.absorbed()
    }

    fn diffuse_at(&self, band: &Band) -> f64 {
        let cos_zenith = self.sun.zenith_deg().to_radians().cos();
        let passed = self.passed(band, self.sun.air_mass());
        let incoming =
            band.sun * self.sun.nearness() * cos_zenith * passed.absorbed() * passed.aerosol_absorption;
        let by_air = incoming * (1.0 - passed.rayleigh.powf(0.95)) * 0.5; // eq. 3-5
        let scattered = passed.rayleigh.powf(1.5) * (1.0 - passed.aerosol_scattering);
        let by_aerosol = incoming * scattered * forward_share(cos_zenith); // eq. 3-6
        let back = self.sky_reflectivity(band) * self.ground_albedo;
        // eq. 3-7
        let from_ground = (self.direct_at(band) * cos_zenith + by_air + by_aerosol) * back / (1.0 - back);
        // eq. 3-17
        let ultraviolet = if band.nm <= 450.0 { ((band.nm + 550.0) / 1000.0).powf(1.8) } else { 1.0 };
        (by_air + by_aerosol + from_ground) * ultraviolet
    }

    /// Share of light from the ground that the sky returns; eq. 3-8 as in the program, with the mixed gases
    /// in place of ozone.
    fn sky_reflectivity(&self, band: &Band) -> f64 {
        let passed = self.passed(band, BACK_AIR_MASS);
        let backward = 1.0 - forward_share(1.0 / BACK_AIR_MASS);
        let by_aerosol = backward * passed.rayleigh * (1.0 - passed.aerosol_scattering);
        let scattered = 0.5 * (1.0 - passed.rayleigh) + by_aerosol;
        passed.mixed * passed.water * passed.aerosol_absorption * scattered
    }

    /// Transmittance of each part of the air for this air mass; section 2.
    fn passed(&self, band: &Band, air_mass: f64) -> Passed {
        let um = band.nm / 1000.0;
        let pressed = air_mass * self.pressure_pa / SEA_LEVEL_PA;
        let thickness = self.turbidity * (band.nm / 500.0).powf(-ANGSTROM); // eq. 2-7
        // eq. 3-16
        let scattering = SCATTERING * (-SCATTERING_VARIATION * (band.nm / 400.0).ln().powi(2)).exp();
        let water = band.water * self.water_cm * air_mass;
        let mixed = band.mixed * pressed;
        Passed {
            rayleigh: (-pressed / (um.powi(4) * (115.6406 - 1.3366 / um.powi(2)))).exp(), // eq. 2-4
            aerosol_scattering: (-scattering * thickness * air_mass).exp(),               // eq. 3-9
            aerosol_absorption: (-(1.0 - scattering) * thickness * air_mass).exp(),       // eq. 3-10
            water: (-0.2385 * water / (1.0 + 20.07 * water).powf(0.45)).exp(),            // eq. 2-8
            ozone: (-band.ozone * self.ozone_atm_cm * self.sun.ozone_mass()).exp(),       // eq. 2-9
            mixed: (-1.41 * mixed / (1.0 + 118.3 * mixed).powf(0.45)).exp(),              // eq. 2-11
        }
    }
}

/// A row of the table: wavelength, the sun at its mean distance, and absorption coefficients.
struct Band {
    nm: f64,
    sun: f64,
    water: f64,
    ozone: f64,
    mixed: f64,
}

/// Transmittances of parts of the air.
struct Passed {
    rayleigh: f64,
    aerosol_scattering: f64,
    aerosol_absorption: f64,
    water: f64,
    ozone: f64,
    mixed: f64,
}

impl Passed {
    /// The whole aerosol; eq. 2-6.
    fn aerosol(&self) -> f64 {
        self.aerosol_scattering * self.aerosol_absorption
    }

    fn absorbed(&self) -> f64 {
        self.water * self.ozone * self.mixed
    }
}

/// Share of the light that the aerosol scatters downwards; eqs. 3-11 to 3-15.
fn forward_share(cos_zenith: f64) -> f64 {
    let g = (1.0 - ASYMMETRY).ln();
    let linear = g * (1.459 + g * (0.1595 + g * 0.4129));
    let quadratic = g * (0.0783 + g * (-0.3824 - g * 0.5874));
    1.0 - 0.5 * ((linear + quadratic * cos_zenith) * cos_zenith).exp()
}
