//! The bounces between two undivided panels: eqs. (1) to (4) without facets.
//!
//! One flat patch per facet is 4 % off at the crease of a bright 45° fold, however exact its form factors. Here the
//! radiosity is a function on the panel instead, a polynomial on each of a few strips in both directions (Galerkin's method).
//! Strips narrow geometrically towards the crease, its ends and the outer edges, where the light changes fast; so a few
//! more polynomials make the error ten times smaller, wherever that is needed.
//!
//! An entry integrates the kernel over two strips along the crease and two across it. Along the crease only the shift
//! `z = x − y` matters (`correlation`), and the result is a function of the distance q across it alone (`table`); the integrals
//! across become weights of that function's values (`rows`), and all entries of two rows are one matrix product.
//! Lengths are in units of panel 0's depth.

mod correlation;
mod exchange;
mod rows;
mod strips;
mod table;

use std::f64::consts::FRAC_PI_4;

use nalgebra::{DMatrix, DMatrixView, DMatrixViewMut};
use rayon::prelude::*;

use self::exchange::Exchange;
use self::rows::Rows;
use self::strips::{Strips, graded};
use self::table::{Nodes, StripPair, tabulate};
use crate::geometry::{FacetGrid, Fold};
use crate::response::PanelOperator;

/// Distances below this share of that of the nearest strips count as equal: nothing changes there any more.
const NEAREST: f64 = 0.05;

/// How much further away the end of a strip is from one to the next, as a ratio.
const GROWTH: f64 = 6.0;

/// Width of the first of this many strips, which together reach 0.5.
fn first_strip(strips: usize) -> f64 {
    0.5 * GROWTH.powf(1.0 - strips as f64)
}

/// How finely the radiosity of a panel is resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Strips from the crease to the middle of a square panel.
    pub crease_strips: usize,
    /// Strips from the end of the crease to its middle, on a square panel opened by a radian.
    pub end_strips: usize,
    /// Polynomials on a strip across and along the crease.
    pub orders: [usize; 2],
    /// Nodes per e-fold of the distance.
    pub nodes: usize,
}

/// The strips of a fold at some resolution.
struct Layout {
    width: f64,
    depths: [f64; 2],
    /// Across each panel.
    across: [Strips; 2],
    /// Along the first half of the crease; the other is its mirror image.
    along: Strips,
}

impl Layout {
    fn new(fold: &Fold, resolution: &Resolution) -> Self {
        let unit = fold.depths()[0];
        let (width, depths) = (fold.width() / unit, fold.depths().map(|depth| depth / unit));
        // In a narrow fold the panels face each other closely: light then varies over their distance instead of their depth.
        let narrow = fold.angle_rad().min(1.0);
        let across = |panel: usize| {
            let (own, other) = (depths[panel], depths[1 - panel]);
            // At the outer edge light varies over as much as the other panel is away.
            let edge = |depth: f64| narrow * depth;
            let first = first_strip(resolution.crease_strips) * own.min(other).min(width);
            let mut edges = graded(0.0, own.min(other), first, edge(own.min(other)), GROWTH);
            if other < own {
                // The other panel's edge is seen from beyond it as sharply as from below.
                edges.extend(&graded(other, own, edge(other), edge(own), GROWTH)[1..]);
            }
            Strips::new(&edges, resolution.orders[0])
        };
        // Light varies over the panels' distance at the crease's ends too, but towards its middle hardly at all: the last strip
        // may be as wide as it likes.
        let end = first_strip(resolution.end_strips) * narrow * width.min(depths[0]).min(depths[1]);
        let along = graded(0.0, 0.5 * width, end, width, GROWTH);
        let along = Strips::new(&along, resolution.orders[1]);
        Self { width, depths, across: [across(0), across(1)], along }
    }

    fn unknowns(&self, panel: usize) -> usize {
        self.across[panel].len() * self.along.len()
    }

    /// Distances across the crease that matter.
    fn nodes(&self, fold: &Fold, count: usize) -> Nodes {
        let ([d0, d1], half) = (self.depths, (fold.angle_rad() / 2.0).sin());
        let strip = self.across[0].ends[0][1].min(self.across[1].ends[0][1]);
        // The furthest points across the crease are the outer edges, or an outer edge and the crease.
        let corner = ((d0 - d1).powi(2) + 4.0 * d0 * d1 * half * half).sqrt();
        Nodes::new(NEAREST * strip * 2.0 * half, corner.max(d0).max(d1), count)
    }
}

impl Resolution {
    /// The resolution that reaches about `aim`, a relative error of facet means at reflectance 1; found by trying.
    #[must_use]
    pub fn reaching(aim: f64, fold: &Fold) -> Self {
        // Light bounces longer in narrow folds, and errors with it.
        let aim = aim * fold.angle_rad().min(FRAC_PI_4).sqrt();
        // What a twentieth of the error takes.
        let levels = (1e-5 / aim).ln() / 20_f64.ln();
        let count = |at_1e5: f64, a_level: f64| (at_1e5 + a_level * levels).ceil().max(2.0) as usize;
        Self {
            crease_strips: count(3.0, 1.0),
            end_strips: count(1.5, 0.7),
            orders: [count(8.2, 2.4), count(6.5, 2.0)],
            nodes: count(10.0, 1.6).max(4),
        }
    }

    /// Unknowns that the larger of a fold's panels takes.
    #[must_use]
    pub fn unknowns(&self, fold: &Fold) -> usize {
        let layout = Layout::new(fold, self);
        layout.unknowns(0).max(layout.unknowns(1))
    }
}

