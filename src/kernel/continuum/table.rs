//! The integrals of all pairs of strips, tabulated over the distance across the crease.
//!
//! Thousands of pairs of rows have distances between the same two bounds. In ln q the integrals are analytic up to
//! `Im ln q = ±π/2`, where the kernel's peak meets the path of integration, so a few Gauss nodes an e-fold give them all.

use rayon::prelude::*;

use super::crease::Crease;
use crate::kernel::quadrature::{Lagrange, Rule};

/// Length of an interpolation panel in ln q, and its nodes: ρ = π + √(π² + 1) = 6.4, so that 16 leave 1e-13.
const PANEL: f64 = 1.0;
const NODES: usize = 16;

/// Integrals of pairs of strips as functions of the distance.
pub(super) struct Table {
    start: f64,
    last_panel: usize,
    lagrange: Lagrange,
    /// For each pair of strips e ≤ f: node by pair of polynomials.
    pairs: Vec<StripPair>,
}

/// Integrals of one pair of strips.
pub(super) struct StripPair {
    /// The strips, e ≤ f.
    pub(super) strips: [usize; 2],
    values: Vec<f64>,
    size: usize,
}

/// Where a distance lies in the table.
pub(super) struct Place {
    first: usize,
    weights: Vec<f64>,
}

impl Table {
    /// Tabulates all pairs of strips of `crease` between two distances.
    pub(super) fn new(crease: &Crease, nearest: f64, furthest: f64) -> Self {
        let rule = Rule::gauss_legendre(NODES);
        let start = nearest.ln();
        let panels = ((furthest.ln() - start) / PANEL).ceil().max(1.0) as usize;
        let corner = |panel: usize| start + panel as f64 * PANEL;
        let nodes = (0..panels)
            .flat_map(|panel| rule.on(corner(panel), corner(panel + 1)))
            .map(|(u, _)| (2.0 * u).exp());
        let squares: Vec<f64> = nodes.collect();
        let count = crease.strips.len();
        let pairs: Vec<_> = (0..count).flat_map(|e| (e..count).map(move |f| [e, f])).collect();
        let tabulate = |strips: [usize; 2]| {
            // Half the least distance is the width of the kernel's peak along the crease.
            let correlation = crease.correlation(strips[0], strips[1], 0.5 * nearest);
            let size = crease.order * crease.order;
            let mut values = vec![0.0; squares.len() * size];
            for (q2, values) in squares.iter().zip(values.chunks_exact_mut(size)) {
                correlation.integrate(*q2, values);
            }
            StripPair { strips, values, size }
        };
        let pairs = pairs.into_par_iter().map(tabulate).collect();
        Self { start, last_panel: panels - 1, lagrange: Lagrange::new(&rule.nodes), pairs }
    }

    /// The pairs of strips.
    pub(super) fn pairs(&self) -> &[StripPair] {
        &self.pairs
    }

    /// Where the squared distance `q2` lies.
    pub(super) fn place(&self, q2: f64) -> Place {
        let along = (0.5 * q2.ln() - self.start) / PANEL;
        let panel = (along.max(0.0) as usize).min(self.last_panel);
        let weights = self.lagrange.at(2.0 * (along - panel as f64) - 1.0);
        Place { first: panel * NODES, weights }
    }
}

impl StripPair {
    /// The integrals at a place, `out[b * order + d]`.
    pub(super) fn at(&self, place: &Place, out: &mut [f64]) {
        out.fill(0.0);
        let rows = self.values[place.first * self.size..].chunks_exact(self.size);
        for (weight, row) in place.weights.iter().zip(rows) {
            out.iter_mut().zip(row).for_each(|(out, value)| *out += weight * value);
        }
    }
}
