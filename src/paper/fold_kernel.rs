//! The exchange between the facets of a fold: the distinct entries of the kernel matrix, from any method.

use std::ops::Range;

use nalgebra::DMatrix;
use ndarray::Array3;
use rayon::prelude::*;

use crate::error::Result;
use crate::geometry::{FacetGrid, Fold};
use crate::room;

/// Entries that justify another thread: a few thousand are finished before it has started.
const ENTRIES_A_THREAD: usize = 2000;

/// The distinct form factors of a fold, K of eq. (10).
///
/// Translation along the crease, mirror symmetry and reciprocity leave `rows² · cols` numbers of the `(2 ·
/// rows · cols)²` in the full matrix; panels of equal size leave `rows (rows + 1)/2 · cols`. Lengths are in
/// units of the facet's width along the crease.
#[derive(Clone, Debug)]
pub struct FoldKernel {
    facets: FacetGrid,
    row_edges: [Vec<f64>; 2],
    symmetric: bool,
    /// `A·F` of facet pairs: shift along the crease by pair of rows.
    exchange: DMatrix<f64>,
}

impl FoldKernel {
    /// The kernel whose entries for rows `i` of panel 0 and `j` of panel 1 are filled in by `exchange(i, j,
    /// shifts)` for every shift along the crease: area times form factor in units of the facet width squared.
    /// If the panels are alike, only `i ≤ j` is requested. Fewer than `pairs_a_thread` pairs of rows do not
    /// use another thread.
    ///
    /// # Returns
    /// The kernel, and the result of `exchange` for each pair of rows.
    #[must_use]
    pub fn from_exchange<T: Send>(
        fold: &Fold,
        pairs_a_thread: usize,
        exchange: impl Fn(usize, usize, &mut [f64]) -> T + Sync,
    ) -> (Self, Vec<T>) {
        let (facets, symmetric) = (fold.facets(), fold.is_symmetric());
        let FacetGrid { rows, cols } = facets;
        let first = |i: usize| if symmetric { i } else { 0 };
        let pairs: Vec<_> = (0..rows).flat_map(|i| (first(i)..rows).map(move |j| (i, j))).collect();
        let mut entries = DMatrix::zeros(cols, pairs.len());
        let of_pairs = entries.as_mut_slice().par_chunks_exact_mut(cols);
        let all = pairs.into_par_iter().zip(of_pairs).with_min_len(pairs_a_thread);
        let returned = all.map(|((i, j), shifts)| exchange(i, j, shifts)).collect();
        (Self { facets, row_edges: row_edges(fold), symmetric, exchange: entries }, returned)
    }

    /// Checks that the kernel of `fold` fits into memory.
    ///
    /// # Errors
    /// [`Error::Memory`](crate::Error::Memory) if it does not.
    pub fn check_room(fold: &Fold) -> Result<()> {
        let FacetGrid { rows, cols } = fold.facets();
        let pairs = if fold.is_symmetric() { rows * (rows + 1) / 2 } else { rows * rows };
        let bytes = pairs * cols * size_of::<f64>();
        room::ask(bytes as u64, "form factors", "use fewer facets")
    }

    /// The same from a function of the two rows' ranges of distance from the crease, which takes a
    /// microsecond per entry.
    #[must_use]
    pub fn from_rows(fold: &Fold, exchange: impl Fn(&Range<f64>, &Range<f64>, &mut [f64]) + Sync) -> Self {
        let [rows0, rows1] = row_ranges(fold);
        let pairs_a_thread = ENTRIES_A_THREAD.div_ceil(fold.facets().cols);
        Self::from_exchange(fold, pairs_a_thread, |i, j, shifts| exchange(&rows0[i], &rows1[j], shifts)).0
    }

    /// Facets of a panel.
    #[must_use]
    pub fn facets(&self) -> FacetGrid {
        self.facets
    }

