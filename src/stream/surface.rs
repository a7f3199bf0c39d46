//! The scene's geometry: any surface, as a mesh or by its kernel alone.

use super::Scene;
use super::facets::{FacetsRecord, ListRecord};
use super::geometry::GeometryRecord;
use crate::error::{Error, Result};
use crate::geometry::Fold;
use crate::surfaces::{Group, Shape};

/// A surface surrounded by light sources.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// Two panels that meet at a crease.
    Fold(Fold),
    /// Flat facets in space.
    Mesh(Shape),
    /// Facets known only by their kernel.
    Kernel {
        /// Their number.
        facets: usize,
    },
}

impl From<&Surface> for GeometryRecord {
    fn from(surface: &Surface) -> Self {
        match surface {
            Surface::Fold(fold) => Self::Fold(fold.into()),
            Surface::Mesh(shape) => Self::Mesh(shape.into()),
            Surface::Kernel { .. } => Self::Kernel,
        }
    }
}

impl From<&Surface> for FacetsRecord {
    fn from(surface: &Surface) -> Self {
        match surface {
            Surface::Fold(fold) => Self::Grid(fold.into()),
            Surface::Mesh(shape) => Self::List(ListRecord {
                count: shape.len(),
                groups: shape.groups().iter().map(Into::into).collect(),
            }),
            Surface::Kernel { facets } => Self::List(ListRecord { count: *facets, groups: Vec::new() }),
        }
    }
}

impl Scene {
    /// The surface in space.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a possible mesh or fold, or only its kernel is known.
    pub fn shape(&self) -> Result<Shape> {
        if let Some(fold) = self.fold_if_one()? {
            return fold.shape().map_err(|e| Error::field("geometry", e));
        }
        let GeometryRecord::Mesh(record) = self.geometry()? else {
            let problem = "a mesh is needed here; make the scene with vkernel --shape";
            return Err(Error::field("geometry", problem));
        };
        let ListRecord { count, groups } = self.facet_list()?;
        let fronts = record.faces.len();
        let groups =
            groups.into_iter().map(Group::from).filter(|group| group.facets.start < fronts).collect();
        let (shape, _) =
            Shape::new(record.vertices, record.faces, groups).map_err(|e| Error::field("geometry", e))?;
        let shape = if record.two_sided { shape.with_backs()? } else { shape };
        if shape.len() == count {
            Ok(shape)
        } else {
            Err(Error::field("facets.count", format!("{count}, but the mesh has {}", shape.len())))
        }
    }
}
