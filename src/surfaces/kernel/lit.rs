//! A surface in its light: the initial light and the exchange of the bounces.

use super::SurfaceKernel;
use super::direct::DirectLight;
use super::patches::Patch;
use super::refinement::patches_again;
use crate::error::{Error, Result};
use crate::geometry::LightSource;
use crate::surfaces::ReducedExchange;
use crate::surfaces::shape::Shape;

/// Error of partly hidden form factors, relative to the tolerance.
const HIDDEN: f64 = 0.1;

/// The exchange between the patches of a surface, and the direct light of every source on them.
pub struct LitSurface {
    /// The exchange.
    pub kernel: SurfaceKernel,
    /// One light per source.
    pub lights: Vec<DirectLight>,
}

impl LitSurface {
    /// A surface under these sources, with the division on which [`solve`](super::refinement::solve) ended,
    /// identified by its number of `unknowns`.
    ///
    /// # Errors
    /// [`Error::Field`] if no division has that many; as [`SurfaceKernel::new`].
    pub fn again(shape: &Shape, sources: &[LightSource], unknowns: usize, tolerance: f64) -> Result<Self> {
        let patches = patches_again(shape, sources, unknowns).ok_or_else(|| {
            let problem =
                format!("no mesh of this surface has {unknowns}; make the scene again with vkernel");
            Error::field("accuracy.unknowns", problem)
        })?;
        Self::new(shape, sources, &patches, tolerance)
    }

    /// A surface divided into `patches` under these sources.
    ///
    /// # Errors
    /// As [`SurfaceKernel::new`].
    pub fn new(shape: &Shape, sources: &[LightSource], patches: &[Patch], tolerance: f64) -> Result<Self> {
        let kernel = SurfaceKernel::new(shape, patches, HIDDEN * tolerance)?;
        let lights = sources.iter().map(|source| DirectLight::of(source, shape, patches, &kernel)).collect();
        Ok(Self { kernel, lights })
    }

    /// The exchange between functions on parts with several reflectances.
    ///
    /// # Errors
    /// As [`ReducedExchange::new`].
    pub fn reduce(&self, part_of_facet: &[usize], tolerance: f64) -> Result<ReducedExchange> {
        let lights: Vec<_> = self.lights.iter().map(|light| light.irradiance.clone()).collect();
        ReducedExchange::new(&self.kernel, part_of_facet, &lights, 0.1 * tolerance)
    }
}
