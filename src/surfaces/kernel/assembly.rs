//! The form factors of all pairs of patches, each by the most suitable formula.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use rayon::prelude::*;

use super::block::Block;
use super::casters::{Between, Bounds, Casters};
use super::site::Site;
use super::symmetric::Rows;
use super::{contour, far, partial};
use crate::surfaces::shape::Shape;

/// Patches that search for their casters together.
const BLOCK: usize = 32;
/// Exchange below this is rounding: a line of sight that just touches an edge.
const NOTHING: f64 = 1e-7;

/// Most entries stored: in single precision and with their indices a gigabyte.
const ENTRIES_MAX: usize = 240_000_000;

/// Numbers of pairs of patches by treatment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// Coplanar or behind each other: no exchange.
    pub averted: usize,
    /// Nothing can be between them.
    pub open: usize,
    /// One facet hides them completely from each other.
    pub walled: usize,
    /// Others may be between them: their shadows were cut out.
    pub hidden: usize,
}

/// Assembles all pairs of patches, part by part.
pub(super) struct Assembly {
    pub(super) sites: Vec<Site>,
    pub(super) casters: Casters,
    tolerance: f64,
    /// Relative error of the rules for distant pairs.
    truncation: f64,
    numbers: AtomicUsize,
    averted: AtomicUsize,
    open: AtomicUsize,
    walled: AtomicUsize,
    hidden: AtomicUsize,
}

impl Assembly {
    pub(super) fn new(shape: &Shape, sites: Vec<Site>, [tolerance, truncation]: [f64; 2]) -> Self {
        let none = AtomicUsize::default;
        Self {
            sites,
            casters: Casters::new(shape.facets(), shape.size()),
            tolerance,
            truncation,
            numbers: none(),
            averted: none(),
            open: none(),
            walled: none(),
            hidden: none(),
        }
    }

    /// Whether the limit of entries is exceeded: then no more are computed.
    pub(super) fn is_full(&self) -> bool {
        self.numbers.load(Relaxed) > ENTRIES_MAX
    }

    pub(super) fn count_averted(&self, pairs: usize) {
        self.averted.fetch_add(pairs, Relaxed);
    }

    pub(super) fn count_walled(&self, pairs: usize) {
        self.walled.fetch_add(pairs, Relaxed);
    }

    pub(super) fn count_open(&self, pairs: usize) {
        self.open.fetch_add(pairs, Relaxed);
    }

    pub(super) fn census(&self) -> Census {
        let counts = [&self.averted, &self.open, &self.walled, &self.hidden];
        let [averted, open, walled, hidden] = counts.map(|count| count.load(Relaxed));
        Census { averted, open, walled, hidden }
    }

    /// All pairs, in strips of rows.
    pub(super) fn strips(&self) -> Vec<Block> {
        let count = self.sites.len();
        let bounds = |sites: &[Site]| Bounds::of(sites.iter().flat_map(|site| site.polygon.corners()));
        let bounds: Vec<Bounds> = self.sites.chunks(BLOCK).map(bounds).collect();
        let patches = |block: usize| block * BLOCK..((block + 1) * BLOCK).min(count);
        let all = self.casters.numbers();
        let strip = |block: usize| {
            let others = (block..bounds.len()).map(|other| {
                (patches(other), self.casters.between_boxes(&bounds[block], &bounds[other], &all))
            });
            self.rows(patches(block), patches(block).start..count, others)
        };
        (0..bounds.len()).into_par_iter().map(strip).collect()
    }

    /// The exchange of patches with others further right, past `casters`; `None` if there is none.
    pub(super) fn block(
        &self,
        rows: Range<usize>,
        columns: Range<usize>,
        casters: &[usize],
    ) -> Option<Block> {
        let block = self.rows(rows, columns.clone(), std::iter::once((columns, casters.to_vec())));
        (!block.entries.is_empty()).then_some(block)
    }

    /// The exchange right of the diagonal between `rows` and `columns`, in parts with the casters between
    /// them.
    fn rows(
        &self,
        rows: Range<usize>,
        columns: Range<usize>,
        parts: impl Iterator<Item = (Range<usize>, Vec<usize>)>,
    ) -> Block {
        let mut exchange = vec![vec![0.0; columns.len()]; rows.len()];
        for (others, casters) in parts.take_while(|_| !self.is_full()) {
            for (row, i) in exchange.iter_mut().zip(rows.clone()) {
                for j in others.clone().filter(|j| *j > i) {
                    row[j - columns.start] = self.exchange(i, j, &casters);
                }
            }
        }
        let mut entries = Rows::default();
        rows.clone().zip(&exchange).for_each(|(i, row)| entries.push(i, columns.start, row));
        self.numbers.fetch_add(entries.len(), Relaxed);
        Block { rows, columns, entries }
    }

    /// `√A_i·K_ij/√A_j`.
    fn exchange(&self, i: usize, j: usize, casters: &[usize]) -> f64 {
        let (a, b, margin) = (&self.sites[i], &self.sites[j], self.casters.margin());
        let (Some(part_a), Some(part_b)) = (a.in_front_of(b, margin), b.in_front_of(a, margin)) else {
            self.averted.fetch_add(1, Relaxed);
            return 0.0;
        };
        let between = if casters.is_empty() {
            Between::Nothing
        } else {
            self.casters.between(&part_a, &part_b, casters)
        };
        let (count, share) = match &between {
            Between::Nothing => (&self.open, 1.0),
            Between::Wall => (&self.walled, 0.0),
            Between::Some(casters) => {
                (&self.hidden, partial::visible_share(&part_a, &part_b, casters, self.tolerance))
            }
        };
        count.fetch_add(1, Relaxed);
        if share < NOTHING {
            return 0.0;
        }
        let distance = (a.centre - b.centre).norm();
        let exchange = match far::orders([&part_a, &part_b], [a.radius, b.radius], distance, self.truncation)
        {
            Some([of_a, of_b]) => far::exchange(
                [&a.nodes(&part_a, of_a), &b.nodes(&part_b, of_b)],
                [part_a.normal(), part_b.normal()],
            ),
            None => contour::exchange(&part_a, &part_b),
        };
        share * exchange.max(0.0) / (a.polygon.area() * b.polygon.area()).sqrt()
    }
}
