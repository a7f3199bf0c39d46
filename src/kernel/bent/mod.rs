//! Light on a fold with a rounded crease and bowed panels.
//!
//! The sheet consists of strips along the crease ([`section`](BentExchange)), each divided into columns. They
//! exchange light by Lambert's formula for polygons, and facets gather it from all of them. This is coarser
//! than [`super::wedge`]: only the difference between the bent and an ideal fold is used, in which
//! discretisation errors cancel.

mod columns;
mod exchange;
mod section;
mod seen;
mod symmetry;
mod view;

pub use exchange::{BentExchange, View};
pub(crate) use exchange::{Incoming, Seen};
pub(crate) use symmetry::Symmetry;

use nalgebra::Vector3;
use ndarray::Array2;

use crate::error::Result;
use crate::geometry::Fold;

/// The shape of a fold that is not ideal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BentFold {
    /// Angle between the panels' chords, degrees, in (0, 180]. A chord runs from the virtual crease, where
    /// the panels would meet without rounding, to the outer edge.
    pub angle_deg: f64,
    /// Radius of the crease on the lit side, in panel depths: a circular arc tangent to both panels.
    pub crease_radius: f64,
    /// Turn of each panel over its depth, degrees, as a circular arc: positive if hollow on the lit side.
    pub bow_deg: [f64; 2],
}

impl BentFold {
    /// A fold with flat panels and a sharp crease.
    #[must_use]
    pub fn ideal(angle_deg: f64) -> Self {
        Self { angle_deg, crease_radius: 0.0, bow_deg: [0.0; 2] }
    }

    /// Radiance of the facets of a sheet bent like this, with panels and facets of `fold` (whose angle is not
    /// used), in parallel light from the direction `sun`, seen from far away along the bisecting plane; a
    /// perfect diffuser facing the sun has 1.
    ///
    /// # Arguments
    /// - `sun`: unit vector in the coordinates of [`Fold::panels`]; parts facing away from it receive
    ///   nothing.
    /// - `albedos`: of the sheet, in (0, 1].
    ///
    /// # Returns
    /// Facet by albedo; facets in the order panel, row from the bottom of the crease, column.
    ///
    /// # Errors
    /// [`crate::Error::Numeric`] if light does not leave the fold.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use vfold::geometry::{FacetGrid, Fold};
    /// use vfold::kernel::bent::BentFold;
    /// let fold = Fold::new(48.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
    /// let ideal = BentFold::ideal(48.0);
    /// let rounded = BentFold { crease_radius: 0.015, ..ideal };
    /// let [sharp, round] = [ideal, rounded].map(|bent| bent.facet_radiance(&fold, Vector3::z(), &[0.5]));
    /// // The bottom of the crease faces the sun.
    /// let gain = round?[(5, 0)] / sharp?[(5, 0)];
    /// assert!(gain > 1.05 && gain < 1.4, "{gain}");
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn facet_radiance(&self, fold: &Fold, sun: Vector3<f64>, albedos: &[f64]) -> Result<Array2<f64>> {
        BentExchange::new(self, fold, Vector3::z()).facet_radiance(sun, albedos)
    }
}
