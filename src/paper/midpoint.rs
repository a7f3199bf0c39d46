//! Form factors from facet centres: eq. (2) as printed, times area over pi, as in eq. (10).
//!
//! Accurate for facets far apart. Facets that meet at the crease exchange too much at any size, since
//! distances from centre to centre shrink with them: at 45° with 10 x 10 facets a facet passes on 2.09 times
//! its light, and the bounces diverge.

use std::f64::consts::PI;

use super::fold_kernel::FoldKernel;
use crate::geometry::Fold;

/// The form factors of `fold` with the kernel of eq. (2) evaluated at the facets' centres.
///
/// # Source
/// Deeb et al., eqs. (2) and (10).
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold};
/// use vfold::paper::midpoint::form_factors;
/// // Unit squares at a right angle, centres at (½, 0) and (0, ½): (1/π)·½·½/(½)² = 1/π; the exact value
/// // is 0.20004.
/// let kernel = form_factors(&Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?);
/// assert!((kernel.form_factor(0, 0, 0, 0) - std::f64::consts::FRAC_1_PI).abs() < 1e-15);
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn form_factors(fold: &Fold) -> FoldKernel {
    let points = PointKernel::new(fold);
    FoldKernel::from_rows(fold, |row0, row1, shifts| {
        let [s, t] = [row0, row1].map(|row| 0.5 * (row.start + row.end));
        let areas = (row0.end - row0.start) * (row1.end - row1.start);
        shifts.iter_mut().enumerate().for_each(|(k, value)| *value = areas * points.at(s, t, k as f64));
    })
}

/// The kernel of eq. (2) over pi, between points of the two panels.
#[derive(Clone, Copy, Debug)]
pub struct PointKernel {
    scale: f64,
    /// `2(1 − cosθ)`, computed without cancellation for small θ.
    spread: f64,
}

impl PointKernel {
    /// The kernel of a fold; zero if it is flat.
    #[must_use]
    pub fn new(fold: &Fold) -> Self {
        let (sin, half_sin) = (fold.angle_rad().sin(), (0.5 * fold.angle_rad()).sin());
        let scale = if fold.is_flat() { 0.0 } else { sin * sin / PI };
        Self { scale, spread: 4.0 * half_sin * half_sin }
    }

    /// `sin²θ·s·t / (π r⁴)` for points at distances `s` and `t` from the crease, `z` apart along it, in any
    /// unit of length.
    #[must_use]
    #[inline]
    pub fn at(&self, s: f64, t: f64, z: f64) -> f64 {
        let r2 = (s - t) * (s - t) + self.spread * s * t + z * z;
        self.scale * s * t / (r2 * r2)
    }
}
