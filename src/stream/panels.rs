//! The panels of a scene: what photographs are measured by.

use std::collections::BTreeMap;

use super::Scene;
use crate::error::Result;
use crate::geometry::Panel;

impl Scene {
    /// The scene's panels by their numbers.
    ///
    /// # Errors
    /// [`Error::Field`](crate::Error::Field) if the geometry is missing or no surface in space.
    pub fn panels(&self) -> Result<BTreeMap<usize, Panel>> {
        if self.is_fold()? {
            Ok(self.fold()?.panels().into_iter().enumerate().collect())
        } else {
            Ok(self.shape()?.panels())
        }
    }
}
