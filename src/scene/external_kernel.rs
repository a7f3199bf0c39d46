//! A kernel made by other software, read from NPY files.

use std::path::Path;

use crate::error::{Error, Result};
use crate::geometry::LightSource;
use crate::kernel::mesh::Accuracy;
use crate::stream::{Scene, Surface, read_rows, read_square};
use crate::surfaces::{DenseExchange, SurfaceResponse};

/// Relative residual of the interreflections.
const TOLERANCE: f64 = 1e-9;

/// A kernel with its light.
pub struct ExternalKernel {
    name: String,
    /// The exchange between the facets, with one patch each.
    pub exchange: DenseExchange,
    /// Direct light of every source, one number per facet.
    pub sources: Vec<Vec<f64>>,
}

impl ExternalKernel {
    /// Reads K, eq. (10), from the file `kernel`: row i, column j is the share of the light of facet i that
    /// reaches facet j. The file `irradiance` holds direct light, one number per facet or one row per source
    /// (default 1 everywhere), and `areas` the areas of the facets (default: from reciprocity).
    ///
    /// # Errors
    /// [`Error::File`] or [`Error::Array`] for unreadable or invalid files.
    pub fn read(kernel: &Path, irradiance: Option<&Path>, areas: Option<&Path>) -> Result<Self> {
        let matrix = read_square(kernel)?;
        let facets = matrix.nrows();
        let areas = areas.map(|path| read_areas(path, facets)).transpose()?;
        let exchange = DenseExchange::from_kernel(&matrix, areas.as_deref()).map_err(|e| array(kernel, e))?;
        let sources = match irradiance {
            Some(path) => read_sources(path, facets)?,
            None => vec![vec![1.0; facets]],
        };
        let name = kernel.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self { name, exchange, sources })
    }

    /// Its scene with interreflections solved.
    ///
    /// # Errors
    /// As [`SurfaceResponse::solve`].
    pub fn scene(&self) -> Result<Scene> {
        let solve = |source: &Vec<f64>| SurfaceResponse::solve(&self.exchange, source, TOLERANCE);
        let solved: Vec<_> = self.sources.iter().map(solve).collect::<Result<_>>()?;
        let (responses, residuals): (Vec<_>, Vec<_>) = solved.into_iter().unzip();
        let lights = vec![LightSource::PerFacet; self.sources.len()];
        let facets = self.sources[0].len();
        let mut scene = Scene::of_surface(&self.name, &Surface::Kernel { facets }, &lights, &responses)?;
        let residual = residuals.into_iter().fold(0.0, f64::max);
        let accuracy = Accuracy { unknowns: facets, facet_mean_error: None, residual, kernel: None };
        scene.set_accuracy("facets", TOLERANCE, &accuracy)?;
        Ok(scene)
    }
}

fn read_areas(path: &Path, facets: usize) -> Result<Vec<f64>> {
    let rows = read_rows(path, facets)?;
    match rows.nrows() {
        1 => Ok(rows.into_iter().collect()),
        several => Err(array(path, format!("{several} rows; give one area per facet"))),
    }
}

/// Direct light, source by source.
fn read_sources(path: &Path, facets: usize) -> Result<Vec<Vec<f64>>> {
    let rows = read_rows(path, facets)?;
    if let Some(value) = rows.iter().find(|value| !(0.0..1e30).contains(*value)) {
        return Err(array(path, format!("{value} is not an irradiance; give numbers from 0")));
    }
    let sources: Vec<Vec<f64>> = rows.outer_iter().map(|row| row.to_vec()).collect();
    match sources.iter().position(|source| !source.iter().any(|value| *value > 0.0)) {
        Some(dark) => Err(array(path, format!("row {dark} has no light; leave it out"))),
        None => Ok(sources),
    }
}

fn array(path: &Path, problem: impl std::fmt::Display) -> Error {
    Error::Array { path: path.display().to_string(), problem: problem.to_string() }
}