/// The radiosity operator of a fold, and how to read facet means from its functions.
pub struct Continuum {
    exchange: Exchange,
    uniform: [Vec<f64>; 2],
    facets: FacetGrid,
    /// For each panel, facet row by function across it.
    row_pools: [DMatrix<f64>; 2],
    /// Facet column (first half) by function along the crease.
    col_pool: DMatrix<f64>,
}

impl Continuum {
    /// Discretises the exchange between the panels of `fold`.
    ///
    /// # Source
    /// Deeb et al., eq. (2), as the kernel of the integral equation that eqs. (1) to (4) iterate.
    #[must_use]
    pub fn new(fold: &Fold, resolution: &Resolution) -> Self {
        let layout = Layout::new(fold, resolution);
        let nodes = layout.nodes(fold, resolution.nodes);
        let pairs = tabulate(&layout.along, layout.width, &nodes);
        let alike = fold.is_symmetric();
        let matrix = assemble(&layout, alike, &Rows::new(fold, resolution.orders[0]), &nodes, &pairs);
        let exchange =
            if alike { Exchange::Alike(matrix) } else { Exchange::Differing([matrix.transpose(), matrix]) };
        let unit = fold.depths()[0];
        let edges = fold.row_edges();
        let rows = |panel: usize| -> Vec<_> {
            edges[panel].windows(2).map(|ends| [ends[0] / unit, ends[1] / unit]).collect()
        };
        let cols = fold.facets().cols;
        let facet = layout.width / cols as f64;
        let col = |col: usize| {
            // A middle column ends at the middle: its other half is its mirror image.
            [col as f64 * facet, ((col + 1) as f64 * facet).min(0.5 * layout.width)]
        };
        let cols: Vec<_> = (0..cols.div_ceil(2)).map(col).collect();
        let uniform = |panel: usize| {
            let along = |across: f64| layout.along.uniform().map(move |along| across * along);
            layout.across[panel].uniform().flat_map(along).collect()
        };
        Self {
            exchange,
            uniform: [uniform(0), uniform(1)],
            facets: fold.facets(),
            row_pools: [0, 1].map(|panel| layout.across[panel].means(&rows(panel))),
            col_pool: layout.along.means(&cols),
        }
    }
}

impl PanelOperator for Continuum {
    fn is_symmetric(&self) -> bool {
        matches!(self.exchange, Exchange::Alike(_))
    }

    fn uniform(&self, panel: usize) -> Vec<f64> {
        self.uniform[panel].clone()
    }

    fn apply(&self, panel: usize, x: &[f64], out: &mut [f64]) {
        self.exchange.apply(panel, x, out);
    }

    fn facet_means(&self, panel: usize, x: &[f64]) -> Vec<f64> {
        let row_pool = &self.row_pools[panel];
        let x = DMatrixView::from_slice(x, self.col_pool.ncols(), row_pool.ncols());
        let means = &self.col_pool * x * row_pool.transpose();
        let FacetGrid { rows, cols } = self.facets;
        // Light is even along the crease: its second half is the mirror image of the first.
        DMatrix::from_fn(cols, rows, |col, row| means[(col.min(cols - 1 - col), row)]).data.into()
    }
}

/// The matrix of the exchange, functions of panel 0 by functions of panel 1: across the crease slow, along it fast. Of panels
/// that are `alike` the upper triangle alone.
fn assemble(layout: &Layout, alike: bool, rows: &Rows, nodes: &Nodes, pairs: &[StripPair]) -> DMatrix<f64> {
    let [across0, across1] = &layout.across;
    let (along, order) = (layout.along.len(), across0.order);
    let (height, width) = (layout.unknowns(0), layout.unknowns(1));
    // Zeros that nobody wrote take no memory: what is never set costs nothing.
    let mut matrix = DMatrix::from_vec(height, width, vec![0.0; height * width]);
    // Columns of one strip of panel 1 each.
    let strips = matrix.as_mut_slice().par_chunks_exact_mut(order * along * height).enumerate();
    strips.for_each(|(j, columns)| {
        let mut columns = DMatrixViewMut::from_slice(columns, height, order * along);
        for (i, strip) in across0.ends.iter().enumerate() {
            // Of panels that are alike, what strip i gives to j is the transpose of what j gives to i.
            if alike && i > j {
                continue;
            }
            let weights = rows.weights(*strip, across1.ends[j], nodes);
            for pair in pairs {
                let block = &pair.values * &weights;
                for (mn, values) in block.column_iter().enumerate() {
                    let (m, n) = (mn / order, mn % order);
                    let at = ((i * order + m) * along, n * along);
                    place(
                        columns.view_mut(at, (along, along)),
                        values.as_slice(),
                        pair.strips,
                        layout.along.order,
                    );
                }
            }
        }
    });
    matrix
}

/// Puts what two strips along the crease exchange, polynomials (b, d), d fast, where they belong among all functions along it.
fn place(mut along: DMatrixViewMut<f64>, values: &[f64], [e, f]: [usize; 2], order: usize) {
    let (values, size) = (DMatrixView::from_slice(values, order, order), (order, order));
    along.view_mut((f * order, e * order), size).copy_from(&values);
    if e != f {
        // The kernel does not tell which end of the shift is on which panel: so b and d may change places.
        along.view_mut((e * order, f * order), size).tr_copy_from(&values);
    }
}
