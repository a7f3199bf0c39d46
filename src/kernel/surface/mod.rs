//! The exchange of light between the facets of any surface, or between patches that divide them.
//!
//! A pair that nothing can stand between ([`casters`]) takes a formula ([`contour`], or [`far`] where it is right to ten digits);
//! any other loses what its casters hide ([`partial`], by exact shadows, [`shadow`]). Pairs of one plane and pairs that show each
//! other their backs exchange nothing. One number stands for both directions, so that reciprocity holds by construction.

pub mod casters;
pub mod contour;
pub mod direct;
pub mod far;
pub mod lit;
pub mod partial;
pub mod patches;
pub mod refinement;
pub mod shadow;
pub mod skylight;
pub mod sunlight;
pub mod symmetric;

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use rayon::prelude::*;

use self::casters::{Between, Bounds, Casters};
use self::patches::Patch;
use self::symmetric::Rows;
use super::exchange::Exchange;
use super::skipped::Skipped;
use crate::error::{Error, Result};
use crate::geometry::polygon::{Plane, Polygon, Vec3};
use crate::geometry::shape::{FACETS_MAX, Shape};

/// Patches that look for their casters together.
const BLOCK: usize = 32;
/// Groups of rows that are multiplied apart: their number is fixed, so that sums do not depend on the threads.
const GROUPS: usize = 16;
/// Shares of exchange below this are rounding: what is seen along a line of sight that an edge just touches.
const NOTHING: f64 = 1e-7;
/// More than this share of its light no patch hands on; the rest is rounding and the tolerance of partial shadows.
const ALL: f64 = 1.001;

/// Form factors between the patches of a surface.
#[derive(Clone, Debug)]
pub struct SurfaceKernel {
    root_areas: Vec<f64>,
    facet_of: Vec<usize>,
    /// `√A_i·K_ij/√A_j`, by blocks of rows.
    blocks: Vec<Rows>,
    census: Census,
}

/// How many pairs of patches were dealt with in which way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// In one plane or behind each other: they exchange nothing.
    pub averted: usize,
    /// Nothing can stand between them.
    pub open: usize,
    /// One facet hides all of one from all of the other.
    pub walled: usize,
    /// Others may stand between them: their shadows were cut out.
    pub hidden: usize,
}

impl SurfaceKernel {
    /// Form factors between `patches` of `shape`, all of them, in the order of its facets.
    ///
    /// # Arguments
    /// - `tolerance`: error of a partly hidden pair's form factor, relative to what it would be unhidden.
    ///
    /// # Errors
    /// [`Error::Shape`] if the patches are too many, or hand on more light than they have: facets that cross.
    ///
    /// # Source
    /// Deeb et al., eq. (10), averaged over both patches.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{FacetGrid, Fold, accordion::Accordion};
    /// use vfold::kernel::surface::{SurfaceKernel, patches::{Division, patches}};
    /// let valley = Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?;
    /// let v = Accordion { valley, creases: 1, ridge_deg: 90.0, bow_deg: 0.0 }.shape()?;
    /// let kernel = SurfaceKernel::new(&v, &patches(&v, Division::NONE), 1e-3)?;
    /// // Two squares at a right angle exchange 0.20004 of their light (Howell, configuration C-14).
    /// assert!((kernel.row_sums()[0] - 0.20004377607540316).abs() < 1e-7);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(shape: &Shape, patches: &[Patch], tolerance: f64) -> Result<Self> {
        if patches.len() > FACETS_MAX {
            let problem = format!("{} patches fill more than a gigabyte", patches.len());
            return Err(Error::shape(problem, format!("take a mesh of at most {FACETS_MAX}")));
        }
        let facet_of = patches.iter().map(|patch| patch.facet).collect();
        let root_areas = patches.iter().map(|patch| patch.polygon.area().sqrt()).collect();
        let assembly = Assembly::new(shape, patches, tolerance);
        let blocks = (0..assembly.bounds.len()).into_par_iter().map(|block| assembly.rows(block)).collect();
        let kernel = Self { root_areas, facet_of, blocks, census: assembly.census() };
        kernel.check()
    }

    fn check(self) -> Result<Self> {
        let largest = self.row_sums().into_iter().fold(0.0, f64::max);
        if largest > ALL {
            let problem = format!("a facet hands on {largest:.4} times its light");
            return Err(Error::shape(
                problem,
                "divide facets that cross or lie in each other along the lines where they do",
            ));
        }
        Ok(self)
    }

    /// How pairs of patches were dealt with.
    #[must_use]
    pub fn census(&self) -> Census {
        self.census
    }

    /// Number of exchanges that are kept: those of pairs that see each other.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.blocks.iter().map(Rows::len).sum()
    }

    /// Share of its light that each patch hands to others.
    #[must_use]
    pub fn row_sums(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.unknowns()];
        self.apply(&self.root_areas, &mut sums);
        sums.iter().zip(&self.root_areas).map(|(sum, root)| sum / root).collect()
    }

    /// One row of the matrix K of eq. (10) between the patches: the share of the light leaving patch `row` that reaches each.
    #[must_use]
    pub fn matrix_row(&self, row: usize) -> Vec<f64> {
        let entry = |other: usize| {
            let (first, last) = (row.min(other), row.max(other));
            self.blocks[first / BLOCK].get(first, last) * self.root_areas[other] / self.root_areas[row]
        };
        (0..self.unknowns()).map(entry).collect()
    }
}

