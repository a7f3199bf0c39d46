//! Positions of the strips of a fold.

use super::nodes::Nodes;
use super::resolution::Resolution;
use super::space::Space;
use super::strips::{Strips, graded};
use crate::geometry::Fold;

/// Distances below this fraction of that between the innermost strips count as equal: nothing changes any
/// more.
const NEAREST: f64 = 0.05;

/// Factor by which each additional strip narrows the first.
const NARROWING: f64 = 6.0;

/// Maximum ratio between the distances of consecutive strip ends.
const GROWTH: f64 = 5.0;

/// Width of the last strip at an outer edge, relative to the distance between the panels there.
const EDGE: f64 = 2.0;

/// The functions on the panels of a fold at a given resolution.
pub(super) struct Layout {
    pub(super) width: f64,
    pub(super) panels: [Space; 2],
    depths: [f64; 2],
}

impl Layout {
    pub(super) fn new(fold: &Fold, resolution: &Resolution) -> Self {
        let unit = fold.depths()[0];
        let (width, depths) = (fold.width() / unit, fold.depths().map(|depth| depth / unit));
        // In a narrow fold the panels face each other closely: light then varies over their distance rather
        // than their depth.
        let narrow = EDGE * fold.angle_rad().min(1.0);
        let across = |panel: usize| {
            let (own, other) = (depths[panel], depths[1 - panel]);
            // At the outer edge light varies over a length comparable with the distance to the other panel.
            let edge = |depth: f64| narrow * depth;
            let first = first_strip(resolution.crease_strips) * own.min(other).min(width);
            let mut edges = graded(0.0, own.min(other), first, edge(own.min(other)), GROWTH);
            if other < own {
                // The other panel's edge appears as sharp from beyond it as from below.
                edges.extend(&graded(other, own, edge(other), edge(own), GROWTH)[1..]);
            }
            Strips::new(&edges, resolution.order)
        };
        // At the ends of the crease, light also varies over the panels' distance, but hardly at all towards
        // its middle: the last strip may be arbitrarily wide.
        let end = first_strip(resolution.end_strips) * narrow * width.min(depths[0]).min(depths[1]);
        let along = Strips::new(&graded(0.0, 0.5 * width, end, width, GROWTH), resolution.order);
        let panels = [0, 1].map(|panel| Space { across: across(panel), along: along.clone() });
        Self { width, panels, depths }
    }

    /// Indicator functions of the facets of `panel` in the first half of the crease.
    pub(super) fn facets(&self, fold: &Fold, panel: usize) -> Space {
        let (unit, cols) = (fold.depths()[0], fold.facets().cols);
        let rows: Vec<_> = fold.row_edges()[panel].iter().map(|edge| edge / unit).collect();
        // A middle column ends at the middle of the crease: its other half is its mirror image.
        let col = |col: usize| (col as f64 * self.width / cols as f64).min(0.5 * self.width);
        let cols: Vec<_> = (0..=cols.div_ceil(2)).map(col).collect();
        Space { across: Strips::new(&rows, 1), along: Strips::new(&cols, 1) }
    }

    /// Relevant distances across the crease, with `count` nodes per e-fold.
    pub(super) fn nodes(&self, fold: &Fold, count: usize) -> Nodes {
        let ([d0, d1], half) = (self.depths, (fold.angle_rad() / 2.0).sin());
        let strip = self.panels.each_ref().map(|panel| panel.across.ends[0][1]);
        // The furthest points across the crease are the two outer edges, or an outer edge and the crease.
        let corner = ((d0 - d1).powi(2) + 4.0 * d0 * d1 * half * half).sqrt();
        Nodes::new(NEAREST * strip[0].min(strip[1]) * 2.0 * half, corner.max(d0).max(d1), count)
    }
}

/// Width of the first of this many strips whose ends grow by the factor [`NARROWING`] up to 0.5.
fn first_strip(strips: usize) -> f64 {
    0.5 * NARROWING.powf(1.0 - strips as f64)
}
