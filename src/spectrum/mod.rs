//! Spectra: reflectances, illuminants and camera sensitivities, tabulated on any wavelengths.
//!
//! [`Spectrum::on`] brings every table to the scene's [`WavelengthGrid`]; [`spec`], which implements the SPEC
//! notation of the command line, finds built-in spectra and files. Nothing here knows about geometry or
//! colour.

mod averaging;
mod black_body;
mod cameras;
mod candidate_lights;
mod channels;
mod clear_sky;
mod daylight;
mod donaldson;
pub mod formats;
mod grid;
mod interpolation;
pub mod library;
mod munsell;
mod names;
mod own;
mod quantities;
pub mod spec;
mod sun;
mod tables;

pub use cameras::{MeasuredCamera, measured_cameras, measured_sensitivities};
pub use candidate_lights::{
    CandidateLight, candidate_lights, candidate_lights_and_between, equal_candidates, fine_candidate_lights,
};
pub use channels::have_one_peak;
pub use clear_sky::ClearSky;
pub use daylight::{daylight_vectors, daylight_weights, in_ultraviolet};
pub use donaldson::{Bispectral, Donaldson};
pub use grid::WavelengthGrid;
pub use interpolation::Interpolation;
pub use library::{camera_by_exif, is_other_camera, other_measurements};
pub use names::near_names;
pub use quantities::Sensitivities;
pub use spec::{camera, illuminant, reflectances};
pub use sun::Sun;

use crate::error::{Error, Result, counted};
use grid::check_rising;
use interpolation::sprague;
use std::sync::Arc;

/// The illuminant of a fold or photograph for which none was stated.
pub const ASSUMED_LIGHT: &str = "D65";

/// Name of an unknown illuminant, which is inferred from the evidence.
pub const UNKNOWN_LIGHT: &str = "unknown";

/// A quantity tabulated over wavelength, with an [`Interpolation`] between its samples.
///
/// Reflectance: 0..1. Illuminant: relative power. Sensitivity: relative, 0 or more.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    name: String,
    /// Shared, because all columns of a table have the same wavelengths.
    wavelengths_nm: Arc<[f64]>,
    values: Vec<f64>,
    interpolation: Interpolation,
    /// Upper bound on values between samples, unless the samples exceed it: 1 for reflectances.
    ceiling: f64,
    /// True for the power of a light, of which wavebands wider than the steps of its samples have the mean.
    is_power: bool,
    note: Option<Arc<str>>,
}

/// Value of a spectrum beyond the end of its table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// Zero: right for sensitivities, which are measured as far as they are noticeable.
    Zero,
    /// Unknown, hence an error: right for reflectances and illuminants.
    Refuse,
}

