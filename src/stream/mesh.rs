//! Flat facets in space, as in a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::surfaces::Shape;

/// Flat facets in space, all of which are listed.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct MeshRecord {
    /// Points, in any unit.
    pub vertices: Vec<[f64; 3]>,
    /// Three or four vertices of each face, counted from 0, counter-clockwise seen from the reflecting side.
    #[schemars(inner(length(min = 3, max = 4)))]
    pub faces: Vec<Vec<usize>>,
    /// Whether both sides of the faces reflect: their backs are then as many further facets.
    #[serde(default)]
    pub two_sided: bool,
}

impl From<&Shape> for MeshRecord {
    fn from(shape: &Shape) -> Self {
        let two_sided = shape.is_two_sided();
        let fronts = if two_sided { shape.len() / 2 } else { shape.len() };
        let faces = (0..fronts).map(|facet| shape.corners(facet).to_vec()).collect();
        Self { vertices: shape.vertices().to_vec(), faces, two_sided }
    }
}
