//! The form factors of all pairs of patches, each by the most suitable formula.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use rayon::prelude::*;

use super::casters::{Between, Bounds, Casters};
use super::patches::Patch;
use super::site::Site;
use super::symmetric::Rows;
use super::{contour, far, partial};
use crate::error::{Error, Result};
use crate::surfaces::shape::Shape;

/// Patches that search for their casters together.
const BLOCK: usize = 32;
/// Exchange below this is rounding: a line of sight that just touches an edge.
const NOTHING: f64 = 1e-7;
/// Most entries stored: in single precision a gigabyte.
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

/// Assembles all pairs of patches.
pub(super) struct Assembly {
    sites: Vec<Site>,
    casters: Casters,
    tolerance: f64,
    entries: AtomicUsize,
    averted: AtomicUsize,
    open: AtomicUsize,
    walled: AtomicUsize,
    hidden: AtomicUsize,
}

impl Assembly {
    pub(super) fn new(shape: &Shape, patches: &[Patch], tolerance: f64) -> Self {
        let none = AtomicUsize::default;
        Self {
            sites: patches.iter().map(Site::new).collect(),
            casters: Casters::new(shape.facets(), shape.size()),
            tolerance,
            entries: none(),
            averted: none(),
            open: none(),
            walled: none(),
            hidden: none(),
        }
    }

    pub(super) fn census(&self) -> Census {
        let counts = [&self.averted, &self.open, &self.walled, &self.hidden];
        let [averted, open, walled, hidden] = counts.map(|count| count.load(Relaxed));
        Census { averted, open, walled, hidden }
    }

    /// All pairs, in strips of rows.
    ///
    /// # Errors
    /// [`Error::FullExchange`] if they exceed a gigabyte: then no more are computed.
    pub(super) fn strips(&self) -> Result<Vec<Rows>> {
        let count = self.sites.len();
        let bounds = |sites: &[Site]| Bounds::of(sites.iter().flat_map(|site| site.polygon.corners()));
        let bounds: Vec<Bounds> = self.sites.chunks(BLOCK).map(bounds).collect();
        let patches = |block: usize| block * BLOCK..((block + 1) * BLOCK).min(count);
        let all = self.casters.numbers();
        let strip = |block: usize| {
            if self.entries.load(Relaxed) > ENTRIES_MAX {
                return Err(Error::FullExchange { name: "shape".to_owned(), patches: count });
            }
            let rows = patches(block);
            let mut exchange = vec![vec![0.0; count - rows.start]; rows.len()];
            for other in block..bounds.len() {
                let casters = self.casters.between_boxes(&bounds[block], &bounds[other], &all);
                for (row, i) in exchange.iter_mut().zip(rows.clone()) {
                    for j in patches(other).filter(|j| *j > i) {
                        row[j - rows.start] = self.exchange(i, j, &casters);
                    }
                }
            }
            let strip = Rows::new(rows.start, &exchange);
            self.entries.fetch_add(strip.len(), Relaxed);
            Ok(strip)
        };
        (0..bounds.len()).into_par_iter().map(strip).collect()
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
        let exchange = far::exchange(&part_a, &part_b, [a.radius, b.radius], distance)
            .unwrap_or_else(|| contour::exchange(&part_a, &part_b));
        share * exchange.max(0.0) / (a.polygon.area() * b.polygon.area()).sqrt()
    }
}
