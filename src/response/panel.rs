//! What a discretisation must provide for the bounces between two panels.

/// The exchange between the panels of a fold, for light that does not vary along the crease.
///
/// Vectors represent a function on one panel in coordinates in which the exchange is symmetric (the map from
/// panel 0 to panel 1 is the transpose of the reverse one) and the dot product is the integral over the
/// panel.
pub trait PanelOperator: Sync {
    /// True if facets are read after a bounce, from the exact irradiance of a function instead of its
    /// representation.
    const AFTER_A_BOUNCE: bool = false;

    /// True if the panels are mirror images of each other, so that one represents both.
    fn is_symmetric(&self) -> bool;

    /// The function that is 1 everywhere on `panel`.
    fn uniform(&self, panel: usize) -> Vec<f64>;

    /// `out = F·x`: the irradiance on `panel` that exitance `x` of the other panel causes.
    fn apply(&self, panel: usize, x: &[f64], out: &mut [f64]);

    /// The irradiance on both panels caused by exitances `x` of both; an operator may do this faster than one
    /// panel after the other.
    fn apply_both(&self, x: [&[f64]; 2], out: [&mut [f64]; 2]) {
        let [out_0, out_1] = out;
        self.apply(0, x[1], out_0);
        self.apply(1, x[0], out_1);
    }

    /// Facet means on `panel`, row by row from the crease: of a function `x` on that panel or, after a
    /// bounce, of the irradiance F·x caused by exitance `x` of the other panel.
    fn facet_means(&self, panel: usize, x: &[f64]) -> Vec<f64>;
}
