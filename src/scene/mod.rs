//! The meaning of scene records: a surface in its light before a camera, and models of it.
//!
//! [`stream`](crate::stream) reads and writes the records; here they become responses, lights and models.
//! Only [`Setting::of`] decides whether a scene is a fold, which has its own formulas, or another surface.

mod camera;
mod drawn;
mod expected;
mod external_kernel;
mod fit;
mod fold;
mod folded_sheet;
mod marked;
mod metered;
mod photograph;
mod residuals;
mod sample;
mod stated_light;
mod surface;
mod unmodelled;

use std::collections::BTreeMap;

pub use drawn::sheet;
pub use expected::ExpectedError;
pub use external_kernel::ExternalKernel;
pub use fold::FoldSetting;
pub use folded_sheet::FoldedSheet;
pub use marked::{MarkedPanels, stated_fold};
pub use photograph::{PhotographedFold, Picture};
pub use residuals::residuals;
pub use sample::{other_cameras, other_lights, photographed, stated};
pub use stated_light::StatedSky;
pub use surface::SurfaceSetting;

use crate::camera::CameraResponse;
use crate::error::Result;
use crate::forward::{FacetModel, OpenLight};
use crate::geometry::Panel;
use crate::stream::Scene;

/// A surface in its light before a camera.
pub enum Setting<'a> {
    /// Two panels that meet at a crease, under the sun and a uniform sky.
    Fold(Box<FoldSetting>),
    /// Any other surface, or a fold under other sources.
    Surface(SurfaceSetting<'a>),
}

impl<'a> Setting<'a> {
    /// From a scene's record.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a part of it is missing or impossible.
    pub fn of(scene: &'a Scene) -> Result<Self> {
        Ok(match scene.fold_if_one()?.filter(|_| !scene.has_sources()) {
            Some(fold) => Self::Fold(Box::new(FoldSetting::with_fold(scene, fold)?)),
            None => Self::Surface(SurfaceSetting { scene }),
        })
    }

    /// Number of facets.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if the scene does not give it.
    pub fn facets(&self) -> Result<usize> {
        match self {
            Self::Fold(fold) => Ok(2 * fold.fold.facets().len()),
            Self::Surface(surface) => surface.scene.facet_count(),
        }
    }

    /// The panels by number, in which photographs are measured.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if the surface has no shape in space.
    pub fn panels(&self) -> Result<BTreeMap<usize, Panel>> {
        match self {
            Self::Fold(fold) => Ok(fold.fold.panels().into_iter().enumerate().collect()),
            Self::Surface(surface) => Ok(surface.scene.shape()?.panels()),
        }
    }

    /// The model of facet RGB, for one sheet or for a sheet together with known parts.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if a part of the scene is missing or does not fit the others.
    pub fn model(&self) -> Result<FacetModel> {
        match self {
            Self::Fold(fold) => fold.model(),
            Self::Surface(surface) => surface.model(),
        }
    }

    /// The same as seen by one `eye` in all lights.
    ///
    /// # Errors
    /// As [`Setting::model`].
    pub fn model_seen_by(&self, eye: &CameraResponse) -> Result<FacetModel> {
        match self {
            Self::Fold(fold) => Ok(fold.model_seen_by(eye)),
            Self::Surface(surface) => surface.model_seen_by(eye),
        }
    }

    /// The light received by a chart next to the surface.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if camera or illuminants are missing or not on the scene's wavelengths.
    pub fn open_light(&self) -> Result<OpenLight> {
        match self {
            Self::Fold(fold) => Ok((&fold.lighting()?).into()),
            Self::Surface(surface) => surface.open_light(),
        }
    }

    /// Arranges values in the order of the model's sources: `lamps` in their own order, where the sun counts
    /// as a lamp, and `sky` for every sky.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if the sources are missing.
    pub fn of_sources<T: Clone>(&self, lamps: &[T], sky: &T) -> Result<Vec<T>> {
        match self {
            Self::Fold(fold) => {
                let sun = lamps.first().filter(|_| fold.light.sun() > 0.0);
                Ok(sun.into_iter().chain((fold.light.sky() > 0.0).then_some(sky)).cloned().collect())
            }
            Self::Surface(surface) => surface.of_sources(lamps, sky),
        }
    }

    /// Number of pictures taken of a sample: one under each illuminant, or one under all.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if illuminants or sources are missing.
    pub fn pictures(&self) -> Result<usize> {
        match self {
            Self::Fold(fold) => fold.pictures(),
            Self::Surface(surface) => surface.pictures(),
        }
    }
}
