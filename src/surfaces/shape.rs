//! Any surface as flat facets: triangles and convex quadrilaterals, in named groups.

use std::collections::HashSet;
use std::ops::Range;

use super::faces::{canonical, convex, crowded_edges, flat, is_degenerate};
use super::polygon::Polygon;
use crate::error::{Error, Result};

/// Most facets of a shape, and patches of a mesh.
pub const FACETS_MAX: usize = 100_000;

/// Facets that belong together, such as a panel of a fold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// Its name in the file.
    pub name: String,
    /// Its facets.
    pub facets: Range<usize>,
}

/// Three or four corners, counter-clockwise seen from the reflecting side.
#[derive(Clone, Debug, PartialEq)]
struct Facet {
    corners: Vec<usize>,
    polygon: Polygon,
}

/// A surface of flat facets. Facets reflect on the side from which their corners are counter-clockwise, and
/// cast shadows with both sides; lengths are in any unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    vertices: Vec<[f64; 3]>,
    facets: Vec<Facet>,
    groups: Vec<Group>,
    two_sided: bool,
}

impl Shape {
    /// A surface with these faces, lists of corners as indices into `vertices`. Groups are ranges of faces in
    /// order; a face outside of all groups also belongs to the surface.
    ///
    /// # Returns
    /// The surface, and a remark on everything omitted (faces without area, duplicate faces) or unusual
    /// (edges of more than two faces).
    ///
    /// # Errors
    /// [`Error::Shape`] if no face is left or there are too many, a face has more than four corners, is not
    /// flat or not convex, a corner does not exist, or a coordinate is not finite.
    ///
    /// # Example
    /// ```
    /// use vfold::surfaces::Shape;
    /// let vertices = vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    /// let (shape, remarks) = Shape::new(vertices, vec![vec![0, 1, 2, 3]], vec![])?;
    /// assert_eq!((shape.len(), shape.facet(0).area(), remarks.len()), (1, 2.0, 0));
    /// assert_eq!(shape.facet(0).normal().z, 1.0);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(
        vertices: Vec<[f64; 3]>,
        faces: Vec<Vec<usize>>,
        groups: Vec<Group>,
    ) -> Result<(Self, Vec<String>)> {
        if let Some(n) = vertices.iter().position(|vertex| !vertex.iter().all(|x| x.abs() < 1e30)) {
            return Err(Error::shape(format!("vertex {n} is not a point"), "give three finite numbers"));
        }
        let (mut facets, mut remarks, mut kept) = (Vec::new(), Vec::new(), vec![0]);
        let mut seen = HashSet::new();
        for (n, corners) in faces.into_iter().enumerate() {
            let polygon = flat(&vertices, &corners, n)?;
            if is_degenerate(&polygon) {
                remarks.push(format!("face {n} has no area and is left out"));
            } else if !seen.insert(canonical(&polygon)) {
                remarks.push(format!("face {n} repeats an earlier one and is left out"));
            } else {
                convex(&polygon, n)?;
                facets.push(Facet { corners, polygon });
            }
            kept.push(facets.len());
        }
        if facets.is_empty() {
            return Err(Error::shape("it has no face", "give triangles or quadrilaterals"));
        }
        check_count(facets.len())?;
        remarks.extend(crowded_edges(facets.iter().map(|facet| &facet.polygon)));
        let count = kept.len() - 1;
        let groups = groups.into_iter().map(|Group { name, facets }| Group {
            name,
            facets: kept[facets.start.min(count)]..kept[facets.end.min(count)],
        });
        let groups = groups.filter(|group| !group.facets.is_empty()).collect();
        Ok((Self { vertices, facets, groups, two_sided: false }, remarks))
    }

    /// The same surface reflecting on both sides: with as many additional facets, the backs, in groups named
    /// `… (back)`.
    ///
    /// # Errors
    /// [`Error::Shape`] if there are too many.
    pub fn with_backs(mut self) -> Result<Self> {
        let count = self.facets.len();
        check_count(2 * count)?;
        let back = |facet: &Facet| Facet {
            corners: facet.corners.iter().rev().copied().collect(),
            polygon: facet.polygon.reversed(),
        };
        self.facets.extend(self.facets.iter().map(back).collect::<Vec<_>>());
        let back = |group: &Group| Group {
            name: format!("{} (back)", group.name),
            facets: group.facets.start + count..group.facets.end + count,
        };
        self.groups.extend(self.groups.iter().map(back).collect::<Vec<_>>());
        self.two_sided = true;
        Ok(self)
    }

    /// Number of facets.
    #[must_use]
    pub fn len(&self) -> usize {
        self.facets.len()
    }

    /// Whether there is no facet, which [`Shape::new`] refuses.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.facets.is_empty()
    }

    /// A facet: its corners, area, centroid and normal.
    #[must_use]
    pub fn facet(&self, facet: usize) -> &Polygon {
        &self.facets[facet].polygon
    }

    /// All facets in order.
    pub fn facets(&self) -> impl ExactSizeIterator<Item = &Polygon> {
        self.facets.iter().map(|facet| &facet.polygon)
    }

    /// Corners of a facet as indices into the vertices, counter-clockwise seen from the reflecting side.
    #[must_use]
    pub fn corners(&self, facet: usize) -> &[usize] {
        &self.facets[facet].corners
    }

    /// The original vertices.
    #[must_use]
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// Groups of facets in order.
    #[must_use]
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// Whether the second half of the facets are the backs of the first.
    #[must_use]
    pub fn is_two_sided(&self) -> bool {
        self.two_sided
    }

    /// Largest extent along an axis.
    #[must_use]
    pub fn size(&self) -> f64 {
        let extent = |axis: usize| {
            let along = self.facets().flat_map(Polygon::corners).map(|corner| corner[axis]);
            let (low, high) =
                along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
            high - low
        };
        (0..3).map(extent).fold(0.0, f64::max)
    }
}

