//! A quadrilateral in the picture divided into rows and columns: a panel into facets, a chart into patches.

use super::homography::Homography;

/// Rows and columns between four corners.
#[derive(Debug, Clone)]
pub struct Grid {
    /// Its position in the picture.
    pub outline: Homography,
    /// Boundaries of rows, from 0 to 1 away from the first side.
    pub row_edges: Vec<f64>,
    /// Boundaries of columns, along the first side.
    pub col_edges: Vec<f64>,
    /// The panel's number, if it is a panel.
    pub panel: Option<usize>,
}

impl Grid {
    /// The facets of a panel.
    #[must_use]
    pub fn of_panel(panel: usize, outline: Homography, row_edges: &[f64], col_edges: &[f64]) -> Self {
        let (row_edges, col_edges) = (row_edges.to_vec(), col_edges.to_vec());
        Self { outline, row_edges, col_edges, panel: Some(panel) }
    }

    /// Rows and columns of equal width.
    ///
    /// # Example
    /// ```
    /// use vfold::image::{Grid, Homography, Point};
    /// let chart = [(0., 0.), (60., 0.), (60., 40.), (0., 40.)].map(|(x, y)| Point::new(x, y));
    /// assert_eq!(
    ///     Grid::even(Homography::from_unit_square(chart)?, [4, 6]).row_edges,
    ///     [0.0, 0.25, 0.5, 0.75, 1.0]
    /// );
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn even(outline: Homography, [rows, cols]: [usize; 2]) -> Self {
        let edges = |count: usize| (0..=count).map(|edge| edge as f64 / count as f64).collect();
        Self { outline, row_edges: edges(rows), col_edges: edges(cols), panel: None }
    }
}
