//! Functions that represent the light on a panel, and facet means computed from them.
//!
//! If there are few facets, they are these functions themselves. Otherwise polynomials of slightly higher
//! degrees than those of the radiosity suffice, as the light is equally smooth, and facets are read from
//! them, separately across the crease and along it.

use nalgebra::{DMatrix, DVectorView};

use super::layout::Layout;
use super::resolution::Resolution;
use super::space::Space;
use crate::geometry::Fold;

/// Additional degrees beyond those of the radiosity: truncation then matters far less than the radiosity's
/// error.
const MORE_DEGREES: usize = 4;

/// The functions that represent the light on each panel, and how facets in the first half of the crease are
/// read from them.
pub(super) struct Reading {
    pub(super) spaces: [Space; 2],
    /// `None` if the functions are the facets.
    pools: Option<[Pool; 2]>,
}

/// Means over facets of the functions of a space.
struct Pool {
    space: Space,
    /// Facet row by function across the crease.
    rows: DMatrix<f64>,
    /// Facet column by function along the crease.
    cols: DMatrix<f64>,
}

impl Reading {
    pub(super) fn new(layout: &Layout, fold: &Fold) -> Self {
        let facets = [0, 1].map(|panel| layout.facets(fold, panel));
        let finer = layout.panels.each_ref().map(|panel| panel.with_more_degrees(MORE_DEGREES));
        if facets[0].len() <= finer[0].len().max(finer[1].len()) {
            return Self { spaces: facets, pools: None };
        }
        let pools = [0, 1].map(|panel| Pool::new(&finer[panel], &facets[panel]));
        Self { spaces: finer, pools: Some(pools) }
    }

    /// Number of functions that represent the light on a panel.
    pub(super) fn len(&self) -> usize {
        self.spaces[0].len().max(self.spaces[1].len())
    }

    /// Facet means on a panel, row by row, from the coordinates of light in its space.
    pub(super) fn facet_means(&self, panel: usize, light: &[f64]) -> Vec<f64> {
        match &self.pools {
            None => {
                // Facet functions are normalised: the integral of their square is 1.
                light
                    .iter()
                    .zip(self.spaces[panel].uniform())
                    .map(|(light, root_area)| light / root_area)
                    .collect()
            }
            Some(pools) => pools[panel].facet_means(light),
        }
    }
}

impl Resolution {
    /// Number of unknowns on the larger panel of a fold.
    #[must_use]
    pub fn unknowns(&self, fold: &Fold) -> usize {
        let [panel0, panel1] = Layout::new(fold, self).panels;
        panel0.len().max(panel1.len())
    }

    /// Number of functions that represent the light for the facets, on the larger panel of a fold.
    #[must_use]
    pub fn readings(&self, fold: &Fold) -> usize {
        Reading::new(&Layout::new(fold, self), fold).len()
    }
}

impl Pool {
    fn new(space: &Space, facets: &Space) -> Self {
        let (rows, cols) = (space.across.means(&facets.across.ends), space.along.means(&facets.along.ends));
        Self { space: space.clone(), rows, cols }
    }

    fn facet_means(&self, light: &[f64]) -> Vec<f64> {
        let Space { across, along } = &self.space;
        // Facet column by function across the crease.
        let mut of_cols = DMatrix::zeros(self.cols.nrows(), self.rows.ncols());
        let of_strips = light.chunks_exact(self.space.of_strip()).enumerate();
        for (strip, light) in of_strips {
            for m in 0..across.order {
                let light = &light[self.space.first(m)..self.space.first(m + 1)];
                let cols = self.cols.columns(0, self.space.degrees(m) * along.ends.len());
                let mut of_cols = of_cols.column_mut(m * across.ends.len() + strip);
                of_cols.gemv(1.0, &cols, &DVectorView::from_slice(light, light.len()), 0.0);
            }
        }
        (of_cols * self.rows.transpose()).data.into()
    }
}
