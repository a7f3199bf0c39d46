//! The wavelength grid shared by all computations of a scene.
//!
//! Paper section 3: the q wavebands of r(λ); section 5C uses 400..700 nm by 5 (q = 61), the default here.

use super::interpolation::even_step_nm;
use crate::error::{Error, Result};
use std::fmt;

/// More wavebands than facets with three channels can use, 300 to 2300 nm by 1: time and memory grow with
/// their square.
const MAX_WAVELENGTHS: usize = 2001;

/// Strictly increasing wavelengths in nm, 2 to 2001.
///
/// # Example
/// ```
/// use vfold::spectrum::WavelengthGrid;
/// let grid = WavelengthGrid::default();
/// assert_eq!(grid.len(), 61);
/// assert_eq!(grid.to_string(), "400..700 nm by 5");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct WavelengthGrid {
    wavelengths_nm: Vec<f64>,
}

impl WavelengthGrid {
    /// A grid of any spacing, from `wavelengths_nm`.
    ///
    /// # Errors
    /// Fewer than 2 wavelengths, more than 2001, or any that are not finite, positive and strictly
    /// increasing.
    pub fn new(wavelengths_nm: Vec<f64>) -> Result<Self> {
        check_rising(&wavelengths_nm)?;
        if wavelengths_nm.len() > MAX_WAVELENGTHS {
            return Err(too_many(wavelengths_nm.len() as f64));
        }
        Ok(Self { wavelengths_nm })
    }

    /// The grid `first_nm, first_nm + step_nm, …, last_nm`.
    ///
    /// # Errors
    /// The step is not positive, does not divide the range, or gives more than 2001 wavelengths.
    ///
    /// # Example
    /// ```
    /// use vfold::spectrum::WavelengthGrid;
    /// assert_eq!(WavelengthGrid::uniform(380.0, 780.0, 10.0)?.len(), 41);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn uniform(first_nm: f64, last_nm: f64, step_nm: f64) -> Result<Self> {
        let steps = ((last_nm - first_nm) / step_nm).round();
        let ends_at_last = (first_nm + steps * step_nm - last_nm).abs() < 1e-6 * step_nm;
        if !(step_nm > 0.0 && steps >= 1.0 && ends_at_last) {
            let problem = format!("steps of {step_nm} nm do not lead from {first_nm} to {last_nm} nm");
            return Err(bad(
                problem,
                "choose a positive step that divides the range, such as 400 to 700 by 5",
            ));
        }
        if steps >= MAX_WAVELENGTHS as f64 {
            return Err(too_many(steps + 1.0));
        }
        Self::new((0..=steps as usize).map(|i| first_nm + i as f64 * step_nm).collect())
    }

    /// The wavelengths, nm, increasing.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// The number of wavebands, q in the paper.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a grid is never empty")]
    pub fn len(&self) -> usize {
        self.wavelengths_nm.len()
    }

    /// First and last wavelength, nm.
    #[must_use]
    pub fn range_nm(&self) -> (f64, f64) {
        (self.wavelengths_nm[0], self.wavelengths_nm[self.len() - 1])
    }

    /// The wavelength before a waveband's, its own, and the one after it, nm; at either end as far away as
    /// the other neighbour.
    #[must_use]
    pub fn around_nm(&self, band: usize) -> [f64; 3] {
        let (all, at) = (&self.wavelengths_nm, self.wavelengths_nm[band]);
        let before = band.checked_sub(1).map(|before| all[before]);
        let after = all.get(band + 1).copied();
        let mirrored = |other: Option<f64>| other.map(|other| 2.0 * at - other);
        let either = |own: Option<f64>, other| own.or_else(|| mirrored(other)).unwrap_or(at);
        [either(before, after), at, either(after, before)]
    }

    /// Weights w with ∫f dλ ≈ Σ wᵢ f(λᵢ) by the trapezoid rule over the grid's range; they sum to that range.
    ///
    /// # Example
    /// ```
    /// use vfold::spectrum::WavelengthGrid;
    /// let grid = WavelengthGrid::new(vec![400.0, 500.0, 700.0])?;
    /// assert_eq!(grid.trapezoid_weights_nm(), [50.0, 150.0, 100.0]);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn trapezoid_weights_nm(&self) -> Vec<f64> {
        let mut weights_nm = vec![0.0; self.len()];
        for (i, pair) in self.wavelengths_nm.windows(2).enumerate() {
            let half_nm = (pair[1] - pair[0]) / 2.0;
            weights_nm[i] += half_nm;
            weights_nm[i + 1] += half_nm;
        }
        weights_nm
    }
}