    /// Whether each panel is the other's mirror image.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        self.symmetric
    }

    /// Number of distinct entries.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.exchange.len()
    }

    /// Area times form factor between facets of row `i` on panel 0 and row `j` on panel 1 for every shift
    /// along the crease, 0 to `cols − 1`, in units of the facet width squared.
    #[must_use]
    pub fn shifts(&self, i: usize, j: usize) -> &[f64] {
        self.exchange.column(self.pair(i, j)).data.into_slice()
    }

    /// The entries of every stored pair of rows, in order.
    pub(super) fn all_shifts(&self) -> impl IndexedParallelIterator<Item = &[f64]> {
        self.exchange.as_slice().par_chunks_exact(self.facets.cols)
    }

    /// Index of a pair of rows among those stored.
    pub(super) fn pair(&self, i: usize, j: usize) -> usize {
        let rows = self.facets.rows;
        if self.symmetric {
            let (i, j) = (i.min(j), i.max(j));
            i * rows - i * (i + 1) / 2 + j
        } else {
            i * rows + j
        }
    }

    /// Depth of row `i` of a panel in units of the facet width: the area of its facets.
    #[must_use]
    pub fn row_height(&self, panel: usize, i: usize) -> f64 {
        self.row_edges[panel][i + 1] - self.row_edges[panel][i]
    }

    /// Fraction of the light leaving a facet of row `i` of `panel` that reaches one of row `j` of the other
    /// panel, `shift` columns apart, in [0, 1].
    #[must_use]
    pub fn form_factor(&self, panel: usize, i: usize, j: usize, shift: usize) -> f64 {
        self.shifts_from(panel, i, j)[shift] / self.row_height(panel, i)
    }

    /// [`FoldKernel::shifts`] with `i` a row of `panel` and `j` one of the other.
    #[must_use]
    pub fn shifts_from(&self, panel: usize, i: usize, j: usize) -> &[f64] {
        if panel == 0 { self.shifts(i, j) } else { self.shifts(j, i) }
    }

    /// Fraction of its light that a facet in row `i`, column `col` of `panel` sends to the other panel, below
    /// 1.
    #[must_use]
    pub fn row_sum(&self, panel: usize, i: usize, col: usize) -> f64 {
        let FacetGrid { rows, cols } = self.facets;
        let to_row = |j: usize| {
            let shifts = self.shifts_from(panel, i, j);
            (0..cols).map(|other| shifts[col.abs_diff(other)]).sum::<f64>()
        };
        (0..rows).map(to_row).sum::<f64>() / self.row_height(panel, i)
    }

    /// One row of the full matrix K of eq. (10), facet order panel, row, column: `2 · rows · cols` numbers.
    #[must_use]
    pub fn matrix_row(&self, facet: usize) -> Vec<f64> {
        let FacetGrid { rows, cols } = self.facets;
        let (panel, [row, col]) = (facet / self.facets.len(), self.facets.place(facet % self.facets.len()));
        let entry = |(other, j, other_col): (usize, usize, usize)| match other == panel {
            true => 0.0,
            false => self.form_factor(panel, row, j, col.abs_diff(other_col)),
        };
        Array3::from_shape_fn((2, rows, cols), entry).into_iter().collect()
    }
}

/// Boundaries of the facet rows of both panels in units of the facet width.
fn row_edges(fold: &Fold) -> [Vec<f64>; 2] {
    let facet = fold.width() / fold.facets().cols as f64;
    fold.row_edges().map(|edges| edges.iter().map(|edge| edge / facet).collect())
}

/// Ranges of the facet rows of both panels, in units of the facet width.
pub(super) fn row_ranges(fold: &Fold) -> [Vec<Range<f64>>; 2] {
    row_edges(fold).map(|edges| edges.windows(2).map(|ends| ends[0]..ends[1]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Spacing;
    use crate::paper::form_factors;

    fn fold(angle_deg: f64, rows: usize, cols: usize) -> Fold {
        Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows, cols }).unwrap()
    }

    #[test]
    fn a_flat_sheet_exchanges_nothing() {
        assert_eq!(form_factors(&fold(180.0, 3, 3)).row_sum(0, 0, 0).to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn the_matrix_row_sums_to_the_row_sum() {
        let fold = fold(45.0, 4, 3).with_spacing(Spacing::Graded).with_panel1_depth(0.4).unwrap();
        let kernel = form_factors(&fold);
        for facet in 0..24 {
            let sum: f64 = kernel.matrix_row(facet).iter().sum();
            assert!((sum - kernel.row_sum(facet / 12, facet % 12 / 3, facet % 3)).abs() < 1e-14);
        }
    }
}
