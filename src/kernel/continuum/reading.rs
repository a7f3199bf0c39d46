//! Which functions on a panel take up what falls on it, and facet means from them.
//!
//! A few facets are such functions themselves. Many are more than it takes: polynomials of a few more degrees
//! than those of the radiosity then take up the light, which is as smooth, and facets are read from them,
//! across the crease and along it by itself.

use nalgebra::{DMatrix, DVectorView};

use super::layout::Layout;
use super::resolution::Resolution;
use super::space::Space;
use crate::geometry::Fold;

/// Degrees beyond those of the radiosity: what the polynomials leave out is then far less than what the
/// radiosity is off by.
const MORE_DEGREES: usize = 4;

/// The functions that take up the light on each panel, and how facets are read from them; facets of the first
/// half of the crease.
pub(super) struct Reading {
    pub(super) spaces: [Space; 2],
    /// None where the functions are the facets.
    pools: Option<[Pool; 2]>,
}

/// Means over facets of functions of a space.
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

    /// Number of functions that take up the light on a panel.
    pub(super) fn len(&self) -> usize {
        self.spaces[0].len().max(self.spaces[1].len())
    }

    /// Facet means on a panel, row by row, from the coordinates of light in its space.
    pub(super) fn facet_means(&self, panel: usize, light: &[f64]) -> Vec<f64> {
        match &self.pools {
            None => {
                // The function of a facet is as high as makes its square's integral 1.
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
    /// Unknowns that the larger of a fold's panels takes.
    #[must_use]
    pub fn unknowns(&self, fold: &Fold) -> usize {
        let [panel0, panel1] = Layout::new(fold, self).panels;
        panel0.len().max(panel1.len())
    }

    /// Functions that take up the light on the larger of a fold's panels, for its facets.
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
