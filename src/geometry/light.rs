//! Collimated light on a fold, and a uniform sky.

use nalgebra::Vector3;

use crate::error::{Error, Result};
use crate::geometry::Fold;

/// Largest finite ratio of the sky's irradiance to the sun's.
const SKY_MAX: f64 = 1e6;

/// A sun and a uniform sky.
///
/// A plane facing the sun receives irradiance 1 from it and, if unobstructed, `sky` from the sky. Without a
/// sun, an unobstructed plane receives 1 from the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    tilt_deg: f64,
    slant_deg: f64,
    sun: f64,
    sky: f64,
    panel_irradiance: [f64; 2],
}

impl Light {
    /// Light on `fold`: a sun tilted by `tilt_deg` off the bisecting plane (positive: it leans over panel 1
    /// and lights panel 0 more) and slanted by `slant_deg` along the crease, and a uniform sky of `sky` times
    /// its irradiance. If `sky` is infinite there is no sun.
    ///
    /// # Errors
    /// A tilt that leaves a panel unlit, a slant of 90° or more, or a sky that is negative or above 1e6 but
    /// finite.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{FacetGrid, Fold, Light};
    /// let fold = Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?;
    /// let light = Light::new(&fold, 0.0, 0.0, 0.0)?;
    /// assert!((light.panel_irradiance()[0] - 0.5_f64.sqrt()).abs() < 1e-15); // cos 45°
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(fold: &Fold, tilt_deg: f64, slant_deg: f64, sky: f64) -> Result<Self> {
        let half = fold.angle_deg() / 2.0;
        // Beyond half the opening angle one panel shades the other. A slant shades neither as long as both
        // face the sun.
        if tilt_deg.is_nan() || tilt_deg.abs() >= half {
            return Err(Error::usage(
                "--tilt-deg",
                format!("{tilt_deg} leaves a panel of a {}° fold in the shade", fold.angle_deg()),
                format!("give degrees between {:?} and {half:?}", -half),
            ));
        }
        if slant_deg.is_nan() || slant_deg.abs() >= 90.0 {
            return Err(Error::usage(
                "--slant-deg",
                format!("{slant_deg} puts the sun along the crease or below it"),
                "give degrees between -90 and 90",
            ));
        }
        let is_sky_alone = sky == f64::INFINITY;
        if !(0.0..=SKY_MAX).contains(&sky) && !is_sky_alone {
            return Err(Error::usage(
                "--sky",
                format!("{sky} is not a ratio to the sun's irradiance"),
                format!("give 0 (no sky) to {SKY_MAX:e}, or 'only'"),
            ));
        }
        let (sun, sky) = if is_sky_alone { (0.0, 1.0) } else { (1.0, sky) };
        let slant = sun * slant_deg.to_radians().cos();
        let panel_irradiance = [tilt_deg, -tilt_deg].map(|tilt| slant * (half + tilt).to_radians().sin());
        Ok(Self { tilt_deg, slant_deg, sun, sky, panel_irradiance })
    }

    /// Angle of the sun off the bisecting plane, degrees.
    #[must_use]
    pub fn tilt_deg(&self) -> f64 {
        self.tilt_deg
    }

    /// Angle of the sun along the crease, degrees.
    #[must_use]
    pub fn slant_deg(&self) -> f64 {
        self.slant_deg
    }

    /// The direction towards the sun, in the coordinates of [`Fold::panels`].
    #[must_use]
    pub fn towards(&self) -> Vector3<f64> {
        let (tilt_sin, tilt_cos) = self.tilt_deg.to_radians().sin_cos();
        let (slant_sin, slant_cos) = self.slant_deg.to_radians().sin_cos();
        Vector3::new(tilt_sin * slant_cos, slant_sin, tilt_cos * slant_cos)
    }

    /// Coefficients `[even, odd]` of the sun's irradiance on the panels of `fold`: at a tilt it is
    /// `even·cos(tilt) ± odd·sin(tilt)`, more on panel 0 and less on panel 1.
    #[must_use]
    pub fn even_and_odd(&self, fold: &Fold) -> [f64; 2] {
        let (sin, cos) = (fold.angle_rad() / 2.0).sin_cos();
        [sin, cos].map(|share| self.slant_deg.to_radians().cos() * share)
    }

    /// Irradiance from the sun on a plane facing it: 1, or 0 without a sun.
    #[must_use]
    pub fn sun(&self) -> f64 {
        self.sun
    }

    /// Irradiance from the uniform sky on an unobstructed plane facing the sun, relative to the sun's if
    /// there is one.
    #[must_use]
    pub fn sky(&self) -> f64 {
        self.sky
    }

    /// Direct irradiance from the sun on each panel: the cosine of incidence.
    #[must_use]
    pub fn panel_irradiance(&self) -> [f64; 2] {
        self.panel_irradiance
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FacetGrid;

    #[test]
    fn positive_tilt_lights_panel_0_more() {
        let fold = Fold::new(55.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 }).unwrap();
        let light = Light::new(&fold, 6.0, 0.0, 0.0).unwrap();
        let [e0, e1] = light.panel_irradiance();
        assert!((e0 - 33.5_f64.to_radians().sin()).abs() < 1e-15);
        assert!((e1 - 21.5_f64.to_radians().sin()).abs() < 1e-15);
    }

    #[test]
    fn a_shaded_panel_is_refused() {
        let fold = Fold::new(40.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 }).unwrap();
        assert!(Light::new(&fold, 20.0, 0.0, 0.0).is_err());
        assert!(Light::new(&fold, f64::NAN, 0.0, 0.0).is_err());
        assert!(Light::new(&fold, 0.0, 0.0, -0.1).is_err());
    }

    #[test]
    fn an_infinite_sky_is_alone() {
        let fold = Fold::new(40.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 }).unwrap();
        let light = Light::new(&fold, 0.0, 0.0, f64::INFINITY).unwrap();
        assert_eq!((light.sun(), light.sky(), light.panel_irradiance()), (0.0, 1.0, [0.0; 2]));
    }
}
