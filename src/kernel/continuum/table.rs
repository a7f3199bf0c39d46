//! The integrals of all pairs of strips along the crease, tabulated over the distance across it.
//!
//! Every pair of rows has a distance between the same two bounds. In ln q the integrals are analytic up to
//! `Im ln q = ±π/2`, where the kernel's peak meets the path of integration, so a few Gauss nodes per e-fold give them all.
//! Times q³ they tend to a constant where q is small.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::correlation::Correlation;
use super::strips::Strips;
use crate::kernel::quadrature::{Lagrange, Rule};

/// Length of an interpolation panel in ln q: ρ = π + √(π² + 1) = 6.4, so that n nodes leave 6.4⁻ⁿ.
const PANEL: f64 = 1.0;

/// Distances at which functions of the distance are known.
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
        self.panels * self.rule.nodes.len()
    }

    fn distances(&self) -> Vec<f64> {
        let corner = |panel: usize| self.start + panel as f64 * PANEL;
        let on_panel = |panel: usize| self.rule.on(corner(panel), corner(panel + 1));
        (0..self.panels).flat_map(on_panel).map(|(u, _)| u.exp()).collect()
    }

    /// Nodes on a panel.
    pub(super) fn on_panel(&self) -> usize {
        self.rule.nodes.len()
    }

    /// The first of the nodes between which the distance `q` lies, and their weights; below the nearest it counts as that.
    pub(super) fn place(&self, q: f64, weights: &mut [f64]) -> usize {
        let along = ((q.ln() - self.start) / PANEL).max(0.0);
        let panel = (along as usize).min(self.panels - 1);
        self.lagrange.at(2.0 * (along - panel as f64) - 1.0, weights);
        panel * self.on_panel()
    }
}

/// Integrals of one pair of strips.
pub(super) struct StripPair {
    /// The strips, e ≤ f.
    pub(super) strips: [usize; 2],
    /// Pair of polynomials (b, d), d fast, by node; times q³.
    pub(super) values: DMatrix<f64>,
}

/// Tabulates all pairs of strips on the first half of a crease of this width, mirror images included.
pub(super) fn tabulate(strips: &Strips, width: f64, nodes: &Nodes) -> Vec<StripPair> {
    let distances = nodes.distances();
    let count = strips.ends.len();
    let pairs: Vec<_> = (0..count).flat_map(|e| (e..count).map(move |f| [e, f])).collect();
    let tabulate = |[e, f]: [usize; 2]| {
        let mut correlation = Correlation::new(strips.order);
        // Half the least distance is the width of the kernel's peak along the crease.
        let (near, [low, high], peak) = (strips.ends[e], strips.ends[f], 0.5 * nodes.start.exp());
        correlation.add(near, [low, high], false, peak);
        correlation.add(near, [width - high, width - low], true, peak);
        StripPair { strips: [e, f], values: correlation.integrals(&distances) }
    };
    pairs.into_par_iter().map(tabulate).collect()
}
