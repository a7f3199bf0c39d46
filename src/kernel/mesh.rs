//! Resolution at which interreflections are solved, as opposed to that at which colour is measured.

use std::fmt;

use super::refinement::{Refined, refine};
use crate::error::Result;
use crate::geometry::{FacetGrid, Fold};
use crate::response::Response;

/// Relative error of facet means too small for a camera to see.
pub const TOLERANCE: f64 = 1e-5;

/// The mesh on which interreflections are solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mesh {
    /// As fine as the tolerance demands, where the scene needs it: facet means of the continuous solution.
    Auto,
    /// One flat patch per facet, as in the paper.
    Facets,
    /// Flat patches finer than the facets, over which they are averaged.
    Patches(FacetGrid),
    /// The same for other shapes: number of cells along each side of a facet.
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

/// Accuracy of the solution of a scene's interreflections.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// Unknowns per panel in the last solution.
    pub unknowns: usize,
    /// Estimated largest relative error of a facet's mean radiance for any reflectance in [0, 1]; `None` if
    /// the mesh was given, so that there is no second solution.
    pub facet_mean_error: Option<f64>,
    /// Residual of Lanczos' method, relative to the light.
    pub residual: f64,
    /// The form factors between flat patches; `None` if the panels were not divided.
    pub kernel: Option<KernelSource>,
}

/// How form factors were sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Samples {
    /// Name of the sampling, as in `vkernel --sampling`.
    pub sampling: &'static str,
    /// Point pairs per distinct entry, or rays per row of facets.
    pub count: u32,
    /// Seed of the random generator.
    pub seed: u64,
}

/// Origin of the form factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KernelSource {
    /// Name of the method, as in `vkernel --method`.
    pub method: &'static str,
    /// The samples, if the method uses any.
    pub samples: Option<Samples>,
    /// Largest standard error of an entry, if entries are estimates.
    pub entry_sd: Option<f64>,
    /// Number of distinct entries computed.
    pub entries: usize,
}

/// Solves interreflections of uniform light on undivided panels of `fold`, for every reflectance, to
/// `tolerance`.
///
/// Where reaching the tolerance would take too long, the error remains above it and is reported as such.
///
/// # Errors
/// [`Error::Usage`](crate::Error::Usage) for a fold so narrow that no solution fits.
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
