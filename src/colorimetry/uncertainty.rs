//! Error bars of colours.
//!
//! First-order propagation: colour coordinates are linearised in the reflectance within its error bars, as in
//! JCGM 100:2008 (GUM), section 5.

use super::Colorimeter;

/// The errors of a reflectance.
#[derive(Clone, Copy, Debug)]
pub enum ErrorBars<'a> {
    /// Covariance, waveband by waveband.
    Covariance(&'a [Vec<f64>]),
    /// Standard deviation per waveband, with unknown correlation between wavebands.
    Deviations(&'a [f64]),
}

/// A colour, or the standard deviations of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour {
    /// CIE XYZ, white having Y = 100.
    pub xyz: [f64; 3],
    /// CIELAB.
    pub lab: [f64; 3],
    /// sRGB with its transfer curve, 0..1.
    pub srgb: [f64; 3],
}

impl Colorimeter {
    /// The colour of a reflectance on the grid.
    ///
    /// # Panics
    /// If `reflectance` and the grid differ in length.
    #[must_use]
    pub fn colour(&self, reflectance: &[f64]) -> Colour {
        Colour { xyz: self.xyz(reflectance), lab: self.lab(reflectance), srgb: self.srgb(reflectance) }
    }

    /// Standard deviations of the colour of a reflectance: from its covariance, or the largest that its
    /// standard deviations allow under any correlation.
    ///
    /// sRGB is treated as unclipped.
    ///
    /// # Panics
    /// If `reflectance` or its error bars differ from the grid in length.
    ///
    /// # Example
    /// ```
    /// use vfold::colorimetry::{Colorimeter, ErrorBars, Observer};
    /// use vfold::spectrum::{WavelengthGrid, illuminant};
    /// let grid = WavelengthGrid::default();
    /// let d65 = Colorimeter::new(&grid, &illuminant("D65")?, Observer::Cie1964_10deg)?;
    /// let sd = d65.colour_sd(&vec![0.5; grid.len()], ErrorBars::Deviations(&vec![0.01; grid.len()]));
    /// assert!((sd.xyz[1] - 1.0).abs() < 1e-12); // all wavebands off by 0.01 at once
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn colour_sd(&self, reflectance: &[f64], errors: ErrorBars) -> Colour {
        let xyz = self.xyz(reflectance);
        let sd = |slopes: [[f64; 3]; 3]| slopes.map(|slope| self.sd_along(slope, errors));
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Colour { xyz: sd(unit), lab: sd(self.lab_slopes(xyz)), srgb: sd(self.srgb_slopes(xyz)) }
    }

    /// Standard deviation of a number whose derivatives with respect to X, Y and Z are `slope`.
    fn sd_along(&self, slope: [f64; 3], errors: ErrorBars) -> f64 {
        let gradient: Vec<f64> = self.wavebands.iter().map(|xyz| dot(slope, *xyz)).collect();
        let sum = |weights: &[f64]| gradient.iter().zip(weights).map(|(g, w)| g * w).sum::<f64>();
        match errors {
            ErrorBars::Covariance(rows) => {
                assert_eq!(rows.len(), gradient.len(), "a covariance on another grid");
                let along: Vec<f64> = rows.iter().map(|row| sum(row)).collect();
                sum(&along).max(0.0).sqrt()
            }
            ErrorBars::Deviations(sd) => {
                assert_eq!(sd.len(), gradient.len(), "deviations on another grid");
                gradient.iter().zip(sd).map(|(g, sd)| g.abs() * sd).sum()
            }
        }
    }

    /// Derivatives of L*, a* and b* with respect to X, Y and Z.
    fn lab_slopes(&self, xyz: [f64; 3]) -> [[f64; 3]; 3] {
        let white = self.white.to_array();
        let [x, y, z] = [0, 1, 2].map(|i| cube_root_slope(xyz[i] / white[i]) / white[i]);
        [[0.0, 116.0 * y, 0.0], [500.0 * x, -500.0 * y, 0.0], [0.0, 200.0 * y, -200.0 * z]]
    }

    /// Derivatives of sRGB with respect to X, Y and Z.
    fn srgb_slopes(&self, xyz: [f64; 3]) -> [[f64; 3]; 3] {
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|unit| self.screen(unit));
        let linear = self.screen(xyz);
        [0, 1, 2].map(|i| [x[i], y[i], z[i]].map(|slope| slope * encoding_slope(linear[i])))
    }
}

/// Slope of CIELAB's cube root with its linear part (CIE 15:2018, section 8.2.1).
fn cube_root_slope(t: f64) -> f64 {
    let delta: f64 = 6.0 / 29.0;
    if t > delta.powi(3) { t.powf(-2.0 / 3.0) / 3.0 } else { 1.0 / (3.0 * delta * delta) }
}

/// Slope of the sRGB transfer curve (IEC 61966-2-1).
fn encoding_slope(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 } else { 1.055 / 2.4 * linear.min(1.0).powf(1.0 / 2.4 - 1.0) }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