impl Spectrum {
    /// A spectrum from its samples.
    ///
    /// # Arguments
    /// - `wavelengths_nm`: nm, strictly increasing, at least two.
    /// - `values`: finite, one per wavelength.
    ///
    /// # Errors
    /// [`Error::Grid`] or [`Error::Spectrum`] if the samples do not satisfy this.
    ///
    /// # Example
    /// ```
    /// use vfold::spectrum::{Outside, Spectrum, WavelengthGrid};
    /// let ramp = Spectrum::new("ramp", vec![400.0, 700.0], vec![0.0, 1.0])?;
    /// let on_grid = ramp.on(&WavelengthGrid::uniform(400.0, 700.0, 150.0)?, Outside::Refuse)?;
    /// assert_eq!(on_grid, [0.0, 0.5, 1.0]);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(name: impl Into<String>, wavelengths_nm: Vec<f64>, values: Vec<f64>) -> Result<Self> {
        let name = name.into();
        check_rising(&wavelengths_nm)?;
        if wavelengths_nm.len() != values.len() {
            let (values, wavelengths) = (counted(values.len(), "value"), wavelengths_nm.len());
            let problem = format!("{values} for {wavelengths} wavelengths");
            return Err(Error::spectrum(name, problem, "give one value per wavelength"));
        }
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            let problem = format!("{value} is not a number");
            return Err(Error::spectrum(name, problem, "give finite values"));
        }
        Ok(Self::from_table(name, wavelengths_nm.into(), values))
    }

    /// The same `value` at every wavelength.
    ///
    /// Two samples that enclose every grid, so that flat spectra need no special treatment.
    pub fn flat(name: impl Into<String>, value: f64) -> Self {
        Self::from_table(name.into(), [0.0, f64::MAX].into(), vec![value; 2])
    }

    /// A column of a table whose wavelengths have been checked.
    fn from_table(name: String, wavelengths_nm: Arc<[f64]>, values: Vec<f64>) -> Self {
        let interpolation = Interpolation::for_samples(&wavelengths_nm);
        Self {
            name,
            wavelengths_nm,
            values,
            interpolation,
            ceiling: f64::INFINITY,
            is_power: false,
            note: None,
        }
    }

    /// The same samples with linear interpolation.
    fn linear(self) -> Self {
        Self { interpolation: Interpolation::Linear, ..self }
    }

    /// The same samples as a reflectance, which does not exceed 1 between them.
    #[must_use]
    pub fn as_reflectance(self) -> Self {
        Self { ceiling: 1.0, ..self }
    }

    /// The same samples as the power of a light, which is averaged over wavebands that are wider than its
    /// steps.
    #[must_use]
    pub fn as_power(self) -> Self {
        Self { is_power: true, ..self }
    }

    fn noted(self, note: Option<&Arc<str>>) -> Self {
        Self { note: note.cloned(), ..self }
    }

    fn renamed(self, name: impl FnOnce(&str) -> String) -> Self {
        Self { name: name(&self.name), ..self }
    }

    /// Name of the spectrum: `set:member` if built in, else derived from its file and column.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The wavelengths of the samples, nm, increasing.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// The samples.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Conversions made when the samples were read, such as `paint.csv: percent read as fractions`, for the
    /// user to see.
    #[must_use]
    pub fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    /// First and last wavelength of the samples, nm.
    #[must_use]
    pub fn range_nm(&self) -> (f64, f64) {
        (self.wavelengths_nm[0], self.wavelengths_nm[self.wavelengths_nm.len() - 1])
    }

    /// The values at the grid's wavelengths: samples where they exist, else interpolated. Of a light that was
    /// measured in smaller steps than those of the grid, the mean power near each wavelength: its lines count
    /// wherever they are.
    ///
    /// Between samples of 0 or more no value is below 0, and between two samples of at most 1 a reflectance
    /// is not above 1, however far the polynomial overshoots.
    ///
    /// # Source
    /// CIE 167:2005 for evenly spaced samples ([`Interpolation::Sprague`]).
    ///
    /// # Errors
    /// [`Error::Spectrum`] with both ranges if the grid extends beyond the samples and `outside` is
    /// [`Outside::Refuse`].
    ///
    /// # Example
    /// ```
    /// use vfold::spectrum::{Outside, Spectrum, WavelengthGrid};
    /// let parabola = |nm: &f64| (nm / 700.0).powi(2);
    /// let coarse_nm = WavelengthGrid::uniform(400.0, 700.0, 20.0)?.wavelengths_nm().to_vec();
    /// let values = coarse_nm.iter().map(parabola).collect();
    /// let grid = WavelengthGrid::uniform(500.0, 600.0, 5.0)?;
    /// let fine = Spectrum::new("parabola", coarse_nm, values)?.on(&grid, Outside::Refuse)?;
    /// assert!(grid.wavelengths_nm().iter().map(parabola).zip(fine).all(|(a, b)| (a - b).abs() < 1e-12));
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn on(&self, grid: &WavelengthGrid, outside: Outside) -> Result<Vec<f64>> {
        let ((first_nm, last_nm), (grid_first_nm, grid_last_nm)) = (self.range_nm(), grid.range_nm());
        if outside == Outside::Refuse && (grid_first_nm < first_nm || grid_last_nm > last_nm) {
            let problem = format!("its samples cover {first_nm}..{last_nm} nm, the grid is {grid}");
            let remedy = "choose a grid within the samples or extend the table";
            return Err(Error::spectrum(&self.name, problem, remedy));
        }
        // both increase: stepping along is several times faster than a search for each wavelength
        let (last, mut right) = (self.values.len() - 1, 1);
        let value_at = |(band, &nm): (usize, &f64)| {
            while right < last && self.wavelengths_nm[right] < nm {
                right += 1;
            }
            self.mean(grid, band).unwrap_or_else(|| self.between(right, nm))
        };
        Ok(grid.wavelengths_nm().iter().enumerate().map(value_at).collect())
    }

    /// The mean power near a wavelength of the grid, if this is a light measured in smaller steps.
    fn mean(&self, grid: &WavelengthGrid, band: usize) -> Option<f64> {
        let near = || averaging::mean(&self.wavelengths_nm, &self.values, grid.around_nm(band));
        self.is_power.then(near).flatten()
    }

    /// The interpolation that [`Spectrum::on`] uses on the grid; `None` if every wavelength of the grid is
    /// that of a sample that stands for it, or lies beyond the samples.
    #[must_use]
    pub fn interpolation(&self, grid: &WavelengthGrid) -> Option<Interpolation> {
        let (first_nm, last_nm) = self.range_nm();
        let between = |nm: &f64| {
            (first_nm..last_nm).contains(nm)
                && self.wavelengths_nm.binary_search_by(|at| at.total_cmp(nm)).is_err()
        };
        if (0..grid.len()).any(|band| self.mean(grid, band).is_some()) {
            return Some(Interpolation::Average);
        }
        let is_flat = first_nm <= 0.0;
        (!is_flat && grid.wavelengths_nm().iter().any(between)).then_some(self.interpolation)
    }

    /// The value at `nm` between the samples `right - 1` and `right`; 0 beyond them.
    fn between(&self, right: usize, nm: f64) -> f64 {
        let (a_nm, b_nm) = (self.wavelengths_nm[right - 1], self.wavelengths_nm[right]);
        if nm < a_nm || nm > b_nm {
            return 0.0;
        }
        let (a, b) = (self.values[right - 1], self.values[right]);
        match (nm - a_nm) / (b_nm - a_nm) {
            share if self.interpolation == Interpolation::Linear => a * (1.0 - share) + b * share,
            0.0 => a,
            1.0 => b,
            share => {
                let (floor, ceiling) = (a.min(b).min(0.0), a.max(b).max(self.ceiling));
                sprague(&self.values, right - 1, share).clamp(floor, ceiling)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn samples() -> impl Strategy<Value = Spectrum> {
        prop::collection::vec((0.1_f64..40.0, 0.0_f64..1.0), 2..30).prop_map(|steps| {
            let mut nm = 380.0;
            let (wavelengths_nm, values) = steps
                .into_iter()
                .map(|(step_nm, value)| {
                    nm += step_nm;
                    (nm, value)
                })
                .unzip();
            Spectrum::new("samples", wavelengths_nm, values).unwrap()
        })
    }

    proptest! {
        #[test]
        fn interpolation_is_exact_at_the_samples(spectrum in samples()) {
            let grid = WavelengthGrid::new(spectrum.wavelengths_nm().to_vec()).unwrap();
            prop_assert_eq!(spectrum.on(&grid, Outside::Refuse).unwrap(), spectrum.values());
        }

        #[test]
        fn interpolation_is_linear_between_uneven_samples(spectrum in samples(), share in 0.0_f64..1.0) {
            let within = |pair: &[f64]| pair[0] + share * (pair[1] - pair[0]);
            let grid_nm: Vec<f64> = spectrum.wavelengths_nm().windows(2).map(within).collect();
            prop_assume!(grid_nm.len() > 1);
            let got = spectrum.on(&WavelengthGrid::new(grid_nm).unwrap(), Outside::Refuse).unwrap();
            for (got, want) in got.iter().zip(spectrum.values().windows(2).map(within)) {
                prop_assert!((got - want).abs() < 1e-9);
            }
        }
    }

    /// Without bounds Sprague's polynomial ranges from -0.06 to 1.06 here.
    #[test]
    fn a_reflectance_stays_between_0_and_1() {
        let nm: Vec<f64> = (0..8).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
        let step = Spectrum::new("step", nm, vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]).unwrap();
        let grid = WavelengthGrid::uniform(400.0, 470.0, 1.0).unwrap();
        let peak = |spectrum: &Spectrum| {
            let values = spectrum.on(&grid, Outside::Refuse).unwrap();
            assert!(values.iter().all(|value| *value >= 0.0), "{values:?}");
            values.into_iter().fold(0.0, f64::max)
        };
        assert!(peak(&step) > 1.05);
        assert!(peak(&step.as_reflectance()) <= 1.0);
    }

    #[test]
    fn what_is_tabulated_is_not_interpolated() {
        let nm: Vec<f64> = (0..31).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
        let red = Spectrum::new("red", nm, vec![0.5; 31]).unwrap();
        let found = |step_nm| red.interpolation(&WavelengthGrid::uniform(400.0, 700.0, step_nm).unwrap());
        assert_eq!((found(20.0), found(5.0)), (None, Some(Interpolation::Sprague)));
        assert_eq!(Spectrum::flat("1", 1.0).interpolation(&WavelengthGrid::default()), None);
    }

    #[test]
    fn beyond_the_samples_is_zero_or_refused() {
        let spectrum = Spectrum::new("sigma", vec![400.0, 680.0], vec![1.0, 1.0]).unwrap();
        let grid = WavelengthGrid::new(vec![390.0, 400.0, 680.0, 690.0]).unwrap();
        assert_eq!(spectrum.on(&grid, Outside::Zero).unwrap(), [0.0, 1.0, 1.0, 0.0]);
        assert_eq!(
            spectrum.on(&grid, Outside::Refuse).unwrap_err().to_string(),
            "spectrum 'sigma': its samples cover 400..680 nm, the grid is 4 wavelengths in 390..690 nm; \
             choose a grid within the samples or extend the table"
        );
    }

    #[test]
    fn a_flat_spectrum_covers_every_grid() {
        let grid = WavelengthGrid::new(vec![1e-3, 550.0, 1e9]).unwrap();
        assert_eq!(Spectrum::flat("0.3", 0.3).on(&grid, Outside::Refuse).unwrap(), [0.3; 3]);
    }

    #[test]
    fn refuses_samples_that_do_not_fit() {
        assert!(Spectrum::new("short", vec![400.0, 500.0], vec![1.0]).is_err());
        assert!(Spectrum::new("nan", vec![400.0, 500.0], vec![1.0, f64::NAN]).is_err());
        assert!(Spectrum::new("back", vec![500.0, 400.0], vec![1.0, 1.0]).is_err());
    }
}
