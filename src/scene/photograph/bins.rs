//! Facets pooled to as many as tell what there is to tell: all rows, a few columns.

use nalgebra::DMatrix;
use ndarray::Array2;

use super::framing::Pose;
use crate::estimate::measured::Measured;
use crate::estimate::photograph::parts::{Place, Radiance};
use crate::geometry::Fold;

/// Most rows and columns of a panel.
const ROWS: usize = 10;
const COLUMNS: usize = 3;

/// Facets that are pooled.
pub struct Bins {
    /// Numbers of the facets in each.
    members: Vec<Vec<usize>>,
    places: Vec<Place>,
    values: Vec<Vec<f64>>,
    sd: Vec<Vec<f64>>,
}

impl Bins {
    /// Those of the facets that were measured.
    pub fn new(fold: &Fold, Measured { rgb, sd }: &Measured, pose: &Pose) -> Self {
        let grid = fold.facets();
        let (rows, columns) = (grid.rows.min(ROWS), grid.cols.min(COLUMNS));
        let mut members = vec![Vec::new(); 2 * rows * columns];
        for (facet, values) in rgb.iter().enumerate() {
            if values.as_ref().is_some_and(|values| values.iter().all(|value| *value > 0.0)) {
                let (panel, place) = (facet / grid.len(), facet % grid.len());
                let (row, column) =
                    (place / grid.cols * rows / grid.rows, place % grid.cols * columns / grid.cols);
                members[(panel * rows + row) * columns + column].push(facet);
            }
        }
        members.retain(|facets| !facets.is_empty());
        let edges = fold.row_edges();
        let of_facet = |facet: &usize| {
            let (panel, place) = (facet / grid.len(), facet % grid.len());
            let (row, column) = (place / grid.cols, place % grid.cols);
            let depth = 0.5 * (edges[panel][row] + edges[panel][row + 1]) / fold.depths()[panel];
            let along = (column as f64 + 0.5) / grid.cols as f64;
            Place {
                panel,
                depth,
                along: along * fold.width() / fold.depths()[panel],
                off_centre: pose.off_centre(panel, along, depth),
            }
        };
        let mean_place = |facets: &Vec<usize>| {
            let all: Vec<Place> = facets.iter().map(of_facet).collect();
            let mean = |of: fn(&Place) -> f64| all.iter().map(of).sum::<f64>() / all.len() as f64;
            Place {
                panel: all[0].panel,
                depth: mean(|place| place.depth),
                along: mean(|place| place.along),
                off_centre: mean(|place| place.off_centre),
            }
        };
        let places = members.iter().map(mean_place).collect();
        let channels = rgb.iter().flatten().next().map_or(0, Vec::len);
        let of = |facet: usize, channel: usize| rgb[facet].as_ref().map_or(0.0, |values| values[channel]);
        let noise = |facet: usize, channel: usize| sd[facet].as_ref().map_or(0.0, |sd| sd[channel]);
        let pooled = |facets: &Vec<usize>| {
            let mean = |c| facets.iter().map(|facet| of(*facet, c)).sum::<f64>() / facets.len() as f64;
            (0..channels).map(mean).collect()
        };
        let pooled_sd = |facets: &Vec<usize>| {
            let root = |c| facets.iter().map(|facet| noise(*facet, c).powi(2)).sum::<f64>().sqrt();
            (0..channels).map(|c| root(c) / facets.len() as f64).collect()
        };
        Self {
            places,
            values: members.iter().map(pooled).collect(),
            sd: members.iter().map(pooled_sd).collect(),
            members,
        }
    }

    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// Mean values: bin by channel; none if nothing was measured.
    pub fn values(&self) -> Option<DMatrix<f64>> {
        (!self.members.is_empty()).then(|| matrix(&self.values))
    }

    /// Standard deviations of their noise.
    pub fn sd(&self) -> DMatrix<f64> {
        matrix(&self.sd)
    }

    /// Means of what is known of every facet, facet by node.
    pub fn pool(&self, of_facets: &Array2<f64>) -> Radiance {
        DMatrix::from_fn(self.members.len(), of_facets.ncols(), |bin, node| {
            let facets = &self.members[bin];
            facets.iter().map(|facet| of_facets[(*facet, node)]).sum::<f64>() / facets.len() as f64
        })
    }
}

fn matrix(rows: &[Vec<f64>]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), rows[0].len(), |row, column| rows[row][column])
}
