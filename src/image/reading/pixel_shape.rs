//! The shape of pixels, where a file states it: angles are measured in pixels, which must be square.

use std::path::Path;

use crate::{Error, Result};

/// Largest relative difference between equal sides: writers round resolutions.
const SAME: f64 = 5e-3;

pub(super) const RESAMPLE: &str =
    "resample it to square pixels, or correct what it states if they are square";

/// Checks the pixels per unit of length, across and down, that a file states in a place.
///
/// # Errors
/// [`Error::Picture`] if they are not square. A number that is missing or zero states nothing.
pub(super) fn check(path: &Path, by: &str, density: Option<[f64; 2]>) -> Result<()> {
    let objection = density.and_then(|[across, down]| objection(by, down / across));
    objection.map_or(Ok(()), |problem| Err(Error::picture(path, problem, RESAMPLE)))
}

/// Objection to pixels of this width divided by their height.
pub(super) fn objection(by: &str, aspect: f64) -> Option<String> {
    let is_stated = aspect.is_finite() && aspect > 0.0;
    let is_other = (aspect - 1.0).abs() > SAME;
    let rounded = (1000.0 * aspect).round() / 1000.0;
    (is_stated && is_other).then(|| format!("by its {by}, its pixels are {rounded} times as wide as high"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_square_unless_stated_otherwise() {
        let check = |density| check(Path::new("a.png"), "pHYs", density).err().map(|error| error.to_string());
        for density in [None, Some([72.0; 2]), Some([0.0; 2]), Some([0.0, 72.0]), Some([300.0, 299.0])] {
            assert_eq!(check(density), None, "{density:?}");
        }
        assert_eq!(
            check(Some([1000.0, 1067.0])).unwrap(),
            format!("a.png: by its pHYs, its pixels are 1.067 times as wide as high; {RESAMPLE}")
        );
        assert!(check(Some([2.0, 1.0])).unwrap().contains("0.5 times as wide"));
    }
}
