//! The bounces between facets, or between patches that divide them.

use super::check::spectral_radius;
use super::{FacetOperator, FoldKernel, Method};
use crate::error::{Error, Result};
use crate::geometry::{FacetGrid, Fold};
use crate::kernel::mesh::{self, Accuracy, Mesh};
use crate::response::Response;

/// Solves the bounces on `fold` in uniform light, for every reflectance, on `mesh`, to `tolerance`, with form
/// factors by `method`.
///
/// # Errors
/// As [`mesh::respond`]; a mesh that does not divide the facets, a method other than exact on undivided
/// panels, or one whose kernel makes the bounces diverge.
pub fn respond(method: Method, fold: &Fold, mesh: Mesh, tolerance: f64) -> Result<(Response, Accuracy)> {
    match mesh {
        Mesh::Auto if method != Method::Exact => Err(Error::usage(
            "--mesh",
            format!("'auto' has no facet form factors for --method {method}"),
            "give --mesh facets, patches such as 40x40, or --method exact",
        )),
        Mesh::Auto if fold.is_flat() => respond_patches(method, fold, fold.facets(), tolerance),
        Mesh::Auto => mesh::respond(fold, tolerance),
        Mesh::Facets => respond_patches(method, fold, fold.facets(), tolerance),
        Mesh::Patches(patches) => respond_patches(method, fold, patches, tolerance),
        Mesh::Cells(cells) => Err(Error::usage(
            "--mesh",
            format!("a number of cells applies only to shapes, and {cells} was given"),
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
    let kernel = Some(method.source(entry_sd, &kernel));
    Ok((response, Accuracy { unknowns: patches.len(), facet_mean_error: None, residual, kernel }))
}

/// Refuses a kernel with which bounces on white sheets would grow.
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
