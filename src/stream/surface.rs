//! The scene's geometry: any surface, as a mesh or as nothing but its kernel.

use serde::{Deserialize, Serialize};

use super::Scene;
use super::geometry::GeometryRecord;
use crate::error::{Error, Result};
use crate::geometry::{Group, Shape};

/// A surface that is no fold.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// Flat facets in space.
    Mesh(Shape),
    /// So many facets of which nothing is known but their kernel.
    Kernel {
        /// How many.
        facets: usize,
    },
}

/// A mesh in full: the exchange between its facets is dense, so that it is small beside its response.
#[derive(Serialize, Deserialize)]
pub(super) struct MeshRecord {
    vertices: Vec<[f64; 3]>,
    /// Corners, counter-clockwise seen from the reflecting side.
    faces: Vec<Vec<usize>>,
    /// The faces' backs are as many facets again.
    #[serde(default)]
    two_sided: bool,
}

#[derive(Serialize, Deserialize)]
struct FacetsRecord {
    count: usize,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    groups: Vec<GroupRecord>,
}

/// So many facets from `first` on.
#[derive(Serialize, Deserialize)]
struct GroupRecord {
    name: String,
    first: usize,
    count: usize,
}

impl From<&Group> for GroupRecord {
    fn from(group: &Group) -> Self {
        Self { name: group.name.clone(), first: group.facets.start, count: group.facets.len() }
    }
}

impl GroupRecord {
    fn into_group(self) -> Group {
        Group { name: self.name, facets: self.first..self.first.saturating_add(self.count) }
    }
}

impl From<&Shape> for MeshRecord {
    fn from(shape: &Shape) -> Self {
        let two_sided = shape.is_two_sided();
        let fronts = if two_sided { shape.len() / 2 } else { shape.len() };
        let faces = (0..fronts).map(|facet| shape.corners(facet).to_vec()).collect();
        Self { vertices: shape.vertices().to_vec(), faces, two_sided }
    }
}

impl Scene {
    pub(super) fn set_surface(&mut self, surface: &Surface) -> Result<()> {
        let (geometry, facets) = match surface {
            Surface::Mesh(shape) => {
                let groups = shape.groups().iter().map(GroupRecord::from).collect();
                (GeometryRecord::Mesh(shape.into()), FacetsRecord { count: shape.len(), groups })
            }
            Surface::Kernel { facets } => {
                (GeometryRecord::Kernel, FacetsRecord { count: *facets, groups: Vec::new() })
            }
        };
        self.fields.set("geometry", geometry)?;
        self.fields.set("facets", facets)
    }

    /// Number of facets.
    ///
    /// # Errors
    /// [`Error::Field`] if the scene does not say it.
    pub fn facets(&self) -> Result<usize> {
        if self.is_fold()? { Ok(2 * self.fold()?.facets().len()) } else { Ok(self.facets_record()?.count) }
    }

    fn facets_record(&self) -> Result<FacetsRecord> {
        self.fields.require("facets", "make the scene with vkernel")
    }

    /// The surface in space.
    ///
    /// # Errors
    /// [`Error::Field`] if it is a fold, or not a possible mesh, or nothing but its kernel is known.
    pub fn shape(&self) -> Result<Shape> {
        let GeometryRecord::Mesh(record) = self.geometry()? else {
            let problem = "a mesh is needed here; make the scene with vkernel --shape";
            return Err(Error::field("geometry", problem));
        };
        let FacetsRecord { count, groups } = self.facets_record()?;
        let fronts = record.faces.len();
        let groups = groups.into_iter().map(GroupRecord::into_group);
        let groups = groups.filter(|group| group.facets.start < fronts).collect();
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
