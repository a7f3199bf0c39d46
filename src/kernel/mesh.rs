//! How finely the bounces are solved, which is not how finely colour is measured.

use std::fmt;

use super::refinement::{Refined, refine};
use crate::error::Result;
use crate::geometry::{FacetGrid, Fold};
use crate::response::Response;

/// Relative error of facet means that is below what a camera sees.
pub const TOLERANCE: f64 = 1e-5;

/// The mesh on which the bounces of light are solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mesh {
    /// As fine as the tolerance asks for, where the scene needs it: facet means of the continuous solution.
    Auto,
    /// One flat patch per facet, as in the paper.
    Facets,
    /// Flat patches finer than the facets, then averaged.
    Patches(FacetGrid),
    /// The same on a shape: cells along each side of a facet.
    Cells(usize),
}

impl fmt::Display for Mesh {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Facets => f.write_str("facets"),
            Self::Patches(grid) => write!(f, "{}x{}", grid.rows, grid.cols),
            Self::Cells(cells) => write!(f, "{cells}"),
        }
    }
}

/// What the solution of a scene's bounces is worth.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// Unknowns of a panel in the last solution.
    pub unknowns: usize,
    /// Estimated largest relative error of a facet's mean radiance for any reflectance in [0, 1]; none where
    /// the mesh was given and no second solution made.
    pub facet_mean_error: Option<f64>,
    /// Residual that Lanczos' method left in the equations of the bounces, relative to the light.
    pub residual: f64,
    /// The form factors between flat patches; none where the panels were not divided.
    pub kernel: Option<KernelSource>,
}

/// What form factors were sampled by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Samples {
    /// As `vkernel --sampling` names it.
    pub sampling: &'static str,
    /// Pairs of points a distinct entry, or rays a row of facets.
    pub count: u32,
    /// Seed of the generator.
    pub seed: u64,
}

/// Where form factors come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KernelSource {
    /// By which method, as `vkernel --method` names it.
    pub method: &'static str,
    /// The samples, if it takes some.
    pub samples: Option<Samples>,
    /// Largest standard error of one, if they are estimates.
    pub entry_sd: Option<f64>,
    /// How many were found: those that differ.
    pub entries: usize,
}

/// Solves the bounces on `fold` under even light, for every reflectance, on undivided panels, to `tolerance`.
///
/// The error stays above the tolerance, and says so, where reaching it would take too long.
///
/// # Errors
/// A fold so narrow that no solution fits.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold};
/// use vfold::kernel::mesh::respond;
/// let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
/// let (response, accuracy) = respond(&fold, 1e-3)?;
/// assert_eq!(response.facets(), 100);
/// assert!(accuracy.facet_mean_error.unwrap() <= 1e-3);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn respond(fold: &Fold, tolerance: f64) -> Result<(Response, Accuracy)> {
    if fold.is_flat() {
        let unknowns = fold.facets().len();
        let accuracy = Accuracy { unknowns, facet_mean_error: None, residual: 0.0, kernel: None };
        return Ok((Response::without_bounces(unknowns), accuracy));
    }
    let Refined { response, unknowns, error, residual } = refine(fold, tolerance)?;
    Ok((response, Accuracy { unknowns, facet_mean_error: Some(error), residual, kernel: None }))
}
