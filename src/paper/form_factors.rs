//! Form factors between the facets of a fold, exact to rounding: eq. (10), with eq. (2) averaged over both
//! facets.

use super::FoldKernel;
use crate::geometry::Fold;
use crate::kernel::wedge::Wedge;

/// The exact form factors between the facets of `fold`.
///
/// # Source
/// Deeb et al., eqs. (2) and (10), averaged over both facets.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold};
/// use vfold::paper::form_factors;
/// // Two squares at a right angle exchange 0.20004 of their light (Howell, configuration C-14).
/// let kernel = form_factors(&Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?);
/// assert!((kernel.form_factor(0, 0, 0, 0) - 0.20004377607540316).abs() < 1e-14);
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn form_factors(fold: &Fold) -> FoldKernel {
    let wedge = Wedge::new(fold);
    FoldKernel::from_rows(fold, |row0, row1, shifts| wedge.exchange(row0, row1, shifts))
}
