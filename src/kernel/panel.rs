//! What the bounces between two equal panels need from a discretisation.

use crate::geometry::FacetGrid;

/// The exchange between a panel and its twin across the crease, restricted to functions that the mirror image along
/// the crease leaves unchanged: all that light without variation along the crease can excite.
///
/// Vectors hold a function on the panel in coordinates in which the operator is symmetric and the dot product is the
/// integral over the panel.
pub trait PanelOperator: Sync {
    /// The function that is 1 everywhere.
    fn uniform(&self) -> Vec<f64>;

    /// `out = F·x`: the irradiance that exitance `x` of one panel causes on the other.
    fn apply(&self, x: &[f64], out: &mut [f64]);

    /// Means of `x` over the facets of the panel, row by row from the crease.
    fn facet_means(&self, x: &[f64]) -> Vec<f64>;
}

/// Facet means of the half of a panel, mirrored to the whole: `half[row][col]` for the first `⌈cols/2⌉` columns.
#[must_use]
pub fn mirrored(grid: FacetGrid, half: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let fold_col = |col: usize| col.min(grid.cols - 1 - col);
    (0..grid.len()).map(|facet| half(facet / grid.cols, fold_col(facet % grid.cols))).collect()
}
