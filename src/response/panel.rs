//! What the bounces between two panels need from a discretisation.

/// The exchange between the panels of a fold, for light that does not vary along the crease.
///
/// Vectors hold a function on one panel in coordinates in which the exchange is symmetric (what panel 0 gives
/// to panel 1 is the transpose of what it gets) and the dot product is the integral over the panel.
pub trait PanelOperator: Sync {
    /// Whether facets are read after a bounce: by the light that functions throw on them, as it is and not as
    /// functions hold it.
    const AFTER_A_BOUNCE: bool = false;

    /// Whether each panel is the other's mirror image, so that one stands for both.
    fn is_symmetric(&self) -> bool;

    /// The function that is 1 everywhere on `panel`.
    fn uniform(&self, panel: usize) -> Vec<f64>;

    /// `out = F·x`: the irradiance on `panel` that exitance `x` of the other panel causes.
    fn apply(&self, panel: usize, x: &[f64], out: &mut [f64]);

    /// The irradiance on both panels that exitances `x` of both cause: an operator may do that in less time
    /// than for one after the other.
    fn apply_both(&self, x: [&[f64]; 2], out: [&mut [f64]; 2]) {
        let [out_0, out_1] = out;
        self.apply(0, x[1], out_0);
        self.apply(1, x[0], out_1);
    }

    /// Means over the facets of `panel`, row by row from the crease: of a function `x` on that panel or,
    /// after a bounce, of the irradiance F·x that exitance `x` of the other panel causes.
    fn facet_means(&self, panel: usize, x: &[f64]) -> Vec<f64>;
}
