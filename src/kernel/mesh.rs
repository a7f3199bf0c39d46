//! How finely the bounces are solved, which is not how finely colour is measured.

use std::fmt;

use crate::error::{Error, Result};
use crate::geometry::{FacetGrid, Fold};
use crate::kernel::check::spectral_radius;
use crate::kernel::facets::FacetOperator;
use crate::kernel::fold_kernel::FoldKernel;
use crate::kernel::method::Method;
use crate::kernel::refinement::{Refined, refine};
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
    /// Estimated largest relative error of a facet's mean radiance for any reflectance in [0, 1]; none where the mesh was
    /// given and no second solution made.
    pub facet_mean_error: Option<f64>,
    /// Residual that Lanczos' method left in the equations of the bounces, relative to the light.
    pub residual: f64,
    /// The form factors between flat patches; none where the panels were not divided.
    pub kernel: Option<KernelSource>,
}

/// Where form factors come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KernelSource {
    /// How they were found.
    pub method: Method,
    /// Largest standard error of one, if they are estimates.
    pub entry_sd: Option<f64>,
    /// How many were found: those that differ.
    pub entries: usize,
}

/// Solves the bounces on `fold` under even light, for every reflectance, on `mesh`, to `tolerance`.
///
/// The error stays above the tolerance, and says so, where reaching it would take too long.
///
/// # Errors
/// A mesh that does not divide into the facets, or a fold so narrow that no solution fits.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold};
/// use vfold::kernel::mesh::{Mesh, respond};
/// let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
/// let (response, accuracy) = respond(&fold, Mesh::Auto, 1e-3)?;
/// assert_eq!(response.facets(), 100);
/// assert!(accuracy.facet_mean_error.unwrap() <= 1e-3);
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn respond(fold: &Fold, mesh: Mesh, tolerance: f64) -> Result<(Response, Accuracy)> {
    respond_by(Method::Exact, fold, mesh, tolerance)
}

/// The same with form factors found by `method`.
///
/// # Errors
/// As [`respond`]; a method other than exact on undivided panels, or one whose kernel makes the bounces diverge.
pub fn respond_by(method: Method, fold: &Fold, mesh: Mesh, tolerance: f64) -> Result<(Response, Accuracy)> {
    match mesh {
        Mesh::Auto if method != Method::Exact => Err(Error::usage(
            "--mesh",
            format!("auto divides the panels into no facets whose form factors could be {method}"),
            "give --mesh facets, patches such as 40x40, or --method exact",
        )),
        Mesh::Auto if fold.is_flat() => respond_patches(method, fold, fold.facets(), tolerance),
        Mesh::Auto => {
            let Refined { response, unknowns, error, residual } = refine(fold, tolerance)?;
            Ok((response, Accuracy { unknowns, facet_mean_error: Some(error), residual, kernel: None }))
        }
        Mesh::Facets => respond_patches(method, fold, fold.facets(), tolerance),
        Mesh::Patches(patches) => respond_patches(method, fold, patches, tolerance),
        Mesh::Cells(cells) => Err(Error::usage(
            "--mesh",
            format!("{cells} cells are for facets of a shape"),
            "give patches such as 40x40, facets, or auto",
        )),
    }
}

fn respond_patches(
    method: Method,
    fold: &Fold,
    patches: FacetGrid,
    tolerance: f64,
) -> Result<(Response, Accuracy)> {
    let facets = fold.facets();
    if !(patches.rows.is_multiple_of(facets.rows) && patches.cols.is_multiple_of(facets.cols)) {
        return Err(Error::usage(
            "--mesh",
            format!(
                "{}x{} patches do not divide into {}x{} facets",
                patches.rows, patches.cols, facets.rows, facets.cols
            ),
            "give multiples of the facets, or auto",
        ));
    }
    let divided = fold.with_facets(patches)?;
    FoldKernel::check_room(&divided)?;
    let (kernel, entry_sd) = method.form_factors(&divided);
    let operator = FacetOperator::new(&kernel, facets);
    if method != Method::Exact {
        check_convergence(method, &operator)?;
    }
    let (response, residual) = Response::solve(&operator, 0.1 * tolerance)?;
    let kernel = Some(KernelSource { method, entry_sd, entries: kernel.entries() });
    Ok((response, Accuracy { unknowns: patches.len(), facet_mean_error: None, residual, kernel }))
}

/// Refuses a kernel with which white sheets would shine.
fn check_convergence(method: Method, operator: &FacetOperator) -> Result<()> {
    let radius = spectral_radius(operator);
    if radius < 1.0 {
        return Ok(());
    }
    Err(Error::usage(
        "--method",
        format!(
            "the {method} kernel has spectral radius {radius:.2}: bounces diverge at reflectances from {:.2}",
            1.0 / radius
        ),
        "give --method exact, or --save kernel=FILE.npy --check to study it",
    ))
}
