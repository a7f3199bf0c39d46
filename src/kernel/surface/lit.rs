//! A surface in its light: what bounces start from, and what they go through.

use rayon::prelude::*;

use super::SurfaceKernel;
use super::direct::DirectLight;
use super::patches::{Division, patches};
use crate::error::Result;
use crate::geometry::LightSource;
use crate::geometry::shape::Shape;
use crate::response::{ReducedExchange, SurfaceResponse};

/// Error of partly hidden form factors, relative to the unhidden ones.
const HIDDEN_TOLERANCE: f64 = 1e-3;

/// The exchange between the patches of a surface, and the direct light of every source on them.
pub struct LitSurface {
    /// The exchange.
    pub kernel: SurfaceKernel,
    /// A light a source.
    pub lights: Vec<DirectLight>,
}

impl LitSurface {
    /// A surface, divided, under these sources.
    ///
    /// # Errors
    /// As [`SurfaceKernel::new`].
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{FacetGrid, Fold, LightSource, accordion::Accordion};
    /// use vfold::kernel::surface::{lit::LitSurface, patches::Division};
    /// let valley = Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?;
    /// let v = Accordion { valley, creases: 1, ridge_deg: 90.0, bow_deg: 0.0 }.shape()?;
    /// let sun = LightSource::directional([0.0, 0.0, 1.0], 1.0)?;
    /// let (responses, _) = LitSurface::new(&v, &[sun], Division::NONE)?.respond(1e-9)?;
    /// // Each panel gets cos 45° from the sun, and a fifth of what the other sends.
    /// assert!((responses[0].irradiance(0, 1.0) - 0.5_f64.sqrt() / (1.0 - 0.20004377607540316)).abs() < 1e-6);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(shape: &Shape, sources: &[LightSource], division: Division) -> Result<Self> {
        let kernel = SurfaceKernel::new(shape, division, HIDDEN_TOLERANCE)?;
        let patches = patches(shape, division);
        let lights = sources.iter().map(|source| DirectLight::of(source, shape, &patches, &kernel)).collect();
        Ok(Self { kernel, lights })
    }

    /// The response to every source, and the largest residual.
    ///
    /// # Errors
    /// As [`SurfaceResponse::solve`].
    pub fn respond(&self, tolerance: f64) -> Result<(Vec<SurfaceResponse>, f64)> {
        let solve = |light: &DirectLight| SurfaceResponse::solve(&self.kernel, &light.irradiance, tolerance);
        let solved: Vec<_> = self.lights.par_iter().map(solve).collect::<Result<_>>()?;
        let residual = solved.iter().map(|(_, residual)| *residual).fold(0.0, f64::max);
        Ok((solved.into_iter().map(|(response, _)| response).collect(), residual))
    }

    /// The exchange between functions on parts of several reflectances.
    ///
    /// # Errors
    /// As [`ReducedExchange::new`].
    pub fn reduce(&self, part_of_facet: &[usize], tolerance: f64) -> Result<ReducedExchange> {
        let lights: Vec<_> = self.lights.iter().map(|light| light.irradiance.clone()).collect();
        ReducedExchange::new(&self.kernel, part_of_facet, &lights, tolerance)
    }
}
