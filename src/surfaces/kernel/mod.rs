//! The exchange of light between the facets of any surface, or between patches that divide them.
//!
//! An unobstructed pair ([`casters`]) is computed by a formula ([`contour`], or [`far`] where it is accurate
//! to eight digits); any other loses what its casters hide ([`partial`], by exact shadows, [`shadow`]).
//! Coplanar pairs and pairs that face away from each other exchange nothing. One number represents both
//! directions, so that reciprocity holds by construction.

pub mod arealight;
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
mod site;
pub mod skylight;
pub mod sunlight;
pub mod symmetric;
pub mod wedges;

use rayon::prelude::*;

use super::Exchange;
use super::kernel::assembly::Assembly;
pub use super::kernel::assembly::Census;
use super::kernel::patches::Patch;
use super::kernel::symmetric::Rows;
use super::shape::{FACETS_MAX, Shape};
use crate::error::{Error, Result};
use crate::kernel::skipped::Skipped;

/// Groups of rows multiplied separately: their number is fixed, so that sums do not depend on the number of
/// threads.
const GROUPS: usize = 16;
/// Largest fraction of its light that a patch may pass on; the excess over 1 is rounding and the tolerance of
/// partial shadows.
const ALL: f64 = 1.001;

/// Form factors between the patches of a surface.
#[derive(Clone, Debug)]
pub struct SurfaceKernel {
    root_areas: Vec<f64>,
    facet_of: Vec<usize>,
    /// `√A_i·K_ij/√A_j` right of the diagonal, in strips of rows.
    strips: Vec<Rows>,
    census: Census,
}

impl SurfaceKernel {
    /// Form factors between `patches` of `shape`, all of them, in the order of its facets.
    ///
    /// # Arguments
    /// - `tolerance`: error of a partly hidden pair's form factor, relative to the unhidden one. All others
    ///   are accurate to single precision.
    ///
    /// # Errors
    /// [`Error::FullExchange`] if their exchange exceeds a gigabyte; [`Error::Shape`] if the patches are more
    /// than [`FACETS_MAX`], or pass on more light than they have because facets cross.
    ///
    /// # Source
    /// Deeb et al., eq. (10), averaged over both patches.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{FacetGrid, Fold};
    /// use vfold::surfaces::Accordion;
    /// use vfold::surfaces::kernel::SurfaceKernel;
    /// use vfold::surfaces::kernel::patches::{Division, patches};
    /// let valley = Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?;
    /// let v = Accordion { valley, creases: 1, ridge_deg: 90.0, bow_deg: 0.0 }.shape()?;
    /// let kernel = SurfaceKernel::new(&v, &patches(&v, Division::NONE), 1e-3)?;
    /// // Two squares at a right angle exchange 0.20004 of their light (Howell, configuration C-14).
    /// assert!((kernel.row_sums()[0] - 0.20004377607540316).abs() < 1e-7);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(shape: &Shape, patches: &[Patch], tolerance: f64) -> Result<Self> {
        if patches.len() > FACETS_MAX {
            let problem = format!("{} patches", patches.len());
            return Err(Error::shape(problem, format!("use a coarser mesh, of at most {FACETS_MAX}")));
        }
        let assembly = Assembly::new(shape, patches, tolerance);
        let kernel = Self {
            root_areas: patches.iter().map(|patch| patch.polygon.area().sqrt()).collect(),
            facet_of: patches.iter().map(|patch| patch.facet).collect(),
            strips: assembly.strips()?,
            census: assembly.census(),
        };
        kernel.check()
    }

    fn check(self) -> Result<Self> {
        let largest = self.row_sums().into_iter().fold(0.0, f64::max);
        if largest > ALL {
            let problem = format!("a facet passes on {largest:.4} times its light");
            return Err(Error::shape(
                problem,
                "divide facets that cross or overlap along the lines where they do",
            ));
        }
        Ok(self)
    }

    /// Treatment of the pairs of patches.
    #[must_use]
    pub fn census(&self) -> Census {
        self.census
    }

    /// Number of stored numbers: one per pair that sees each other.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.strips.iter().map(Rows::len).sum()
    }

    /// Fraction of its light that each patch sends to others.
    #[must_use]
    pub fn row_sums(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.unknowns()];
        self.apply(&self.root_areas, &mut sums);
        sums.iter().zip(&self.root_areas).map(|(sum, root)| sum / root).collect()
    }

    /// The same for every facet, over its patches.
    #[must_use]
    pub fn facet_row_sums(&self) -> Vec<f64> {
        self.facet_means(&self.start(&self.row_sums()))
    }

    /// One row of the matrix K of eq. (10) between the patches: the fractions of the light leaving patch
    /// `row` that reach each of them.
    #[must_use]
    pub fn matrix_row(&self, row: usize) -> Vec<f64> {
        let mut shares = vec![0.0; self.unknowns()];
        self.strips.iter().for_each(|strip| strip.add_row(row, &mut shares));
        let own = self.root_areas[row];
        shares.iter_mut().zip(&self.root_areas).for_each(|(share, root)| *share *= root / own);
        shares
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
        let group = |strips: &[Rows]| {
            let mut out = vec![0.0; x.len()];
            strips.iter().for_each(|strip| strip.add_product(x, &mut out));
            out
        };
        let size = self.strips.len().div_ceil(GROUPS).max(1);
        let parts: Vec<Vec<f64>> = self.strips.par_chunks(size).map(group).collect();
        out.fill(0.0);
        for part in parts {
            out.iter_mut().zip(part).for_each(|(out, part)| *out += part);
        }
    }
}

impl Census {
    /// The work that was skipped.
    #[must_use]
    pub fn skipped(&self) -> Vec<Skipped> {
        let skip = |what, count, why| Skipped { what, count, why };
        let mut list = vec![
            skip(
                "form factors of averted pairs",
                self.averted,
                "they lie in one plane or do not face each other",
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
