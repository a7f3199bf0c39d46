//! Facets pooled without loss of information: all rows, a few columns.

use nalgebra::DMatrix;
use ndarray::Array2;

use super::framing::Pose;
use crate::estimate::measured::Measured;
use crate::estimate::photograph::parts::{Place, Radiance};
use crate::forward::FacetValues;
use crate::geometry::Fold;

/// Maximum numbers of rows and columns of a panel.
const ROWS: usize = 10;
const COLUMNS: usize = 3;

/// Pooled facets.
pub struct Bins {
    /// Indices of the facets in each bin.
    members: Vec<Vec<usize>>,
    places: Vec<Place>,
    /// Mean values and standard deviations of their noise: bin by channel.
    values: DMatrix<f64>,
    sd: DMatrix<f64>,
}

impl Bins {
    /// Bins of the measured facets.
    pub fn new(fold: &Fold, Measured { rgb, sd }: &Measured, pose: &Pose) -> Self {
        let grid = fold.facets();
        let (rows, columns) = (grid.rows.min(ROWS), grid.cols.min(COLUMNS));
        let mut members = vec![Vec::new(); 2 * rows * columns];
        for (facet, values) in rgb.facets().enumerate() {
            if values.is_some() {
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
        let of = |values: &FacetValues, facet: &usize, channel| values.get(*facet, channel).unwrap_or(0.0);
        let mean = |bin: usize, channel| {
            let facets = &members[bin];
            facets.iter().map(|facet| of(rgb, facet, channel)).sum::<f64>() / facets.len() as f64
        };
        let sd_of_mean = |bin: usize, channel| {
            let facets = &members[bin];
            facets.iter().map(|facet| of(sd, facet, channel).powi(2)).sum::<f64>().sqrt()
                / facets.len() as f64
        };
        let (bins, channels) = (members.len(), rgb.channels());
        Self {
            places,
            values: DMatrix::from_fn(bins, channels, mean),
            sd: DMatrix::from_fn(bins, channels, sd_of_mean),
            members,
        }
    }

    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// Mean values: bin by channel; `None` if no light was measured.
    pub fn values(&self) -> Option<&DMatrix<f64>> {
        self.values.iter().any(|value| *value > 0.0).then_some(&self.values)
    }

    /// Standard deviations of the noise of the means.
    pub fn sd(&self) -> &DMatrix<f64> {
        &self.sd
    }

    /// Bin means of values that are known for every facet, facet by node.
    pub fn pool(&self, of_facets: &Array2<f64>) -> Radiance {
        DMatrix::from_fn(self.members.len(), of_facets.ncols(), |bin, node| {
            let facets = &self.members[bin];
            facets.iter().map(|facet| of_facets[(*facet, node)]).sum::<f64>() / facets.len() as f64
        })
    }
}
