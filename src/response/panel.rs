//! What the bounces between two panels need from a discretisation.

/// The exchange between the panels of a fold, for light that does not vary along the crease.
///
/// Vectors hold a function on one panel in coordinates in which the exchange is symmetric (what panel 0 gives to panel 1
/// is the transpose of what it gets) and the dot product is the integral over the panel.
pub trait PanelOperator: Sync {
    /// Whether each panel is the other's mirror image, so that one stands for both.
    fn is_symmetric(&self) -> bool;

    /// The function that is 1 everywhere on `panel`.
    fn uniform(&self, panel: usize) -> Vec<f64>;

    /// `out = F·x`: the irradiance on `panel` that exitance `x` of the other panel causes.
    fn apply(&self, panel: usize, x: &[f64], out: &mut [f64]);

    /// Means of `x` over the facets of `panel`, row by row from the crease.
    fn facet_means(&self, panel: usize, x: &[f64]) -> Vec<f64>;
}
