//! `--facet-reflectance` on a fold, a mesh, or an external kernel.

use nalgebra::DMatrix;
use vfold::Result;
use vfold::camera::CameraResponse;
use vfold::forward::Lighting;
use vfold::paper::{FoldKernel, form_factors, nonuniform};
use vfold::scene::{ExternalKernel, Setting};
use vfold::surfaces::kernel::SurfaceKernel;

/// Direct light per patch for every source, and the camera's response to it.
type Lights = Vec<(Vec<f64>, CameraResponse)>;

/// A surface with an individual reflectance for each facet.
pub enum Nonuniform<'a> {
    Fold(FoldKernel, Lighting),
    Mesh(SurfaceKernel, Lights),
    Kernel(&'a ExternalKernel, Lights),
}

impl<'a> Nonuniform<'a> {
    /// The surface of the scene, possibly with an external kernel.
    pub fn of(setting: &Setting, external: Option<&'a ExternalKernel>) -> Result<Self> {
        let surface = match setting {
            Setting::Fold(fold) => return Ok(Self::Fold(form_factors(&fold.fold), fold.lighting()?)),
            Setting::Surface(surface) => surface,
        };
        let cameras = surface.source_responses()?.into_iter();
        if let Some(external) = external {
            return Ok(Self::Kernel(external, external.sources.iter().cloned().zip(cameras).collect()));
        }
        let lit = surface.lit()?;
        let lights = lit.lights.into_iter().map(|light| light.irradiance);
        Ok(Self::Mesh(lit.kernel, lights.zip(cameras).collect()))
    }

    /// RGB of every facet at exposure 1, facet by channel.
    pub fn facet_rgb(&self, reflectance: &DMatrix<f64>) -> Result<DMatrix<f64>> {
        match self {
            Self::Fold(kernel, lighting) => nonuniform::facet_rgb(kernel, lighting, reflectance),
            Self::Mesh(kernel, lights) => nonuniform::surface_rgb(kernel, lights, reflectance),
            Self::Kernel(external, lights) => {
                nonuniform::surface_rgb(&external.exchange, lights, reflectance)
            }
        }
    }
}