impl Exchange for SurfaceKernel {
    fn root_areas(&self) -> &[f64] {
        &self.root_areas
    }

    fn facet_of(&self) -> &[usize] {
        &self.facet_of
    }

    fn apply(&self, x: &[f64], out: &mut [f64]) {
        let group = |blocks: &[Rows]| {
            let mut out = vec![0.0; x.len()];
            blocks.iter().for_each(|rows| rows.add_product(x, &mut out));
            out
        };
        let parts: Vec<Vec<f64>> =
            self.blocks.par_chunks(self.blocks.len().div_ceil(GROUPS)).map(group).collect();
        out.fill(0.0);
        for part in parts {
            out.iter_mut().zip(part).for_each(|(out, part)| *out += part);
        }
    }
}

impl Census {
    /// The work that was not done.
    #[must_use]
    pub fn skipped(&self) -> Vec<Skipped> {
        let skip = |what, count, why| Skipped { what, count, why };
        let mut list = vec![
            skip(
                "form factors of averted pairs",
                self.averted,
                "they lie in one plane or show each other their backs",
            ),
            skip("visibility tests", self.open, "no facet can stand between two others"),
            skip(
                "form factors of hidden pairs",
                self.walled,
                "one flat part of the surface hides all of one from the other",
            ),
        ];
        list.retain(|skip| skip.count > 0);
        list
    }
}

/// A patch with what is asked of it for every pair.
struct Site {
    polygon: Polygon,
    plane: Plane,
    centre: Vec3,
    radius: f64,
}

impl Site {
    fn new(patch: &Patch) -> Self {
        let (plane, centre) = (patch.polygon.plane(), patch.polygon.centroid());
        let radius =
            patch.polygon.corners().iter().map(|corner| (corner - centre).norm()).fold(0.0, f64::max);
        Self { polygon: patch.polygon.clone(), plane, centre, radius }
    }

    /// The part of this patch in front of the other's plane.
    fn in_front_of(&self, other: &Self, margin: f64) -> Option<Polygon> {
        let height = other.plane.height(&self.centre);
        if height >= self.radius {
            return Some(self.polygon.clone());
        }
        if height <= -self.radius {
            return None;
        }
        let heights = self.polygon.corners().iter().map(|corner| other.plane.height(corner));
        let (low, high) =
            heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        match (low >= -margin, high > margin) {
            (_, false) => None,
            (true, true) => Some(self.polygon.clone()),
            (false, true) => self.polygon.in_front_of(&other.plane),
        }
    }
}

/// All pairs of patches, block by block.
struct Assembly {
    sites: Vec<Site>,
    casters: Casters,
    bounds: Vec<Bounds>,
    tolerance: f64,
    averted: AtomicUsize,
    open: AtomicUsize,
    walled: AtomicUsize,
    hidden: AtomicUsize,
}

impl Assembly {
    fn new(shape: &Shape, patches: &[Patch], tolerance: f64) -> Self {
        let sites: Vec<Site> = patches.iter().map(Site::new).collect();
        let bounds = |sites: &[Site]| Bounds::of(sites.iter().flat_map(|site| site.polygon.corners()));
        let bounds = sites.chunks(BLOCK).map(bounds).collect();
        let casters = Casters::new(shape.facets(), shape.size());
        let none = AtomicUsize::default;
        Self {
            sites,
            casters,
            bounds,
            tolerance,
            averted: none(),
            open: none(),
            walled: none(),
            hidden: none(),
        }
    }

    fn census(&self) -> Census {
        let counts = [&self.averted, &self.open, &self.walled, &self.hidden];
        let [averted, open, walled, hidden] = counts.map(|count| count.load(Relaxed));
        Census { averted, open, walled, hidden }
    }

    /// The rows of a block, right of the diagonal.
    fn rows(&self, block: usize) -> Rows {
        let first = block * BLOCK;
        let own = first..(first + BLOCK).min(self.sites.len());
        let mut entries = vec![vec![0.0; self.sites.len() - first]; own.len()];
        let all = self.casters.numbers();
        for (other, bounds) in self.bounds.iter().enumerate().skip(block) {
            let casters = self.casters.between_boxes(&self.bounds[block], bounds, &all);
            let others = other * BLOCK..((other + 1) * BLOCK).min(self.sites.len());
            for (row, i) in entries.iter_mut().zip(own.clone()) {
                for j in others.clone().filter(|j| *j > i) {
                    row[j - first] = self.exchange(i, j, &casters);
                }
            }
        }
        let mut rows = Rows::default();
        own.zip(&entries).for_each(|(i, entries)| rows.push(i, first, entries));
        rows
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
