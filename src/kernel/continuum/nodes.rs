//! The distances across the crease at which integrals are tabulated.

use std::ops::Range;

use crate::kernel::quadrature::{Lagrange, Rule};

/// Length of an interpolation panel in ln q.
const PANEL: f64 = 1.0;
/// Logarithm of the factor by which each node on such a panel reduces the error: ρ = π + √(π² + 1).
const LN_RHO: f64 = 1.86;

/// Distances at which functions of the distance are tabulated.
pub(super) struct Nodes {
    start: f64,
    panels: usize,
    rule: Rule,
    lagrange: Lagrange,
}

impl Nodes {
    /// `count` nodes per e-fold from `nearest` to `furthest`.
    pub(super) fn new(nearest: f64, furthest: f64, count: usize) -> Self {
        let rule = Rule::gauss_legendre(count);
        let start = nearest.ln();
        let panels = ((furthest.ln() - start) / PANEL).ceil().max(1.0) as usize;
        Self { start, panels, lagrange: Lagrange::new(&rule.nodes), rule }
    }

    pub(super) fn len(&self) -> usize {
        self.panels * self.on_panel()
    }

    pub(super) fn distances(&self) -> Vec<f64> {
        let corner = |panel: usize| self.start + panel as f64 * PANEL;
        let on_panel = |panel: usize| self.rule.on(corner(panel), corner(panel + 1));
        (0..self.panels).flat_map(on_panel).map(|(u, _)| u.exp()).collect()
    }

    /// Number of nodes on a panel.
    pub(super) fn on_panel(&self) -> usize {
        self.rule.nodes.len()
    }

    /// Number of Gauss points that integrate a function whose ellipse of analyticity has this `rho` as
    /// accurately as the nodes interpolate.
    pub(super) fn points(&self, rho: f64) -> usize {
        (self.on_panel() as f64 * LN_RHO / (2.0 * rho.ln())).ceil() as usize
    }

    /// The nodes needed for distances in this range.
    pub(super) fn between(&self, [nearest, furthest]: [f64; 2]) -> Range<usize> {
        let on = self.on_panel();
        // Slightly widened to allow for rounding.
        let panel = |q: f64| (((q.ln() - self.start) / PANEL).max(0.0) as usize).min(self.panels - 1);
        panel(nearest * (1.0 - 1e-9)) * on..(panel(furthest * (1.0 + 1e-9)) + 1) * on
    }

    /// For each distance the index of the first of its interpolation nodes, and their weights: those of the
    /// first node for all distances, then those of the next. Distances below the nearest are replaced by it.
    pub(super) fn place(&self, distances: &[f64]) -> (Vec<usize>, Vec<f64>) {
        let place = |q: &f64| {
            let along = ((q.ln() - self.start) / PANEL).max(0.0);
            let panel = (along as usize).min(self.panels - 1);
            (panel * self.on_panel(), 2.0 * (along - panel as f64) - 1.0)
        };
        let (firsts, places): (Vec<_>, Vec<_>) = distances.iter().map(place).unzip();
        let mut weights = vec![0.0; self.on_panel() * distances.len()];
        self.lagrange.at_all(&places, &mut weights);
        (firsts, weights)
    }
}