fn check_count(count: usize) -> Result<()> {
    if count <= FACETS_MAX {
        return Ok(());
    }
    Err(Error::shape(format!("{count} facets"), format!("give a coarser mesh, of at most {FACETS_MAX}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Vec<[f64; 3]> {
        vec![
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.2, 0.2, 0.0],
            [0.0, 1.0, 0.1],
        ]
    }

    fn refusal(faces: Vec<Vec<usize>>) -> String {
        Shape::new(square(), faces, vec![]).unwrap_err().to_string()
    }

    #[test]
    fn faces_that_are_no_facets_are_named() {
        assert!(refusal(vec![vec![0, 1, 2], vec![0, 1, 9]]).contains("face 1 uses vertex 9 of only 6"));
        assert!(refusal(vec![vec![0, 1, 2, 3, 4]]).contains("face 0 has 5 corners"));
        assert!(refusal(vec![vec![0, 1, 2, 5]]).contains("not flat"));
        assert!(refusal(vec![vec![0, 1, 4, 3]]).contains("not convex"));
        assert!(refusal(vec![vec![0, 0, 1]]).contains("no face"));
    }

    #[test]
    fn what_is_left_out_is_said_and_groups_follow() {
        let faces = vec![vec![0, 1, 2], vec![0, 1, 1], vec![1, 2, 0], vec![0, 2, 3]];
        let groups = vec![Group { name: "a".into(), facets: 0..3 }, Group { name: "b".into(), facets: 3..4 }];
        let (shape, remarks) = Shape::new(square(), faces, groups).unwrap();
        assert_eq!(remarks.len(), 2);
        assert_eq!(shape.groups()[0].facets, 0..1);
        assert_eq!(shape.groups()[1].facets, 1..2);
        assert_eq!(shape.with_backs().unwrap().facet(3).normal().z.to_bits(), (-1.0_f64).to_bits());
    }
}
