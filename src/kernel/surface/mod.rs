//! The exchange of light between the facets of any surface, or between patches that divide them.
//!
//! A pair that nothing can stand between ([`casters`]) takes a formula ([`contour`], or [`far`] where it is right to ten digits);
//! any other loses what its casters hide ([`partial`], by exact shadows, [`shadow`]). Pairs of one plane and pairs that show each
//! other their backs exchange nothing. One number stands for both directions, so that reciprocity holds by construction.

mod assembly;
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

use rayon::prelude::*;

pub use self::assembly::Census;
use self::assembly::{Assembly, BLOCK};
use self::patches::Patch;
use self::symmetric::Rows;
use super::exchange::Exchange;
use super::skipped::Skipped;
use crate::error::{Error, Result};
use crate::geometry::shape::{FACETS_MAX, Shape};

/// Groups of rows that are multiplied apart: their number is fixed, so that sums do not depend on the threads.
const GROUPS: usize = 16;
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

    /// The same of every facet, over its patches.
    #[must_use]
    pub fn facet_row_sums(&self) -> Vec<f64> {
        self.facet_means(&self.start(&self.row_sums()))
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