/// Refuses anything but two or more increasing wavelengths in nm.
pub(super) fn check_rising(wavelengths_nm: &[f64]) -> Result<()> {
    if wavelengths_nm.len() < 2 {
        return Err(bad("fewer than two wavelengths".into(), "give at least two"));
    }
    if let Some(nm) = wavelengths_nm.iter().find(|nm| !nm.is_finite() || **nm <= 0.0) {
        return Err(bad(format!("{nm} nm is not a wavelength"), "give finite wavelengths above 0 nm"));
    }
    if let Some(pair) = wavelengths_nm.windows(2).find(|pair| pair[0] >= pair[1]) {
        let problem = format!("{} nm is followed by {} nm", pair[0], pair[1]);
        return Err(bad(problem, "sort the wavelengths and drop repeated ones"));
    }
    Ok(())
}

fn too_many(count: f64) -> Error {
    bad(format!("{count} wavelengths, more than {MAX_WAVELENGTHS}"), "choose a larger step")
}

fn bad(problem: String, remedy: &'static str) -> Error {
    Error::Grid { problem, remedy }
}

/// 400..700 nm by 5, the paper's grid.
impl Default for WavelengthGrid {
    fn default() -> Self {
        Self { wavelengths_nm: (0..61).map(|i| 400.0 + 5.0 * f64::from(i)).collect() }
    }
}

impl fmt::Display for WavelengthGrid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (first_nm, last_nm) = self.range_nm();
        match even_step_nm(&self.wavelengths_nm) {
            Some(step_nm) => write!(f, "{first_nm}..{last_nm} nm by {step_nm}"),
            None => write!(f, "{} wavelengths in {first_nm}..{last_nm} nm", self.len()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The integral of 1 is the range, the integral of λ is half the difference of the squares.
        #[test]
        fn trapezoid_integrates_lines_exactly(steps_nm in prop::collection::vec(0.1..50.0, 1..40)) {
            let mut nm = vec![380.0];
            for step_nm in steps_nm {
                nm.push(nm[nm.len() - 1] + step_nm);
            }
            let grid = WavelengthGrid::new(nm).unwrap();
            let (a, b) = grid.range_nm();
            let weights_nm = grid.trapezoid_weights_nm();
            let area: f64 = weights_nm.iter().sum();
            let moment: f64 = weights_nm.iter().zip(grid.wavelengths_nm()).map(|(w, nm)| w * nm).sum();
            prop_assert!((area - (b - a)).abs() < 1e-9 * (b - a));
            prop_assert!((moment - (b * b - a * a) / 2.0).abs() < 1e-9 * moment);
        }
    }

    #[test]
    fn default_is_the_papers_grid() {
        assert_eq!(WavelengthGrid::default(), WavelengthGrid::uniform(400.0, 700.0, 5.0).unwrap());
    }

    #[test]
    fn fractional_steps_reach_the_last_wavelength() {
        let grid = WavelengthGrid::uniform(400.0, 401.0, 0.1).unwrap();
        assert_eq!(grid.len(), 11);
        assert_eq!(grid.to_string(), "400..401 nm by 0.1");
    }

    #[test]
    fn refuses_what_is_no_grid() {
        for nm in [vec![], vec![500.0], vec![500.0, 500.0], vec![600.0, 500.0], vec![400.0, f64::NAN]] {
            assert!(WavelengthGrid::new(nm.clone()).is_err(), "{nm:?}");
        }
        for (first, last, step) in
            [(400.0, 700.0, 7.0), (700.0, 400.0, 5.0), (400.0, 700.0, 0.0), (400.0, 700.0, f64::NAN)]
        {
            assert!(WavelengthGrid::uniform(first, last, step).is_err(), "{first} {last} {step}");
        }
        let message = WavelengthGrid::uniform(400.0, 700.0, 0.02).unwrap_err().to_string();
        assert_eq!(message, "wavelength grid: 15001 wavelengths, more than 2001; choose a larger step");
        assert_eq!(WavelengthGrid::uniform(400.0, 700.0, 0.15).unwrap().len(), 2001);
        assert!(WavelengthGrid::new((1..=2002).map(f64::from).collect()).is_err());
    }

    #[test]
    fn uneven_grids_show_their_size() {
        let grid = WavelengthGrid::new(vec![400.0, 410.0, 430.0]).unwrap();
        assert_eq!(grid.to_string(), "3 wavelengths in 400..430 nm");
    }
}
