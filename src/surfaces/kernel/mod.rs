//! The exchange of light between the facets of any surface, or between patches that divide them.
//!
//! An unobstructed pair ([`casters`]) is computed by a formula ([`contour`], or `far` where it is accurate
//! to ten digits); any other loses what its casters hide ([`partial`], by exact shadows, [`shadow`]).
//! Coplanar pairs and pairs that face away from each other exchange nothing. One number represents both
//! directions, so that reciprocity holds by construction. In large meshes distant clusters that see each
//! other exchange light without a number for every pair (`far_field`, `hierarchy`).

pub mod arealight;
mod assembly;
mod block;
pub mod casters;
mod cluster;
pub mod contour;
mod cuboid;
pub mod direct;
mod far;
mod far_field;
mod grid;
mod hierarchy;
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
use super::kernel::block::Block;
use super::kernel::casters::TOUCHING;
use super::kernel::cluster::Tree;
use super::kernel::far_field::FarField;
use super::kernel::hierarchy::Hierarchy;
use super::kernel::patches::Patch;
use super::kernel::site::Site;
use super::shape::{FACETS_MAX, Shape};
use crate::error::{Error, Result};
use crate::kernel::skipped::Skipped;

/// Groups of rows multiplied separately: their number is fixed, so that sums do not depend on the number of
/// threads.
const GROUPS: usize = 16;
/// Meshes with at least this many patches exchange light by clusters; below, all pairs take a few seconds and
/// are accurate to single precision.
const CLUSTERED: usize = 3000;
/// Error of the exchange of clusters and of the rules for distant pairs, relative to the tolerance, and its
/// lower limit, given entries in single precision.
const AFAR: f64 = 0.01;
const ROUNDING: f64 = 1e-7;
/// Largest fraction of its light that a patch may pass on; the excess over 1 is rounding and the tolerance of
/// partial shadows.
const ALL: f64 = 1.001;

/// Form factors between the patches of a surface.
#[derive(Clone, Debug)]
pub struct SurfaceKernel {
    root_areas: Vec<f64>,
    facet_of: Vec<usize>,
    /// The patch at every position: row and column of the blocks.
    order: Vec<usize>,
    /// `√A_i·K_ij/√A_j` of pairs.
    blocks: Vec<Block>,
    /// The same for distant clusters that see each other.
    far_field: FarField,
    census: Census,
}

impl SurfaceKernel {
    /// Form factors between `patches` of `shape`, all of them, in the order of its facets.
    ///
    /// # Arguments
    /// - `tolerance`: error of a partly hidden pair's form factor, relative to the unhidden one. From 3000
    ///   patches on, unobstructed pairs have an error, too: row sums are off by less than a hundredth of it.
    ///
    /// # Errors
    /// [`Error::FullExchange`] if their exchange exceeds a gigabyte; [`Error::Shape`] if the patches are too
    /// many, or pass on more light than they have because facets cross.
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
            return Err(Error::shape(problem, format!("use a mesh of at most {FACETS_MAX}")));
        }
        if patches.len() < CLUSTERED {
            return Self::by_pairs(shape, patches, tolerance);
        }
        Self::by_clusters(shape, patches, tolerance)
    }

    /// The same pair by pair, for any number of patches.
    ///
    /// # Errors
    /// [`Error::Shape`] if patches pass on more light than they have.
    pub fn by_pairs(shape: &Shape, patches: &[Patch], tolerance: f64) -> Result<Self> {
        let sites = patches.iter().map(Site::new).collect();
        let assembly = Assembly::new(shape, sites, [tolerance, far::TOLERANCE]);
        let blocks = assembly.strips();
        Self::of(patches, (0..patches.len()).collect(), blocks, FarField::default(), &assembly).check()
    }

    /// The same with clusters that exchange light through the far field, for any number of patches.
    ///
    /// # Errors
    /// [`Error::FullExchange`] if that exceeds a gigabyte; as [`SurfaceKernel::by_pairs`].
    pub fn by_clusters(shape: &Shape, patches: &[Patch], tolerance: f64) -> Result<Self> {
        let truncation = (AFAR * tolerance).max(ROUNDING);
        let sites: Vec<Site> = patches.iter().map(Site::new).collect();
        let tree = Tree::new(&sites, TOUCHING * shape.size());
        let sites = tree.order.iter().map(|n| Site::new(&patches[*n])).collect();
        let assembly = Assembly::new(shape, sites, [tolerance, truncation]);
        let (blocks, pairs) = Hierarchy { assembly: &assembly, tree: &tree, truncation }.parts();
        if assembly.is_full() {
            return Err(Error::FullExchange { name: "shape".to_owned(), patches: patches.len() });
        }
        let far_field = FarField::new(&tree, &assembly.sites, &pairs, truncation);
        Self::of(patches, tree.order, blocks, far_field, &assembly).check()
    }

    fn of(
        patches: &[Patch],
        order: Vec<usize>,
        blocks: Vec<Block>,
        far_field: FarField,
        assembly: &Assembly,
    ) -> Self {
        Self {
            root_areas: patches.iter().map(|patch| patch.polygon.area().sqrt()).collect(),
            facet_of: patches.iter().map(|patch| patch.facet).collect(),
            order,
            blocks,
            far_field,
            census: assembly.census(),
        }
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

    /// Number of stored numbers: one per visible pair, fewer for distant clusters.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.blocks.iter().map(|block| block.entries.len()).sum::<usize>() + self.far_field.len()
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
        let (mut unit, mut exchange) = (vec![0.0; self.unknowns()], vec![0.0; self.unknowns()]);
        for place in (0..unit.len()).filter(|place| self.order[*place] == row) {
            unit[place] = 1.0;
            self.blocks.iter().for_each(|block| block.add_row(place, &mut exchange));
        }
        self.far_field.add_product(&unit, &mut exchange);
        let mut shares = vec![0.0; self.unknowns()];
        for (patch, exchange) in self.order.iter().zip(exchange) {
            shares[*patch] = exchange * self.root_areas[*patch] / self.root_areas[row];
        }
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
        let x: Vec<f64> = self.order.iter().map(|patch| x[*patch]).collect();
        let group = |blocks: &[Block]| {
            let mut out = vec![0.0; x.len()];
            blocks.iter().for_each(|block| block.entries.add_product(&x, &mut out));
            out
        };
        let size = self.blocks.len().div_ceil(GROUPS).max(1);
        let mut parts: Vec<Vec<f64>> = self.blocks.par_chunks(size).map(group).collect();
        let mut afar = vec![0.0; x.len()];
        self.far_field.add_product(&x, &mut afar);
        parts.push(afar);
        out.fill(0.0);
        for part in parts {
            self.order.iter().zip(part).for_each(|(patch, part)| out[*patch] += part);
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
