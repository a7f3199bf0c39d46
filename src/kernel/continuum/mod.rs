//! The bounces between two undivided panels: eqs. (1) to (4) without facets.
//!
//! One flat patch a facet is 4 % off at the crease of a bright 45° fold, however exact its form factors. Here the
//! radiosity is a function on the panel instead, resolved where it varies and nowhere else:
//!
//! - away from the crease, a Nyström rule in `u = ln s`, in which the kernel keeps its shape at every distance and its
//!   singularities stay `θ` away from the real axis. The strip next to the crease is one constant, and the difference
//!   between the exact share of the light of an endlessly long fold and the share that the rule finds is added to the
//!   diagonal: what the rule misses beside its nodes comes from near them;
//! - along the crease, Galerkin with Legendre polynomials on strips graded towards the ends, since there the kernel is
//!   far narrower than the radiosity is smooth. Only the shift `z = x − y` matters, so each pair of strips becomes one
//!   integral over z of the kernel times the correlation of two polynomials.
//!
//! Both converge exponentially. Lengths are in units of the panel's depth.

mod correlation;
mod crease;
mod rows;
mod table;

use nalgebra::DMatrix;
use rayon::prelude::*;

use self::crease::Crease;
use self::rows::Rows;
use self::table::Table;
use super::panel::PanelOperator;
use crate::geometry::{FacetGrid, Fold};

/// How finely the radiosity of a panel is resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Depth of the strip next to the crease on which radiosity is one constant, relative to the panel.
    pub crease_strip: f64,
    /// Longest panel of the rule in ln s, and its points.
    pub row_panel: f64,
    /// Points of the rule on a panel.
    pub row_order: usize,
    /// Width of the strip at each end of the crease, relative to the panel.
    pub end_strip: f64,
    /// The most that the strips' ends move away from one to the next, as a ratio.
    pub strip_growth: f64,
    /// Polynomials on a strip.
    pub strip_order: usize,
}

impl Resolution {
    /// Unknowns that a fold's panel takes.
    #[must_use]
    pub fn unknowns(&self, fold: &Fold) -> usize {
        let crease = Crease::new(fold.width() / fold.depths()[0], self);
        Rows::new(fold, self).len() * crease.strips.len() * crease.order
    }
}

/// The radiosity operator of one panel of a fold, and how to read facet means from its functions.
pub struct Continuum {
    matrix: DMatrix<f64>,
    uniform: Vec<f64>,
    facets: FacetGrid,
    /// Facet row by row node: mean over the facet row.
    row_pool: DMatrix<f64>,
    /// Facet column (first half) by polynomial: mean over the facet's width.
    col_pool: DMatrix<f64>,
}

impl Continuum {
    /// Discretises the exchange between the panels of `fold`.
    ///
    /// # Source
    /// Deeb et al., eq. (2), as the kernel of the integral equation that eqs. (1) to (4) iterate.
    #[must_use]
    pub fn new(fold: &Fold, resolution: &Resolution) -> Self {
        let rows = Rows::new(fold, resolution);
        let crease = Crease::new(fold.width() / fold.depths()[0], resolution);
        let facets = fold.facets();
        Self {
            matrix: assemble(&rows, &crease),
            uniform: rows.uniform().flat_map(|row| crease.uniform().map(move |col| row * col)).collect(),
            facets,
            row_pool: rows.means(facets.rows),
            col_pool: crease.means(facets.cols),
        }
    }
}

impl PanelOperator for Continuum {
    fn is_symmetric(&self) -> bool {
        true
    }

    fn uniform(&self, _panel: usize) -> Vec<f64> {
        self.uniform.clone()
    }

    fn apply(&self, _panel: usize, x: &[f64], out: &mut [f64]) {
        // The matrix is symmetric, so its contiguous columns serve as rows.
        let columns = self.matrix.as_slice().par_chunks_exact(x.len());
        columns.zip(out).with_min_len(100_000 / x.len()).for_each(|(column, out)| *out = dot(column, x));
    }

    fn facet_means(&self, _panel: usize, x: &[f64]) -> Vec<f64> {
        let x = DMatrix::from_column_slice(self.col_pool.ncols(), self.row_pool.ncols(), x);
        let means = &self.col_pool * x * self.row_pool.transpose();
        let FacetGrid { rows, cols } = self.facets;
        (0..rows * cols).map(|n| means[((n % cols).min(cols - 1 - n % cols), n / cols)]).collect()
    }
}

/// Dot product in four sums, so that it need not wait for each addition.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (mut sums, mut rest) = ([0.0; 4], 0.0);
    let (a, b) = (a.chunks_exact(4), b.chunks_exact(4));
    for (a, b) in a.remainder().iter().zip(b.remainder()) {
        rest += a * b;
    }
    for (a, b) in a.zip(b) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum::<f64>() + rest
}

/// The symmetric matrix of the operator: row node slow, strip, polynomial fast.
fn assemble(rows: &Rows, crease: &Crease) -> DMatrix<f64> {
    let (count, order) = (rows.len(), crease.order);
    let block = crease.strips.len() * order;
    let (nearest, furthest) = rows.distances();
    let table = Table::new(crease, nearest, furthest);
    let mut matrix = DMatrix::zeros(count * block, count * block);
    // Column blocks of one row node each: the upper half first, mirrored below.
    matrix.as_mut_slice().par_chunks_exact_mut(block * count * block).enumerate().for_each(|(j, columns)| {
        let mut integrals = vec![0.0; order * order];
        for i in 0..=j {
            let place = table.place(rows.q2(i, j));
            let factor = rows.factor(i, j);
            for pair in table.pairs() {
                pair.at(&place, &mut integrals);
                let [e, f] = pair.strips.map(|strip| strip * order);
                for (n, value) in integrals.iter().enumerate() {
                    let (at_e, at_f) = (e + n / order, f + n % order);
                    columns[at_f * count * block + i * block + at_e] = factor * value;
                    columns[at_e * count * block + i * block + at_f] = factor * value;
                }
            }
        }
    });
    add_missed(rows, block, &mut matrix);
    matrix.fill_lower_triangle_with_upper_triangle();
    matrix
}

fn add_missed(rows: &Rows, block: usize, matrix: &mut DMatrix<f64>) {
    let (strip, diagonal) = rows.missed();
    for (i, (strip, diagonal)) in strip.into_iter().zip(diagonal).enumerate() {
        for n in 0..block {
            let at = i * block + n;
            matrix[(at, at)] += diagonal;
            matrix[(n, at)] += strip;
        }
    }
}
