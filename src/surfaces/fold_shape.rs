//! A fold as a general surface, for light without closed formulas.

use super::{Group, Shape};
use crate::error::Result;
use crate::geometry::{FacetGrid, Fold};

impl Fold {
    /// The fold as a surface in space, as in [`Fold::panels`], with groups `panel 0` and `panel 1`.
    ///
    /// # Errors
    /// [`crate::Error::Field`] if its sides are too large or too small for a surface.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{FacetGrid, Fold};
    /// let fold = Fold::new(60.0, 1.0, 1.0, FacetGrid { rows: 3, cols: 2 })?;
    /// let shape = fold.shape()?;
    /// assert_eq!((shape.len(), shape.panels().len()), (12, 2));
    /// // panel 0 looks to the other one
    /// assert!((shape.facet(0).normal().x - 30_f64.to_radians().cos()).abs() < 1e-12);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn shape(&self) -> Result<Shape> {
        let FacetGrid { rows, cols } = self.facets();
        let (mut vertices, mut faces, mut groups) = (Vec::new(), Vec::new(), Vec::new());
        for (number, panel) in self.panels().iter().enumerate() {
            let first = vertices.len();
            let [origin, along, _, out] = panel.corners;
            let at = |row: f64, col: f64| (origin + col * (along - origin) + row * (out - origin)).into();
            let of_row =
                |row: &f64| panel.col_edges.iter().map(move |col| at(*row, *col)).collect::<Vec<[f64; 3]>>();
            vertices.extend(panel.row_edges.iter().flat_map(of_row));
            let vertex = |row: usize, col: usize| first + row * (cols + 1) + col;
            for (row, col) in (0..rows).flat_map(|row| (0..cols).map(move |col| (row, col))) {
                let mut corners = vec![
                    vertex(row, col),
                    vertex(row, col + 1),
                    vertex(row + 1, col + 1),
                    vertex(row + 1, col),
                ];
                if number == 1 {
                    corners.reverse();
                }
                faces.push(corners);
            }
            groups.push(Group { name: format!("panel {number}"), facets: panel.facets.clone() });
        }
        Shape::new(vertices, faces, groups).map(|(shape, _)| shape)
    }
}
